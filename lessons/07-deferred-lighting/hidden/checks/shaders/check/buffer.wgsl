// Calls one function for each pixel of a picture of 40 × 30; `checks.rhai` beside this folder has the same
// arguments.
//
// In:  the pixel; `called`.
// Out: a target of `gather`, or what `meet` gives.
#import own_buffer

struct Parameters {
    called: u32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 40.0;
    let v = pixel.y / 30.0;
    let facing = vec3f(0.4 + 2.0 * u, 5.0 * v, 0.9);
    switch parameters.called {
        case 0u: { return own_buffer::gather(facing, u - v, 0.5 + 3.0 * v).front; }
        case 1u: { return own_buffer::gather(facing, u - v, 0.5 + 3.0 * v).back; }
        default: {
            let material = own_buffer::Material(
                vec3f(0.2, u, 0.7), vec3f(v, 0.1, 0.4), vec3f(0.05, 0.6, u), vec3f(0.3, 0.0, v),
            );
            let light = own_buffer::Gathered(
                vec4f(1.0 + u, 0.2, 3.0 * v, 4.0 * u * v),
                vec4f(0.5, 2.0 * v, u, 0.0),
            );
            return vec4f(own_buffer::meet(material, light), 1.0);
        }
    }
}
