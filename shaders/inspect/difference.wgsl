// Inspect: the absolute difference of two pictures, made visible by a factor.
//
// In:  two display-ready pictures of one size; the factor; how the difference is shown.
// Out: the difference of each channel times the factor, or the largest of the three as a false colour.
#import lightbench::color_map

struct Difference {
    gain: f32,
    map: f32,       // 1: false colours; 0: each channel on its own
    padding: vec2f,
}

@group(0) @binding(0) var<uniform> difference: Difference;
@group(0) @binding(1) var first: texture_2d<f32>;
@group(0) @binding(2) var second: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let a = textureLoad(first, texel, 0).rgb;
    let b = textureLoad(second, texel, 0).rgb;
    let found = saturate(abs(a - b) * difference.gain);
    if difference.map > 0.5 {
        let largest = max(found.r, max(found.g, found.b));
        return vec4f(saturate(color_map::viridis(largest)), 1.0);
    }
    return vec4f(found, 1.0);
}
