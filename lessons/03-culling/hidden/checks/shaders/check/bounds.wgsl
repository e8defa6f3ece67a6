// Calls one function for each pixel of a picture of 48 × 32; `checks.rhai` has the same arguments.
#import lightbench::scene
#import bounds

struct Parameters {
    function: u32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// Six planes around a part of space, which no camera has.
fn planes() -> array<vec4f, 6> {
    return array<vec4f, 6>(
        vec4f(normalize(vec3f(1.0, 0.3, 0.8)), 2.5),
        vec4f(normalize(vec3f(-1.0, 0.2, 0.4)), 1.5),
        vec4f(normalize(vec3f(0.2, 1.0, 0.3)), 2.2),
        vec4f(normalize(vec3f(0.0, -1.0, 0.6)), 1.8),
        vec4f(0.0, 0.0, 1.0, 0.5),
        vec4f(normalize(vec3f(0.1, 0.0, -1.0)), 7.0),
    );
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 48.0;
    let v = pixel.y / 32.0;
    let middle = vec3f(9.0 * v - 4.5, 5.0 * cos(33.0 * u + 14.0 * v), 11.0 * u - 2.0);
    // Turned around y and x.
    let a = 4.0 * v - 9.0 * u;
    let b = 6.0 * u + 1.0;
    let halves = mat3x3f(
        (0.2 + v) * vec3f(cos(a), 0.0, -sin(a)),
        1.9 * vec3f(sin(a) * sin(b), cos(b), cos(a) * sin(b)),
        0.25 * vec3f(sin(a) * cos(b), -sin(b), cos(a) * cos(b)),
    );
    var value = 0.0;
    switch parameters.function {
        // A point for each column, and a plane for each row.
        case 0u, 1u: {
            let plane = bounds::plane(scene::frame.view_projection, u32(pixel.y) % 6u);
            let x = floor(pixel.x);
            let point = vec3f(9.0 * cos(1.3 * x), 2.0 + 6.0 * sin(2.9 * x), 3.0 + 9.0 * sin(0.7 * x));
            value = dot(plane, vec4f(point, 1.0));
            if parameters.function == 1u {
                value = select(0.0, 1.0, value > 0.0);
            }
        }
        case 2u: { value = bounds::radius_around(halves); }
        case 3u: { value = select(0.0, 1.0, bounds::sphere_meets(planes(), middle, 0.9 * u)); }
        case 4u: { value = select(0.0, 1.0, bounds::box_meets(planes(), middle, halves)); }
        // The lamp is somewhere near the box.
        default: {
            let lamp = middle + vec3f(2.5 * sin(19.0 * v), 3.5 * cos(27.0 * u), 2.0 * sin(13.0 * u + 21.0 * v));
            value = select(0.0, 1.0, bounds::lamp_reaches(lamp, 0.9, middle, halves));
        }
    }
    return vec4f(vec3f(value), 1.0);
}
