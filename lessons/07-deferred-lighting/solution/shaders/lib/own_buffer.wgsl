// A light buffer: what lamps add to it, and what materials make of it.
#define_import_path own_buffer

const PI: f32 = 3.14159265;

// The number of who has none of their own: how far light reaches round paper.
const WRAP = 0.3;

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

// Rec. 709.
fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

// TASK gather: three sums, of which the middle one keeps its brightness alone.
fn gather(facing: vec3f, cosine: f32, lobe: f32) -> Gathered {
    let front = facing * max(cosine, 0.0);
    let back = facing * max((WRAP - cosine) / (1.0 + WRAP), 0.0);
    return Gathered(vec4f(front, luminance(front) * lobe), vec4f(back, 0.0));
}

// TASK meet: colours multiply the sums. Highlights take the hue of the light of the front.
fn meet(material: Material, light: Gathered) -> vec3f {
    let front = light.front.rgb;
    let highlight = light.front.a * front / max(luminance(front), 1e-6);
    let matt = material.reflects * front + material.lets_through * light.back.rgb;
    return material.emits + matt / PI + material.mirrors * highlight;
}
