// BRDFs that nobody has seen, to check the tests with.
#define_import_path suspects

const PI: f32 = 3.14159265;

struct Suspect {
    number: u32,
    exponent: f32,
}

const COUNT: u32 = 3u;

fn brdf(suspect: Suspect, to_light: vec3f, to_eye: vec3f) -> f32 {
    switch suspect.number {
        // Sends away 0.4.
        case 0u: { return to_eye.z * to_eye.z * to_eye.z / PI; }
        // Sends away 2/3 of the sine of the light.
        case 1u: { return max(-to_eye.x, 0.0) * length(to_light.xy); }
        // A lobe around +y: 0.5.
        default: { return 2.0 * to_eye.y * to_eye.y / PI; }
    }
}
