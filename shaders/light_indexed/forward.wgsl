// Light-indexed forward shading: each fragment sums the lights whose numbers its pixel holds.
//
// In:  a fragment; what shaders/lib/pixel_lights.wgsl reads.
// Out: linear radiance, and opacity as alpha; 1 where lights were lost.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::geometry
#import lightbench::surface
#import lightbench::pixel_lights

struct Shaded {
    @location(0) hdr: vec4f,
    @location(1) over_capacity: f32,
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> Shaded {
    let fragment = surface::fragment_surface(in, front_facing);
    let found = pixel_lights::sum(vec2i(in.clip_position.xy), fragment);
    return Shaded(
        vec4f(fragment.emissive + found.radiance, fragment.opacity),
        select(0.0, 1.0, found.lost),
    );
}
