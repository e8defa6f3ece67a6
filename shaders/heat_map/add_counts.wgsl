// Heat map: adds the counts of passes of one size to the sum of all.
//
// In:  `counts`, of any size.
// Out: for each pixel the count of the texel that covers it.
#import lightbench::scene

@group(1) @binding(0) var counts: texture_2d<f32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let size = vec2f(textureDimensions(counts));
    let texel = vec2i(pixel.xy / scene::frame.resolution * size);
    return vec4f(textureLoad(counts, min(texel, vec2i(size) - 1), 0).r);
}
