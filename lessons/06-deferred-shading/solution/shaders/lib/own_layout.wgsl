// A G-buffer of 8 bytes a pixel: surfaces to texels, and back.
//
// In:  what light needs to know of a surface; or the texel that holds it.
// Out: the other. One target of two words:
//
//      bits    of the first word          of the second word
//       0-11   normal, across the square  root of red, 8 bits
//      12-23   normal, up the square      root of green, 8 bits (8-15), root of blue (16-23)
//      24-31   specular strength          logarithm of the exponent
//
// Normals follow Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
// Vectors", JCGT 3(2): the sphere is unfolded to a square. Twelve bits a side turn them by up to 0.06
// degrees.
#define_import_path own_layout

const POWER = 800.0;                    // the largest exponent
const SIDE = 4095.0;                    // the last step along a side of the square

struct Kept {
    normal: vec3f,
    base_color: vec3f,
    specular: f32,
    power: f32,
}

// TASK pack: emitted light, and two words.
struct Texels {
    @location(0) hdr: vec4f,
    @location(1) surface: vec2u,
}

// TASK pack: the target, to be read.
@group(1) @binding(1) var g_surface: texture_2d<u32>;

fn signs(v: vec2f) -> vec2f {
    return select(vec2f(-1.0), vec2f(1.0), v >= vec2f(0.0));
}

// A point of the square from -1 to 1 for a direction.
fn unfold(normal: vec3f) -> vec2f {
    let n = normal / dot(abs(normal), vec3f(1.0));
    if n.z >= 0.0 {
        return n.xy;
    }
    return (1.0 - abs(n.yx)) * signs(n.xy);
}

fn fold(square: vec2f) -> vec3f {
    let height = 1.0 - abs(square.x) - abs(square.y);
    let corner = max(-height, 0.0);
    return normalize(vec3f(square - corner * signs(square), height));
}

// TASK pack: a surface becomes texels.
fn pack(emitted: vec3f, kept: Kept) -> Texels {
    let steps = vec2u(round((unfold(kept.normal) * 0.5 + 0.5) * SIDE));
    let specular = u32(round(kept.specular * 255.0));
    let gloss = log2(kept.power) / log2(POWER);
    return Texels(
        vec4f(emitted, 1.0),
        vec2u(
            steps.x | steps.y << 12u | specular << 24u,
            pack4x8unorm(vec4f(sqrt(kept.base_color), gloss)),
        ),
    );
}

// TASK pack: texels become a surface.
fn unpack(texel: vec2i) -> Kept {
    let words = textureLoad(g_surface, texel, 0).xy;
    let steps = vec2f(vec2u(words.x & 0xfffu, words.x >> 12u & 0xfffu));
    let roots = unpack4x8unorm(words.y);
    return Kept(
        fold(steps / SIDE * 2.0 - 1.0),
        roots.rgb * roots.rgb,
        f32(words.x >> 24u) / 255.0,
        exp2(roots.a * log2(POWER)),
    );
}
