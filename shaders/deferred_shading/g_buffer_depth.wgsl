// Deferred shading with stencil, first pass: the G-buffer, and depth in a target of its own.
//
// In:  a fragment.
// Out: the G-buffer of shaders/lib/g_buffer.wgsl; emitted radiance goes straight to `hdr`; reversed
//      depth once more, for passes that write the stencil beside the depth buffer and so can't read it.
// Follows Saito and Takahashi 1990, "Comprehensible Rendering of 3-D Shapes".
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
    let packed = g_buffer::pack(surface::fragment_surface(in, front_facing));
    return GBufferAndDepth(
        packed.hdr,
        packed.albedo,
        packed.normal,
        packed.specular,
        packed.model,
        in.clip_position.z,
    );
}
