// What was put in for each pixel.
//
// In:  the pixel; `seed` and `largest_power`.
// Out: normal and exponent; colour and specular strength.
#import check_surfaces

struct Parameters {
    seed: f32,
    largest_power: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

struct Surface {
    @location(0) shape: vec4f,
    @location(1) color: vec4f,
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> Surface {
    let kept = check_surfaces::at(pixel.xy, parameters.seed, parameters.largest_power);
    return Surface(vec4f(kept.normal, kept.power), vec4f(kept.base_color, kept.specular));
}
