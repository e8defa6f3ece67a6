// Inferred lighting: counts the transparent surfaces that want each texel.
//
// In:  a fragment of a transparent object before all opaque ones, in the small buffers.
// Out: 1/255 to add, at the texels of its layer. Where the sum is more, the nearest surface will
//      take the texel and the others lose it.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::discontinuity

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) f32 {
    // Called for its discard.
    _ = surface::fragment_surface(in, front_facing);
    let layer = scene::drawn_objects[in.drawn].layer;
    if !discontinuity::is_of_layer(vec2u(in.clip_position.xy), layer) {
        discard;
    }
    return 1.0 / 255.0;
}
