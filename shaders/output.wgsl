// Output: exposure, tone curve and exact sRGB, the last pass of every pipeline.
//
// In:  `hdr`, linear radiance; `exposure` in stops; `tone_curve`.
// Out: display-ready colours for an 8-bit target without sRGB conversion.
#import lightbench::color

struct Parameters {
    exposure: f32,
    tone_curve: u32,
}

@group(1) @binding(0) var hdr: texture_2d<f32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let radiance = max(textureLoad(hdr, vec2i(pixel.xy), 0).rgb, vec3f(0.0));
    let exposed = radiance * exp2(parameters.exposure);
    return vec4f(color::encode_srgb(color::tone_map(exposed, parameters.tone_curve)), 1.0);
}
