// The last pass: light becomes what a display takes.
//
// In:  `light`, linear radiance.
// Out: values of the display from 0 to 1.
#import display

@group(1) @binding(0) var light: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let radiance = textureLoad(light, vec2i(pixel.xy), 0).rgb;
    let toned = clamp(display::tone(radiance), vec3f(0.0), vec3f(1.0));
    return vec4f(display::encode(toned.r), display::encode(toned.g), display::encode(toned.b), 1.0);
}
