// Packs the surface of each pixel.
//
// In:  the pixel; `seed` and `largest_power`.
// Out: what `pack` gives.
#import own_layout
#import check_surfaces

struct Parameters {
    seed: f32,
    largest_power: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> own_layout::Texels {
    let given = check_surfaces::at(pixel.xy, parameters.seed, parameters.largest_power);
    return own_layout::pack(vec3f(0.25, 0.5, 0.75), given);
}
