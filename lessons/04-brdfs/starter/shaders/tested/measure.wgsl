// Puts each BRDF to both tests.
//
// In:  the texel: its column is the angle of the light, its row the BRDF.
// Out: how much is sent away; and by how much the BRDF changes at the most when lamp and eye change places.
#import suspects
#import measure

struct Parameters {
    exponent: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

// Eyes at 4 angles from the normal, in 4 directions each.
fn largest_asymmetry(suspect: suspects::Suspect, to_light: vec3f) -> f32 {
    var largest = 0.0;
    for (var i = 0u; i < 16u; i++) {
        let angle = radians(20.0 + 20.0 * f32(i / 4u));
        let around = radians(10.0 + 90.0 * f32(i % 4u));
        let to_eye = vec3f(sin(angle) * cos(around), sin(angle) * sin(around), cos(angle));
        largest = max(largest, measure::asymmetry(suspect, to_light, to_eye));
    }
    return largest;
}

@fragment
fn fragment_main(@builtin(position) texel: vec4f) -> @location(0) vec4f {
    let suspect = suspects::Suspect(u32(texel.y), parameters.exponent);
    let angle = radians(texel.x);
    let to_light = vec3f(sin(angle), 0.0, cos(angle));
    return vec4f(measure::albedo(suspect, to_light), largest_asymmetry(suspect, to_light), 0.0, 1.0);
}
