// Inspect: two pictures side by side in one, the first at the left of a line, the second at its right.
//
// In:  two display-ready pictures of one size; where the line is.
// Out: the texels of one or the other as they are.

struct Split {
    at: f32,        // the share of the width at the left of the line
    padding: vec2f,
}

@group(0) @binding(0) var<uniform> split: Split;
@group(0) @binding(1) var first: texture_2d<f32>;
@group(0) @binding(2) var second: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let line = split.at * f32(textureDimensions(first).x);
    // A texel belongs to the side on which its middle lies.
    if pixel.x < line {
        return vec4f(textureLoad(first, texel, 0).rgb, 1.0);
    }
    return vec4f(textureLoad(second, texel, 0).rgb, 1.0);
}
