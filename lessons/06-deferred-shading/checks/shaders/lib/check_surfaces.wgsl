// A made-up surface for each pixel: all directions, colours from black to white, and exponents from 1 to
// the largest one.
//
// In:  a pixel; a seed; the largest exponent.
// Out: what a G-buffer keeps of a surface.
#define_import_path check_surfaces

#import own_layout

// A number from 0 to 1 that looks random (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering",
// JCGT 9(3): pcg).
fn chance(number: u32) -> f32 {
    let state = number * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777215.0;
}

fn at(pixel: vec2f, seed: f32, largest_power: f32) -> own_layout::Kept {
    let first = (u32(pixel.x) + 256u * u32(pixel.y) + 65536u * u32(seed)) * 8u;
    let height = 2.0 * chance(first) - 1.0;
    let around = radians(360.0 * chance(first + 1u));
    let level = sqrt(max(1.0 - height * height, 0.0));
    let normal = normalize(vec3f(level * cos(around), level * sin(around), height));
    let roots = vec3f(chance(first + 2u), chance(first + 3u), chance(first + 4u));
    // The first column is black.
    var color = roots * roots * roots;
    color = select(color, vec3f(0.0), pixel.x < 1.0);
    return own_layout::Kept(
        normal,
        color,
        chance(first + 5u),
        pow(largest_power, chance(first + 6u)),
    );
}
