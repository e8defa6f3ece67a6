// From empty, step 6: surfaces go into the G-buffer, and depth into a target of its own.
//
// In:  a fragment.
// Out: the six colour targets of the pass.
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer

struct GBufferAndDepth {
    @location(0) hdr: vec4f,
    @location(1) albedo: vec4f,
    @location(2) normal: vec2u,
    @location(3) specular: vec4u,
    @location(4) model: u32,
    @location(5) depth: f32,
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> GBufferAndDepth {
    let s = g_buffer::pack(surface::fragment_surface(in, front_facing));
    return GBufferAndDepth(s.hdr, s.albedo, s.normal, s.specular, s.model, in.clip_position.z);
}
