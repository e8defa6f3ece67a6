// Calls one function for each pixel of a picture of 64 × 36; `checks.rhai` has the same arguments.
#import by_hand

struct Parameters {
    function: u32,
    shininess: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// Three directions at right angles.
const N = vec3f(1.0, 2.0, 2.0) / 3.0;
const T = vec3f(2.0, -2.0, 1.0) / 3.0;
const B = vec3f(2.0, 1.0, -2.0) / 3.0;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 64.0;
    let v = pixel.y / 36.0;
    let arriving = vec3f(6.0, 3.0, 1.5);
    switch parameters.function {
        case 0u: {
            // From half a metre to five, from straight above to 30 degrees below the horizon.
            let angle = radians(120.0 * v);
            let to_light = (0.5 + 4.5 * u) * (cos(angle) * N + sin(angle) * T);
            return vec4f(by_hand::irradiance(arriving, to_light, N), 1.0);
        }
        case 1u: {
            return vec4f(by_hand::lambert(vec3f(u, 0.5 * u, 1.0), arriving * v), 1.0);
        }
        default: {
            let light = radians(170.0 * u - 85.0);
            let eye = radians(170.0 * v - 85.0);
            let to_light = cos(light) * N + sin(light) * T;
            let aside = cos(radians(40.0)) * T + sin(radians(40.0)) * B;
            let to_eye = cos(eye) * N + sin(eye) * aside;
            let strength = vec3f(0.9, 0.5, 0.1);
            if parameters.function == 3u {
                return vec4f(by_hand::blinn_phong(strength, parameters.shininess, N, to_eye, to_light, arriving), 1.0);
            }
            return vec4f(by_hand::blinn_phong(strength, parameters.shininess, N, to_light, to_eye, arriving), 1.0);
        }
    }
}
