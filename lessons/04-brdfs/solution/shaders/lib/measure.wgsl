// Two tests of a BRDF.
#define_import_path measure
#import suspects

const PI: f32 = 3.14159265;

// Directions of the eye that are summed over: from the normal to the horizon, and around it.
const ANGLES: u32 = 90u;
const AROUND: u32 = 90u;

// TASK reciprocity: |f(L, V) - f(V, L)| over the larger of the two.
fn asymmetry(suspect: suspects::Suspect, to_light: vec3f, to_eye: vec3f) -> f32 {
    let there = suspects::brdf(suspect, to_light, to_eye);
    let back = suspects::brdf(suspect, to_eye, to_light);
    let larger = max(there, back);
    if larger <= 0.0 {
        return 0.0;
    }
    return abs(there - back) / larger;
}

// TASK energy: the sum of f cos θ sin θ dθ dφ, each at the middle of its patch.
fn albedo(suspect: suspects::Suspect, to_light: vec3f) -> f32 {
    let step = 0.5 * PI / f32(ANGLES);
    let turn = 2.0 * PI / f32(AROUND);
    var sum = 0.0;
    for (var i = 0u; i < ANGLES; i++) {
        let angle = (f32(i) + 0.5) * step;
        for (var j = 0u; j < AROUND; j++) {
            let around = (f32(j) + 0.5) * turn;
            let to_eye = vec3f(sin(angle) * cos(around), sin(angle) * sin(around), cos(angle));
            sum += suspects::brdf(suspect, to_light, to_eye) * cos(angle) * sin(angle);
        }
    }
    return sum * step * turn;
}
