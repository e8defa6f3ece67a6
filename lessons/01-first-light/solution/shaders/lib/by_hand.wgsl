// What light does to a surface, by hand.
#define_import_path by_hand

const PI: f32 = 3.14159265;

// TASK irradiance: I cos θ / d².
fn irradiance(intensity: vec3f, to_light: vec3f, normal: vec3f) -> vec3f {
    let squared = dot(to_light, to_light);
    let cosine = dot(normal, to_light) * inverseSqrt(squared);
    return intensity * max(cosine, 0.0) / squared;
}

// TASK lambert: ρ E / π.
fn lambert(reflectance: vec3f, arriving: vec3f) -> vec3f {
    return reflectance * arriving / PI;
}

// TASK blinn_phong: k (N·H)ⁿ E.
fn blinn_phong(
    strength: vec3f,
    shininess: f32,
    normal: vec3f,
    to_light: vec3f,
    to_eye: vec3f,
    arriving: vec3f,
) -> vec3f {
    let between = normalize(to_light + to_eye);
    let cosine = max(dot(normal, between), 0.0);
    return strength * pow(cosine, shininess) * arriving;
}
