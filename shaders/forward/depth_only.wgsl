// Depth pre-pass: no colours, but alpha-tested fragments must leave the same holes as later.
//
// In:  a fragment of an ALPHA_TEST variant; other variants run without a fragment stage.
// Out: nothing but depth.
#import lightbench::geometry
#import lightbench::surface

@fragment
fn fragment_main(in: geometry::VertexOutput, @builtin(front_facing) front_facing: bool) {
    // Called for its discard.
    _ = surface::fragment_surface(in, front_facing);
}
