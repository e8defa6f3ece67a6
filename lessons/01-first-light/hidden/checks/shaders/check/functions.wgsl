// Calls one function for each pixel of a picture of 48 × 32, each pixel with a normal of its own;
// `checks.rhai` beside this folder has the same arguments.
#import by_hand

struct Parameters {
    function: u32,
    shininess: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 48.0;
    let v = pixel.y / 32.0;
    let arriving = vec3f(0.7, 11.0, 2.5);
    let normal = normalize(vec3f(u - 0.4, 0.8, v - 0.3));
    switch parameters.function {
        case 0u: {
            let to_light = vec3f(2.0 * v - 1.5, 2.2 * u - 0.6, 1.7);
            return vec4f(by_hand::irradiance(arriving, to_light, normal), 1.0);
        }
        case 1u: {
            return vec4f(by_hand::lambert(vec3f(0.3, v, 0.9 * u), arriving * (0.2 + u)), 1.0);
        }
        default: {
            let to_light = normalize(vec3f(v - 0.2, 1.1, 0.4 - u));
            let to_eye = normalize(vec3f(0.9 - u, 0.7, v));
            let strength = vec3f(0.05, 0.4, 1.0);
            return vec4f(by_hand::blinn_phong(strength, parameters.shininess, normal, to_light, to_eye, arriving), 1.0);
        }
    }
}
