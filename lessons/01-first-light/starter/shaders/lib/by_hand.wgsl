// What light does to a surface, by hand.
//
// These three functions run and give nothing. Fill them in one after the other; the text says how.
#define_import_path by_hand

const PI: f32 = 3.14159265;

// TASK irradiance: what arrives on a surface from a small lamp, in W/m².
//
// intensity:  of the lamp, W/sr
// to_light:   from the surface to the lamp, in metres; its length is the distance
// normal:     of the surface, length 1
fn irradiance(intensity: vec3f, to_light: vec3f, normal: vec3f) -> vec3f {
    return vec3f(0.0);
}

// TASK lambert: what a matt surface sends in each direction, in W/(m² sr).
//
// reflectance:  the share of the light that it sends back, ρ
// arriving:     what arrives on it, E
fn lambert(reflectance: vec3f, arriving: vec3f) -> vec3f {
    return vec3f(0.0);
}

// TASK blinn_phong: the highlight that a surface sends to the eye, in W/(m² sr).
//
// strength:   of the highlight, k
// shininess:  its exponent, n
// normal, to_light, to_eye:  directions of length 1, N, L and V
// arriving:   what arrives on it, E
fn blinn_phong(
    strength: vec3f,
    shininess: f32,
    normal: vec3f,
    to_light: vec3f,
    to_eye: vec3f,
    arriving: vec3f,
) -> vec3f {
    return vec3f(0.0);
}
