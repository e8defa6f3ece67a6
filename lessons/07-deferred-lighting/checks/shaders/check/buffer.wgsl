// Calls one function for each pixel of a picture of 64 × 36; `checks.rhai` has the same arguments.
//
// In:  the pixel; `called`.
// Out: a target of `gather`, or the alpha of one; or what `meet` gives.
#import own_buffer

struct Parameters {
    called: u32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 64.0;
    let v = pixel.y / 36.0;
    let nothing = vec3f(0.0);
    let none = vec4f(0.0);
    switch parameters.called {
        // A lamp from straight above to straight below, and a highlight that grows to the right.
        case 0u: { return own_buffer::gather(vec3f(6.0, 1.0, 3.0), 1.0 - 2.0 * v, 4.0 * u).front; }
        case 1u: { return own_buffer::gather(vec3f(6.0, 1.0, 3.0), 1.0 - 2.0 * v, 4.0 * u).back; }
        case 2u: { return own_buffer::gather(vec3f(6.0, 1.0, 3.0), 1.0 - 2.0 * v, 4.0 * u).front.aaaa; }
        case 3u: {
            let material = own_buffer::Material(vec3f(u, 0.5, 1.0), nothing, nothing, vec3f(0.0, 0.25, v));
            let light = own_buffer::Gathered(vec4f(4.0 * v, 2.0, 1.0, 0.0), none);
            return vec4f(own_buffer::meet(material, light), 1.0);
        }
        case 4u: {
            let material = own_buffer::Material(nothing, vec3f(u, 0.5, 1.0), nothing, nothing);
            let light = own_buffer::Gathered(none, vec4f(4.0 * v, 2.0, 1.0, 0.0));
            return vec4f(own_buffer::meet(material, light), 1.0);
        }
        case 5u: {
            let material = own_buffer::Material(nothing, nothing, vec3f(u, 0.5, 1.0), nothing);
            let light = own_buffer::Gathered(vec4f(0.5 + v, 0.8, 0.3, 5.0 * v), none);
            return vec4f(own_buffer::meet(material, light), 1.0);
        }
        default: {
            let white = vec3f(1.0);
            let material = own_buffer::Material(white, white, white, vec3f(u, 0.5, v));
            return vec4f(own_buffer::meet(material, own_buffer::Gathered(none, none)), 1.0);
        }
    }
}
