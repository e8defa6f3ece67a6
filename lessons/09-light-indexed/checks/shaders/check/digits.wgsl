// Each light writes a digit in the uppermost place: the first one 1 in red, 2 in green and 1 in blue, the
// second one 2, 1 and 2, and so on in turn.
//
// In:  the light; depth, which decides nothing here; what a 1 in the uppermost place is worth.
// Out: 1/255 for the count; the digits.

struct Parameters {
    uppermost: f32,
}

@group(1) @binding(0) var depth: texture_depth_2d;
@group(2) @binding(0) var<uniform> parameters: Parameters;

struct Written {
    @location(0) count: f32,
    @location(1) indices: vec4f,
}

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> Written {
    if textureLoad(depth, vec2i(pixel.xy), 0) == 0.0 {
        discard;
    }
    let odd = f32(light % 2u);
    let digits = vec4f(1.0 + odd, 2.0 - odd, 1.0 + odd, 1.0);
    return Written(1.0 / 255.0, digits * parameters.uppermost / 255.0);
}
