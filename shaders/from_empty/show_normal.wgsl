// From empty, step 3: the normals of the G-buffer as colours.
//
// In:  depth and octahedral normals.
// Out: x, y and z of the normal, from -1…1 to 0…1, as red, green and blue; black where nothing is.
#import lightbench::normals

@group(1) @binding(0) var depth: texture_2d<f32>;
@group(1) @binding(1) var g_normal: texture_2d<u32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    if textureLoad(depth, texel, 0).r == 0.0 {
        return vec4f(0.0, 0.0, 0.0, 1.0);
    }
    let normal = normals::decode_octahedral(textureLoad(g_normal, texel, 0).xy);
    return vec4f(normal * 0.5 + 0.5, 1.0);
}
