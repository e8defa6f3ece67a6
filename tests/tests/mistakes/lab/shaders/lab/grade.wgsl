// Lifts the dark parts of the picture, more where all around is dark.
#import lightbench::lab

struct Parameters {
    strength: f32,
}

@group(1) @binding(0) var hdr: texture_2d<f32>;
@group(1) @binding(1) var small: texture_2d<f32>;
@group(1) @binding(2) var linear_sampler: sampler;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let uv = pixel.xy / vec2f(textureDimensions(hdr));
    let color = textureLoad(hdr, vec2i(pixel.xy), 0).rgb;
    let around = textureSampleLevel(small, linear_sampler, uv, 0.0).rgb;
    return vec4f(lab::lift(color, around, parameters.strength), 1.0);
}
