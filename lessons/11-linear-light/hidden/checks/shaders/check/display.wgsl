// Calls one function for each pixel of a picture of 90 × 12; `checks.rhai` beside this folder has the same
// arguments.
#import display

struct Parameters {
    function: u32,
    largest: f32,
    share: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 90.0;
    let v = pixel.y / 12.0;
    let number = parameters.largest * u;
    switch parameters.function {
        case 0u: { return vec4f(vec3f(display::encode(number)), 1.0); }
        case 1u: { return vec4f(vec3f(display::decode(number)), 1.0); }
        case 2u: { return vec4f(vec3f(display::decode(display::encode(number))), 1.0); }
        case 3u: { return vec4f(vec3f(display::encode(display::decode(number))), 1.0); }
        case 4u: { return vec4f(vec3f(display::average(u, v, parameters.share)), 1.0); }
        case 5u: { return vec4f(vec3f(display::average(u, u, v)), 1.0); }
        case 6u: { return vec4f(display::tone(vec3f(number)), 1.0); }
        // A blue that has next to no red, and a colour that is nearly white.
        case 7u: { return vec4f(display::tone(number * vec3f(0.02, 0.9 * v, 1.0)), 1.0); }
        default: { return vec4f(display::tone(number * vec3f(0.9, 1.0, 0.5 + 0.5 * v)), 1.0); }
    }
}
