// From empty, step 2: the base colour of a surface, without any light.
//
// In:  a fragment.
// Out: its base colour, coded for the display.
#import lightbench::geometry
#import lightbench::surface
#import lightbench::color

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    return vec4f(color::encode_srgb(point.base_color), 1.0);
}
