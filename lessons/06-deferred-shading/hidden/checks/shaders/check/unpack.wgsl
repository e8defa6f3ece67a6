// Takes the surface of each pixel out again, and compares it with what was put in.
//
// In:  the texels; `seed` and `largest_power`.
// Out: the angle of the normal in degrees; by how many times what is allowed the colour is off, 0.001 and 2 %;
//      the difference of the specular strength; the logarithm of the exponents' ratio. The normal's length.
#import own_layout
#import check_surfaces

struct Parameters {
    seed: f32,
    largest_power: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

struct Errors {
    @location(0) errors: vec4f,
    @location(1) length: f32,
}

// What is no number is very wrong.
fn finite(error: f32) -> f32 {
    return select(1e9, error, error < 1e9);
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> Errors {
    let given = check_surfaces::at(pixel.xy, parameters.seed, parameters.largest_power);
    let found = own_layout::unpack(vec2i(pixel.xy));
    // Exact where the angle is small, as the arc cosine is not.
    let chord = length(found.normal / max(length(found.normal), 1e-6) - given.normal);
    let angle = degrees(2.0 * asin(min(0.5 * chord, 1.0)));
    let colors = abs(found.base_color - given.base_color) / (0.001 + 0.02 * given.base_color);
    return Errors(
        vec4f(
            finite(angle),
            finite(max(colors.r, max(colors.g, colors.b))),
            finite(abs(found.specular - given.specular)),
            finite(abs(log(max(found.power, 1e-6) / given.power))),
        ),
        finite(length(found.normal)),
    );
}
