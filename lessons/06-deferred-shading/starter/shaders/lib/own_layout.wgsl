// A G-buffer of your own: surfaces to texels, and back.
//
// These functions run and keep nothing. Your numbers are in README.md.
#define_import_path own_layout

// What light needs to know of a surface, but for its place, which depth tells.
struct Kept {
    normal: vec3f,                      // length 1, any direction
    base_color: vec3f,                  // 0 to 1, linear
    specular: f32,                      // strength of the highlight, 0 to 1
    power: f32,                         // its exponent, from 1 to your largest one
}

// TASK pack: what the pass that draws surfaces writes. The first output goes to `hdr`, and stays.
struct Texels {
    @location(0) hdr: vec4f,
    @location(1) first: f32,
}

// TASK pack: the targets as shaders read them.
@group(1) @binding(1) var g_first: texture_2d<f32>;

// TASK pack: what is kept of a surface, and the light that it emits.
fn pack(emitted: vec3f, kept: Kept) -> Texels {
    return Texels(vec4f(emitted, 1.0), 0.0);
}

// TASK pack: what was kept at a texel.
fn unpack(texel: vec2i) -> Kept {
    let first = textureLoad(g_first, texel, 0).r;
    return Kept(vec3f(0.0, 1.0, 0.0), vec3f(first), 0.0, 1.0);
}
