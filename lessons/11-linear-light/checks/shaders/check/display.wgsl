// Calls one function for each pixel of a picture of 128 × 16; `checks.rhai` has the same arguments.
#import display

struct Parameters {
    function: u32,
    largest: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = floor(pixel.x) / 127.0;
    let v = floor(pixel.y) / 15.0;
    let light = parameters.largest * u;
    switch parameters.function {
        case 0u: { return vec4f(vec3f(display::encode(light)), 1.0); }
        case 1u: {
            return vec4f(display::decode(display::encode(light)), display::encode(display::decode(light)), 0.0, 1.0);
        }
        case 2u: { return vec4f(vec3f(display::average(v, 1.0 - v * v, u)), 1.0); }
        case 3u: { return vec4f(display::tone(vec3f(light)), 1.0); }
        default: { return vec4f(display::tone(light * vec3f(1.0, 0.6 * v + 0.2, 0.1)), 1.0); }
    }
}
