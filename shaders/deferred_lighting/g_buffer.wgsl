// Deferred lighting, first pass: what light needs to know of a surface, and no more.
//
// In:  a fragment.
// Out: normal and Blinn-Phong exponent, packed as shaders/lib/g_buffer.wgsl does.
// Follows Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer".
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer

struct ThinGBuffer {
    @location(0) normal: vec2u,         // octahedral
    @location(1) power: f32,            // log2(p) / 10.5
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> ThinGBuffer {
    let packed = g_buffer::pack(surface::fragment_surface(in, front_facing));
    return ThinGBuffer(packed.normal, packed.power);
}
