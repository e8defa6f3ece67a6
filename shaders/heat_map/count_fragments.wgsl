// Heat map: each fragment that a geometry pass shades counts 1.
//
// In:  a fragment.
// Out: 1, which the pass adds up. With ALPHA_TEST fragments in holes are discarded as everywhere else,
//      and do not count.
#import lightbench::geometry
#import lightbench::surface

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
#ifdef ALPHA_TEST
    // Called for its discard.
    _ = surface::fragment_surface(in, front_facing);
#endif
    return vec4f(1.0);
}
