// Deferred lighting, first pass: what light needs to know of a surface, and no more.
//
// In:  a fragment.
// Out: normal, gloss and reflection model, packed as shaders/lib/g_buffer.wgsl does.
// Follows Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer".
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer

struct ThinGBuffer {
    @location(0) normal: vec2u,         // octahedral
    @location(1) gloss: vec2f,          // along the tangent and, for Ward, across it
    @location(2) model: u32,            // for Ward the tangent too
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> ThinGBuffer {
    let fragment = surface::fragment_surface(in, front_facing);
    let packed = g_buffer::pack(fragment);
    return ThinGBuffer(
        packed.normal,
        g_buffer::pack_gloss(fragment.model, fragment.lobe),
        packed.model,
    );
}
