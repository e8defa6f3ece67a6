// Calls one function for each pixel of a picture of 64 × 36; `checks.rhai` has the same arguments.
#import reflection

struct Parameters {
    function: u32,
    shape: f32,                         // exponent, roughness or index
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

fn direction(degrees: f32, around: f32) -> vec3f {
    let angle = radians(degrees);
    return vec3f(sin(angle) * cos(radians(around)), sin(angle) * sin(radians(around)), cos(angle));
}

// The cosine of an angle from 0 to 90 degrees, from the Taylor series of the sine of its half. A driver's own
// may be off by 2⁻¹¹ (the Vulkan specification, "Precision and operation of SPIR-V instructions"), and where
// the surface is smooth, its density makes a hundredfold of that.
fn cosine(degrees: f32) -> f32 {
    let half = radians(0.5 * degrees);
    let square = half * half;
    let inner = 1.0 - square / 42.0 * (1.0 - square / 72.0);
    let sine = half * (1.0 - square / 6.0 * (1.0 - square / 20.0 * inner));
    return 1.0 - 2.0 * sine * sine;
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let u = pixel.x / 64.0;
    let v = pixel.y / 36.0;
    let to_light = direction(160.0 * u - 80.0, 0.0);
    let to_eye = direction(160.0 * v - 80.0, 50.0);
    let up = vec3f(0.0, 0.0, 1.0);
    var value = 0.0;
    switch parameters.function {
        case 0u: { value = reflection::blinn_phong(parameters.shape, to_light, to_eye); }
        case 1u: { value = reflection::blinn_phong(parameters.shape, to_eye, to_light); }
        // Light from above, the eye at 256 angles down to the horizon.
        case 2u: { value = reflection::blinn_phong(parameters.shape, up, direction(90.0 * pixel.x / 256.0, 30.0)); }
        case 3u: { value = reflection::facets(parameters.shape, cosine(90.0 * pixel.x / 256.0)); }
        case 4u: { value = reflection::fresnel(u, parameters.shape); }
        case 5u: { value = reflection::masking(to_light, to_eye); }
        case 6u: { value = reflection::cook_torrance(0.7, parameters.shape, to_light, to_eye); }
        // The light sinks below the horizon, or the eye does.
        default: {
            let below = direction(90.5 + 20.0 * u, 0.0);
            let above = direction(60.0, 120.0);
            if v < 0.5 {
                value = reflection::cook_torrance(0.7, parameters.shape, below, above);
            } else {
                value = reflection::cook_torrance(0.7, parameters.shape, above, below);
            }
        }
    }
    return vec4f(vec3f(value), 1.0);
}
