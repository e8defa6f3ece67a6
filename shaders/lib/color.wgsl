// From linear light to what a display shows.
//
// In:  linear Rec. 709 colours.
// Out: tone-mapped linear colours in 0…1, and their exact sRGB coding (IEC 61966-2-1).
#define_import_path lightbench::color

// The order of the names in scripts/pipelines/parts/output.rhai.
const CURVE_HABLE: u32 = 0u;
const CURVE_REINHARD: u32 = 1u;
const CURVE_HEJL: u32 = 2u;
const CURVE_LINEAR: u32 = 3u;

// The exact sRGB code of linear values (IEC 61966-2-1).
fn encode_srgb(color: vec3f) -> vec3f {
    let low = color * 12.92;
    let high = 1.055 * pow(max(color, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, color <= vec3f(0.0031308));
}

// Reinhard et al. 2002, "Photographic Tone Reproduction", equation 3, a channel at a time.
fn tone_reinhard(color: vec3f) -> vec3f {
    return color / (1.0 + color);
}

// Hable 2010, "Uncharted 2: HDR Lighting" (GDC), with the talk's constants and white at 11.2.
fn hable_curve(x: vec3f) -> vec3f {
    const A = 0.22; // shoulder strength
    const B = 0.30; // linear strength
    const C = 0.10; // linear angle
    const D = 0.20; // toe strength
    const E = 0.01; // toe numerator
    const F = 0.30; // toe denominator
    return (x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F) - E / F;
}

// The same, scaled so that 11.2 becomes 1.
fn tone_hable(color: vec3f) -> vec3f {
    return hable_curve(color) / hable_curve(vec3f(11.2));
}

// Hejl and Burgess-Dawson 2010, "Filmic Tonemapping for Real-time Rendering". The published fit
// includes the display's gamma of 2.2, which is undone here so that every curve ends linear.
fn tone_hejl(color: vec3f) -> vec3f {
    let x = max(color - 0.004, vec3f(0.0));
    let coded = x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06);
    return pow(coded, vec3f(2.2));
}

// One of the curves by its number, cut off at 0 and 1.
fn tone_map(color: vec3f, curve: u32) -> vec3f {
    var mapped = color;
    switch curve {
        case CURVE_HABLE: { mapped = tone_hable(color); }
        case CURVE_REINHARD: { mapped = tone_reinhard(color); }
        case CURVE_HEJL: { mapped = tone_hejl(color); }
        default: {}
    }
    return saturate(mapped);
}
