// The first pass: what light asks of a surface, and no more.
//
// In:  a fragment.
// Out: the normal; the exponent of the highlight as a logarithm.
// Follows Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer", ShaderX7.
#import lightbench::geometry
#import lightbench::surface
#import lightbench::normals

struct ThinGBuffer {
    @location(0) normal: vec2u,
    @location(1) gloss: f32,
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> ThinGBuffer {
    let point = surface::fragment_surface(in, front_facing);
    return ThinGBuffer(normals::encode_octahedral(point.normal), log2(point.lobe.x) / 10.5);
}
