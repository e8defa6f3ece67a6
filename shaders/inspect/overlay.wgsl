// Inspect: a map in false colours over the picture that it belongs to.
//
// In:  a display-ready picture and a painted map of one size; how much the map covers.
// Out: the map over the picture's luminance, so that all colour is the map's.

struct Overlay {
    opacity: f32,
    padding: vec2f,
}

@group(0) @binding(0) var<uniform> overlay: Overlay;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var map: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    // Weights of Rec. 709, of values coded for a display: near enough to tell where things are.
    let grey = dot(textureLoad(picture, texel, 0).rgb, vec3f(0.2126, 0.7152, 0.0722));
    let color = textureLoad(map, texel, 0).rgb;
    return vec4f(mix(vec3f(grey), color, overlay.opacity), 1.0);
}
