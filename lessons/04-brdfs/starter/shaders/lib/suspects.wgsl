// The BRDFs that are put on trial.
//
// In:  directions of length 1, away from the surface, in the surface's own frame: x and y lie in it, z is its
//      normal.
// Out: the BRDF in 1/sr, for a reflectance of 1.
#define_import_path suspects
#import reflection

const PI: f32 = 3.14159265;

struct Suspect {
    number: u32,
    exponent: f32,                      // n, of the lobes that have one
}

// The number of BRDFs.
const COUNT: u32 = 7u;

// The roughness of Ward's lobe and of Cook and Torrance's, and the index of refraction of the latter.
const ROUGHNESS: f32 = 0.2;
const INDEX: f32 = 1.5;

fn brdf(suspect: Suspect, to_light: vec3f, to_eye: vec3f) -> f32 {
    let between = normalize(to_light + to_eye);
    let facing = max(between.z, 0.0);
    switch suspect.number {
        // Lambert 1760, "Photometria".
        case 0u: { return 1.0 / PI; }
        // Phong 1975, "Illumination for Computer Generated Pictures": (R·V)ⁿ / N·L.
        case 1u: {
            let mirrored = vec3f(-to_light.xy, to_light.z);
            return power(dot(mirrored, to_eye), suspect.exponent) / to_light.z;
        }
        // Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures": (N·H)ⁿ / N·L.
        case 2u: { return power(facing, suspect.exponent) / to_light.z; }
        // The same without the division, known as modified Blinn-Phong.
        case 3u: { return power(facing, suspect.exponent); }
        // Ward 1992, "Measuring and Modeling Anisotropic Reflection", equation 5, for a surface without grooves.
        case 4u: {
            let tangent_squared = (1.0 - facing * facing) / (facing * facing);
            let spread = 4.0 * PI * ROUGHNESS * ROUGHNESS;
            return exp(-tangent_squared / (ROUGHNESS * ROUGHNESS)) / (spread * sqrt(to_light.z * to_eye.z));
        }
        // Yours.
        case 5u: { return reflection::blinn_phong(suspect.exponent, to_light, to_eye); }
        default: {
            let share = reflection::facets(ROUGHNESS, facing);
            return reflection::cook_torrance(share, INDEX, to_light, to_eye);
        }
    }
}

fn power(cosine: f32, exponent: f32) -> f32 {
    return pow(max(cosine, 0.0), exponent);
}
