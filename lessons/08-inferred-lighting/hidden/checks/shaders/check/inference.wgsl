// Calls one function of shaders/lib/inference.wgsl for each pixel of a picture of 33 × 24.
//
// In:  which function, and its arguments, as far as they do not come from the pixel's place.
// Out: what it gives. Keys come as their lower bits, those above, and 1 where all is 0.
#import inference

struct Parameters {
    function: u32,
    bits: f32,
    object: f32,
    farthest: f32,
    expected: f32,
    tolerance: f32,
    layer: f32,
    kept: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let u = f32(pixel.x) / 32.0;
    let v = f32(pixel.y) / 23.0;
    let bits = u32(parameters.bits);
    let codes = (1u << bits) - 1u;
    let object = u32(parameters.object);
    switch parameters.function {
        case 0u: {
            // From 0.1 m on, each pixel the same factor farther.
            let key = inference::pack_surface(0.1 * pow(10.0 * parameters.farthest, u), object + pixel.y);
            return vec4f(f32(key & codes), f32(key >> bits), select(0.0, 1.0, key == 0u), 1.0);
        }
        case 1u: {
            let code = 1u + u32(pixel.x) * (codes - 1u) / 32u;
            return vec4f(inference::distance_of((object + pixel.y) << bits | code), 0.0, 0.0, 1.0);
        }
        case 2u: {
            let slope = vec2f(0.004 * (u - 0.3), 0.003 * (v - 0.6));
            let there = inference::expected_distance(parameters.expected, slope, vec2f(4.0 * v, 3.0 - 5.0 * u));
            return vec4f(there, 0.0, 0.0, 1.0);
        }
        case 3u: {
            // Rows: the same object, another one, one that is the same but for a high bit, and none.
            let code = 1u + u32(pixel.x) * (codes - 1u) / 32u;
            var key = object << bits | code;
            switch pixel.y % 4u {
                case 1u: { key = (object + 1u) << bits | code; }
                case 2u: { key = (object ^ 64u) << bits | code; }
                case 3u: { key = 0u; }
                default: {}
            }
            let same = inference::is_same(key, object, parameters.expected, parameters.tolerance);
            return vec4f(select(0.0, 1.0, same), 0.0, 0.0, 1.0);
        }
        case 4u, 5u: {
            let kept = u32(parameters.kept);
            let same = (vec4u(kept) >> vec4u(0u, 1u, 2u, 3u) & vec4u(1u)) == vec4u(1u);
            let found = inference::weights(vec2f(u, v), same);
            if parameters.function == 4u {
                return vec4f(found.xyz, 1.0);
            }
            let others = select(found, vec4f(0.0), same);
            return vec4f(found.w, dot(found, vec4f(1.0)), dot(abs(others), vec4f(1.0)), 1.0);
        }
        case 6u: {
            return vec4f(select(0.0, 1.0, inference::is_of_layer(pixel, u32(parameters.layer))), 0.0, 0.0, 1.0);
        }
        default: {
            // In texels.
            let at = vec2f(pixel) * 0.37 + 4.1;
            let around = inference::layer_footprint(at, u32(parameters.layer));
            let fraction = select(around.fraction.y, around.fraction.x, parameters.function == 7u);
            return vec4f(vec2f(around.corner), fraction, 1.0);
        }
    }
}
