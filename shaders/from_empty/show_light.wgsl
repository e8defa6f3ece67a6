// From empty, step 4: light as a picture, cut off at 1.
//
// In:  linear radiance.
// Out: its sRGB code (IEC 61966-2-1), from 0 to 1.
#import lightbench::color

@group(1) @binding(0) var hdr: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let radiance = textureLoad(hdr, vec2i(pixel.xy), 0).rgb;
    return vec4f(color::encode_srgb(saturate(radiance)), 1.0);
}
