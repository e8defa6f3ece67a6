// How deferred pipelines keep a surface in textures.
//
// In:  a surface, or the texels of the G-buffer.
// Out: the other. Quantisation: base colour and specular 8 bits each, as their square roots; normal
//      2 × 16 bits octahedral; power 8 bits as log2(p) / 10.5, whose step is 2.9 %.
//
// A square root spends the 8 bits as the eye does, much like sRGB, and unlike the sRGB conversion of
// texture units, which may be approximate, it is the same on every driver.
#define_import_path lightbench::g_buffer

#import lightbench::surface
#import lightbench::normals

struct GBuffer {
    @location(0) hdr: vec4f,            // emitted radiance; lights add to it
    @location(1) albedo: vec4f,         // roots of base colour and specular
    @location(2) normal: vec2u,         // octahedral
    @location(3) power: f32,            // log2(p) / 10.5
}

// The texels of a surface.
fn pack(s: surface::Surface) -> GBuffer {
    return GBuffer(
        vec4f(s.emissive, 1.0),
        sqrt(vec4f(s.base_color, s.specular)),
        normals::encode_octahedral(s.normal),
        log2(clamp(s.power, 1.0, 1448.0)) / 10.5,
    );
}

// The surface again, from texels; emission is in the light buffer already.
fn unpack(position: vec3f, albedo: vec4f, normal: vec2u, power: f32) -> surface::Surface {
    return surface::Surface(
        position,
        normals::decode_octahedral(normal),
        albedo.rgb * albedo.rgb,
        albedo.a * albedo.a,
        exp2(10.5 * power),
        vec3f(0.0),
        1.0,
    );
}

// The brightness of a linear Rec. 709 colour (ITU-R BT.709, item 3.2).
fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}
