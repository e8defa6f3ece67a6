// Deferred shading, first pass: surfaces go into the G-buffer, unlit.
//
// In:  a fragment.
// Out: the G-buffer of shaders/lib/g_buffer.wgsl; emitted radiance goes straight to `hdr`.
// Follows Saito and Takahashi 1990, "Comprehensible Rendering of 3-D Shapes".
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> g_buffer::GBuffer {
    return g_buffer::pack(surface::fragment_surface(in, front_facing));
}
