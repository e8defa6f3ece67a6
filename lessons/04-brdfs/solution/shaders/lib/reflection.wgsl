// Two BRDFs.
#define_import_path reflection

const PI: f32 = 3.14159265;

// How fast the density of facets falls.
const GAMMA: f32 = 2.75;

// TASK blinn_phong: (N·H)ⁿ / V·H, scaled so that all light from straight above is sent away.
//
// With c the cosine of half the angle between N and V, the sum over the hemisphere is that of
// 8π (2c^(n+2) - c^n) from c = 1/√2 to 1.
fn blinn_phong(exponent: f32, to_light: vec3f, to_eye: vec3f) -> f32 {
    let a = exponent + 1.0;
    let b = exponent + 3.0;
    let sum = 8.0 * PI * (2.0 * (1.0 - exp2(-0.5 * b)) / b - (1.0 - exp2(-0.5 * a)) / a);
    let between = normalize(to_light + to_eye);
    return pow(max(between.z, 0.0), exponent) / (dot(to_eye, between) * sum);
}

// TASK facets: Burley 2012, "Physically Based Shading at Disney".
fn facets(roughness: f32, facing: f32) -> f32 {
    let squared = roughness * roughness;
    let scale = (GAMMA - 1.0) * (squared - 1.0) / (PI * (1.0 - pow(squared, 1.0 - GAMMA)));
    return scale * pow(1.0 + (squared - 1.0) * facing * facing, -GAMMA);
}

// TASK cook_torrance: Fresnel's equations, the mean of both polarisations.
fn fresnel(cosine: f32, index: f32) -> f32 {
    let inside = sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    let across = (cosine - index * inside) / (cosine + index * inside);
    let along = (index * cosine - inside) / (index * cosine + inside);
    return 0.5 * (across * across + along * along);
}

// TASK cook_torrance: grooves of the shape of a V (Torrance and Sparrow 1967).
fn masking(to_light: vec3f, to_eye: vec3f) -> f32 {
    let between = normalize(to_light + to_eye);
    let slope = 2.0 * between.z / dot(to_eye, between);
    return min(1.0, slope * min(to_light.z, to_eye.z));
}

// TASK cook_torrance: F D G / (4 N·L N·V).
fn cook_torrance(density: f32, index: f32, to_light: vec3f, to_eye: vec3f) -> f32 {
    if min(to_light.z, to_eye.z) <= 0.0 {
        return 0.0;
    }
    let mirrored = fresnel(dot(to_eye, normalize(to_light + to_eye)), index);
    return mirrored * density * masking(to_light, to_eye) / (4.0 * to_light.z * to_eye.z);
}
