// Calls one function for each pixel of a picture of 64 × 36; `checks.rhai` has the same arguments.
#import lightbench::scene
#import bounds

struct Parameters {
    function: u32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// Six planes around a part of space, which no camera has.
fn planes() -> array<vec4f, 6> {
    return array<vec4f, 6>(
        vec4f(normalize(vec3f(1.0, 0.0, -0.6)), 1.5),
        vec4f(normalize(vec3f(-1.0, 0.1, -0.5)), 2.0),
        vec4f(normalize(vec3f(0.0, 1.0, -0.4)), 1.2),
        vec4f(normalize(vec3f(0.1, -1.0, -0.5)), 1.0),
        vec4f(0.0, 0.0, -1.0, -0.3),
        vec4f(normalize(vec3f(0.0, 0.1, 1.0)), 9.0),
    );
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 64.0;
    let v = pixel.y / 36.0;
    let middle = vec3f(14.0 * u - 7.0, 8.0 * v - 4.0, -5.0 + 6.0 * sin(40.0 * u + 25.0 * v));
    // Turned around y and x.
    let a = 7.0 * u + 3.0 * v;
    let b = 5.0 * v;
    let halves = mat3x3f(
        1.4 * vec3f(cos(a), 0.0, -sin(a)),
        0.3 * vec3f(sin(a) * sin(b), cos(b), cos(a) * sin(b)),
        (0.15 + 0.5 * u) * vec3f(sin(a) * cos(b), -sin(b), cos(a) * cos(b)),
    );
    var value = 0.0;
    switch parameters.function {
        // A point for each column, and a plane for each six rows.
        case 0u, 1u: {
            let plane = bounds::plane(scene::frame.view_projection, u32(pixel.y) / 6u);
            let x = floor(pixel.x);
            let point = vec3f(12.0 * sin(1.7 * x), 6.0 * cos(2.3 * x), -8.0 + 14.0 * sin(0.9 * x));
            value = dot(plane, vec4f(point, 1.0));
            if parameters.function == 1u {
                value = select(0.0, 1.0, value > 0.0);
            }
        }
        case 2u: { value = bounds::radius_around(halves); }
        case 3u: { value = select(0.0, 1.0, bounds::sphere_meets(planes(), middle, 0.2 + 1.3 * v)); }
        case 4u: { value = select(0.0, 1.0, bounds::box_meets(planes(), middle, halves)); }
        // The lamp is somewhere near the box.
        default: {
            let lamp = middle + vec3f(3.0 * sin(31.0 * u), 2.0 * sin(17.0 * v), 3.0 * cos(23.0 * u + 9.0 * v));
            value = select(0.0, 1.0, bounds::lamp_reaches(lamp, 1.8, middle, halves));
        }
    }
    return vec4f(vec3f(value), 1.0);
}
