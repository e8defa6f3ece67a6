// From empty, step 3: surfaces go into the G-buffer, unlit.
//
// In:  a fragment.
// Out: the five colour targets of the pass, packed by shaders/lib/g_buffer.wgsl.
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
