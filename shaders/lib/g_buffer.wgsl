// How deferred pipelines keep a surface in textures.
//
// In:  a surface, or the texels of the G-buffer.
// Out: the other. 13 bytes a pixel, of which surfaces of the default reflection model use 9, or 11
//      where their highlights have a colour:
//
//      g_albedo    rgba8unorm   roots of the base colour; gloss
//      g_normal    rg16uint     octahedral, or with BEST_FIT_NORMALS or PLAIN_NORMALS three bytes
//      g_specular  rgba8uint    roots of the specular colour; gloss across the tangent (Ward)
//      g_model     r8uint       reflection model; for Ward the tangent too
//
// Quantisation: colours 8 bits a channel, as square roots; normal 2 × 16 bits. Gloss is 8 bits of
// a logarithm: log2(p) / 10.5 of an exponent, whose step is 2.9 %, or -log2(α) / 5.25 of a
// roughness, whose step is 1.4 %. The tangent is an angle in steps of 0.71 degrees.
//
// A square root spends the 8 bits as the eye does, much like sRGB, and unlike the sRGB conversion of
// texture units, which may be approximate, it is the same on every driver. The specular colour is
// kept as integers, since WebGPU allows 32 bytes a pixel of colour targets and counts an rgba8unorm
// for eight.
#define_import_path lightbench::g_buffer

#import lightbench::surface
#import lightbench::normals
#import lightbench::brdf

struct GBuffer {
    @location(0) hdr: vec4f,            // emitted radiance; lights add to it
    @location(1) albedo: vec4f,
    @location(2) normal: vec2u,
    @location(3) specular: vec4u,
    @location(4) model: u32,
}

// The texels of a surface.
fn pack(s: surface::Surface) -> GBuffer {
    let normal = pack_normal(s.normal);
    let gloss = pack_gloss(s.model, s.lobe);
    return GBuffer(
        vec4f(s.emissive, 1.0),
        vec4f(sqrt(s.base_color), gloss.x),
        normal,
        vec4u(round(255.0 * vec4f(sqrt(s.specular), gloss.y))),
        pack_model(s, normal),
    );
}

// The surface again, from texels; emission is in the light buffer already.
fn unpack(
    position: vec3f,
    albedo: vec4f,
    normal: vec2u,
    specular: vec4u,
    model: u32,
) -> surface::Surface {
    // As texture units turn 8 bits into a number.
    let roots = vec4f(specular) * (1.0 / 255.0);
    var s = unpack_thin(position, normal, vec2f(albedo.a, roots.a), model);
    s.base_color = albedo.rgb * albedo.rgb;
    s.specular = roots.rgb * roots.rgb;
    return s;
}

// The same without colours, for pipelines that light before they know these.
fn unpack_thin(position: vec3f, normal: vec2u, gloss: vec2f, model: u32) -> surface::Surface {
    var s: surface::Surface;
    s.position = position;
    s.normal = unpack_normal(normal);
    s.opacity = 1.0;
#ifdef REFLECTION_MODELS
    s.model = min(model, brdf::WARD);
    s.lobe = unpack_gloss(s.model, gloss);
    s.tangent = unpack_tangent(model, s.normal);
#else
    s.lobe = vec2f(exp2(10.5 * gloss.x));
#endif
    return s;
}

// --- Normal ---------------------------------------------------------------------------------------

fn pack_normal(normal: vec3f) -> vec2u {
#ifdef PLAIN_NORMALS
    return normals::encode_plain(normal);
#else
#ifdef BEST_FIT_NORMALS
    return normals::encode_best_fit(normal);
#else
    return normals::encode_octahedral(normal);
#endif
#endif
}

fn unpack_normal(normal: vec2u) -> vec3f {
#ifdef PLAIN_NORMALS
    return normals::decode_plain(normal);
#else
#ifdef BEST_FIT_NORMALS
    return normals::decode_best_fit(normal);
#else
    return normals::decode_octahedral(normal);
#endif
#endif
}

// --- Gloss ----------------------------------------------------------------------------------------

fn pack_gloss(model: u32, lobe: vec2f) -> vec2f {
#ifdef REFLECTION_MODELS
    if model > brdf::PHONG {
        return log2(clamp(lobe, vec2f(brdf::LEAST_ROUGHNESS), vec2f(1.0))) / -5.25;
    }
#endif
    return log2(clamp(lobe, vec2f(1.0), vec2f(1448.0))) / 10.5;
}

fn unpack_gloss(model: u32, gloss: vec2f) -> vec2f {
    return exp2(gloss * select(10.5, -5.25, model > brdf::PHONG));
}

// --- Model and tangent -------------------------------------------------------------------------------
//
// Up to 3 the number of the model; from there on Ward, and the angle of the tangent in 252 steps of a
// half turn: Ward's model does not tell a direction from its opposite. The angle is measured from a
// direction that follows from the normal as it is kept, so that packing and unpacking agree on it.

const STEPS: f32 = 252.0;

fn pack_model(s: surface::Surface, normal: vec2u) -> u32 {
#ifdef REFLECTION_MODELS
    if s.model == brdf::WARD {
        let kept = unpack_normal(normal);
        let zero = surface::surface_tangent(vec3f(0.0), kept);
        let angle = atan2(dot(s.tangent, cross(kept, zero)), dot(s.tangent, zero));
        let step = round(fract(angle / brdf::PI) * STEPS);
        return brdf::WARD + u32(step) % u32(STEPS);
    }
    return s.model;
#else
    return brdf::BLINN_PHONG;
#endif
}

fn unpack_tangent(model: u32, normal: vec3f) -> vec3f {
    let zero = surface::surface_tangent(vec3f(0.0), normal);
    let angle = f32(max(model, brdf::WARD) - brdf::WARD) / STEPS * brdf::PI;
    return cos(angle) * zero + sin(angle) * cross(normal, zero);
}

// The brightness of a linear Rec. 709 colour (ITU-R BT.709, item 3.2).
fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}
