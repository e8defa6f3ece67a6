// A light buffer: what lamps add to it, and what materials make of it.
//
// These functions run and give nothing. Your number is in README.md.
#define_import_path own_buffer

const PI: f32 = 3.14159265;

// Two targets of 8 bytes. What lamps write there is added up.
struct Gathered {
    @location(0) front: vec4f,          // red, green, blue: irradiance of the front; alpha: highlights
    @location(1) back: vec4f,           // red, green, blue: irradiance that comes through; alpha: free
}

// What the second pass over the geometry knows of a surface.
struct Material {
    reflects: vec3f,                    // ρ, share of the light of the front that it sends back
    lets_through: vec3f,                // τ, share of the light from behind that it lets through
    mirrors: vec3f,                     // k, share that its highlights mirror
    emits: vec3f,                       // radiance
}

// TASK gather: what one lamp adds.
//
// facing:  irradiance on a surface that faces the lamp, F
// cosine:  N·L, from -1 to 1; below 0 the lamp is behind the surface
// lobe:    what the highlight mirrors to the eye for each unit of irradiance, before colours, S
fn gather(facing: vec3f, cosine: f32, lobe: f32) -> Gathered {
    return Gathered(vec4f(0.0), vec4f(0.0));
}

// TASK meet: the radiance that a surface sends to the eye, from the sums of what all lamps added.
fn meet(material: Material, light: Gathered) -> vec3f {
    return vec3f(0.0);
}
