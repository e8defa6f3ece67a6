// Visibility buffer with four samples: what was shaded goes to the samples.
//
// In:  `shaded`, a square of four texels for each pixel.
// Out: linear radiance of a sample.
// A pass of its own, since the one that shades is a compute pass, which can't write samples.

@group(1) @binding(0) var shaded: texture_2d<f32>;

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @builtin(sample_index) sample: u32,
) -> @location(0) vec4f {
    return textureLoad(shaded, 2u * vec2u(pixel.xy) + vec2u(sample % 2u, sample / 2u), 0);
}
