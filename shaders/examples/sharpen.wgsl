// Sharpens the picture: what a pixel has more or less than its neighbours is raised.
//
// In:  linear radiance; `sharpness`, 0 for none.
// Out: p + sharpness · (p - mean of the four neighbours), never below 0.

struct Parameters {
    sharpness: f32,
}

@group(1) @binding(0) var before: texture_2d<f32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn texel(at: vec2i) -> vec3f {
    let last = vec2i(textureDimensions(before)) - 1;
    return textureLoad(before, clamp(at, vec2i(0), last), 0).rgb;
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let at = vec2i(pixel.xy);
    let here = texel(at);
    let across = texel(at - vec2i(1, 0)) + texel(at + vec2i(1, 0));
    let down = texel(at - vec2i(0, 1)) + texel(at + vec2i(0, 1));
    let sharp = here + parameters.sharpness * (here - 0.25 * (across + down));
    return vec4f(max(sharp, vec3f(0.0)), 1.0);
}
