// What of a pixel is brighter than the display can show.
//
// In:  linear radiance.
// Out: the part above 1 of each channel.

@group(1) @binding(0) var hdr: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let radiance = textureLoad(hdr, vec2i(pixel.xy), 0).rgb;
    return vec4f(max(radiance - 1.0, vec3f(0.0)), 1.0);
}
