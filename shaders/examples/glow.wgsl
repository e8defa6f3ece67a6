// A glow around bright pixels, from smaller pictures of them.
//
// In:  the bright parts of the picture at all mip levels; `glow`.
// Out: radiance to add: `glow` times the sum of the smaller levels, filtered.

struct Parameters {
    glow: f32,
}

@group(1) @binding(0) var bright: texture_2d<f32>;
@group(1) @binding(1) var linear_sampler: sampler;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let place = pixel.xy / vec2f(textureDimensions(bright));
    var sum = vec3f(0.0);
    for (var level = 1u; level < textureNumLevels(bright); level++) {
        sum += textureSampleLevel(bright, linear_sampler, place, f32(level)).rgb;
    }
    return vec4f(parameters.glow * sum, 0.0);
}
