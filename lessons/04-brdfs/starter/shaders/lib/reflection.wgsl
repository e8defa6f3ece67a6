// Two BRDFs.
//
// In:  directions of length 1, away from the surface, in the surface's own frame: z is its normal.
// Out: the BRDF in 1/sr, for a reflectance of 1.
//
// These functions run and give zero. Fill them in one after the other; the text says how.
#define_import_path reflection

const PI: f32 = 3.14159265;

// TASK blinn_phong: the lobe of the text with its scale.
//
// exponent:  n
fn blinn_phong(exponent: f32, to_light: vec3f, to_eye: vec3f) -> f32 {
    return 0.0;
}

// TASK facets: the density of facets whose normal is H, D, in 1/sr. Your γ is in README.md.
//
// roughness:  α
// facing:     N·H
fn facets(roughness: f32, facing: f32) -> f32 {
    return 0.0;
}

// TASK cook_torrance: the share of light that a smooth surface mirrors, F.
//
// cosine:  of the angle between the light and the normal of the facet, 0 to 1
// index:   of refraction, η, above 1
fn fresnel(cosine: f32, index: f32) -> f32 {
    return 0.0;
}

// TASK cook_torrance: the share of the facets that others neither shade nor hide, G.
fn masking(to_light: vec3f, to_eye: vec3f) -> f32 {
    return 0.0;
}

// TASK cook_torrance: all together.
//
// density:  of facets whose normal is H, D
fn cook_torrance(density: f32, index: f32, to_light: vec3f, to_eye: vec3f) -> f32 {
    return 0.0;
}
