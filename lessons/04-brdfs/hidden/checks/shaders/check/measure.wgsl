// Calls one function for each pixel of a picture of 12 × 9; `checks.rhai` has the same directions.
#import suspects
#import measure

struct Parameters {
    function: u32,
    number: f32,
    exponent: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

fn direction(degrees: f32, around: f32) -> vec3f {
    let angle = radians(degrees);
    return vec3f(sin(angle) * cos(radians(around)), sin(angle) * sin(radians(around)), cos(angle));
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let suspect = suspects::Suspect(u32(parameters.number), parameters.exponent);
    // Every 7 degrees.
    let to_light = direction(7.0 * floor(pixel.x), 110.0);
    if parameters.function == 1u {
        return vec4f(vec3f(measure::albedo(suspect, to_light)), 1.0);
    }
    let to_eye = direction(8.0 * floor(pixel.y) + 3.0, 200.0);
    return vec4f(vec3f(measure::asymmetry(suspect, to_light, to_eye)), 1.0);
}
