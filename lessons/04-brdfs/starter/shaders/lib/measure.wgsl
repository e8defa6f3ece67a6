// Two tests of a BRDF.
//
// In:  one of the BRDFs of shaders/lib/suspects.wgsl, which `suspects::brdf(suspect, to_light, to_eye)` gives;
//      directions of length 1, in the surface's own frame: z is its normal.
//
// These functions run and give zero. Fill them in; the text says how.
#define_import_path measure
#import suspects

const PI: f32 = 3.14159265;

// TASK reciprocity: by which share the BRDF changes when lamp and eye change places; 0 where it does not.
fn asymmetry(suspect: suspects::Suspect, to_light: vec3f, to_eye: vec3f) -> f32 {
    return 0.0;
}

// TASK energy: the share of the light from one direction that the surface sends away, to all sides together.
fn albedo(suspect: suspects::Suspect, to_light: vec3f) -> f32 {
    return 0.0;
}
