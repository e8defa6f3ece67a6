// The first pass: surfaces go into the G-buffer, unlit.
//
// In:  a fragment.
// Out: what `pack` makes of it.
// Follows Saito and Takahashi 1990, "Comprehensible Rendering of 3-D Shapes".
#import lightbench::geometry
#import lightbench::surface
#import own_layout

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> own_layout::Texels {
    let point = surface::fragment_surface(in, front_facing);
    // All highlights of this lesson's scene are grey: one channel will do.
    let kept = own_layout::Kept(point.normal, point.base_color, point.specular.g, point.lobe.x);
    return own_layout::pack(point.emissive, kept);
}
