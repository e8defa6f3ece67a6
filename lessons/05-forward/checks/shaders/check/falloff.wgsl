// Calls `falloff` for each pixel of a row of 301; `checks.rhai` has the same distances.
//
// In:  the pixel; `range`.
// Out: the falloff at 0, 1/200, 2/200, … of the range.
#import own_falloff

struct Parameters {
    range: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let distance = parameters.range * floor(pixel.x) / 200.0;
    return vec4f(own_falloff::falloff(distance, parameters.range));
}
