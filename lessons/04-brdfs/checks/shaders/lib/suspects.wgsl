// BRDFs to check the tests with: those of the lesson without the student's, and some whose sums are known.
#define_import_path suspects

const PI: f32 = 3.14159265;

struct Suspect {
    number: u32,
    exponent: f32,
}

const COUNT: u32 = 7u;
const ROUGHNESS: f32 = 0.2;

fn brdf(suspect: Suspect, to_light: vec3f, to_eye: vec3f) -> f32 {
    let facing = max(normalize(to_light + to_eye).z, 0.0);
    switch suspect.number {
        // Those of the starter.
        case 0u: { return 1.0 / PI; }
        case 1u: { return power(dot(vec3f(-to_light.xy, to_light.z), to_eye), suspect.exponent) / to_light.z; }
        case 2u: { return power(facing, suspect.exponent) / to_light.z; }
        case 3u: { return power(facing, suspect.exponent); }
        case 4u: {
            let tangent_squared = (1.0 - facing * facing) / (facing * facing);
            let spread = 4.0 * PI * ROUGHNESS * ROUGHNESS;
            return exp(-tangent_squared / (ROUGHNESS * ROUGHNESS)) / (spread * sqrt(to_light.z * to_eye.z));
        }
        // A matt surface that sends away 0.6.
        case 100u: { return 0.6 / PI; }
        // Sends away 0.5, and most of it upwards.
        case 101u: { return to_eye.z * to_eye.z / PI; }
        // Send light into a quarter of the directions, and into half of them: 0.5 and 0.6.
        case 102u: { return 4.0 * max(to_eye.x, 0.0) * max(to_eye.y, 0.0); }
        case 103u: { return 0.9 * max(-to_eye.y, 0.0); }
        // Sends away as much as the cosine of the light says.
        case 104u: { return to_light.z / PI; }
        // Nothing.
        default: { return 0.0; }
    }
}

fn power(cosine: f32, exponent: f32) -> f32 {
    return pow(max(cosine, 0.0), exponent);
}
