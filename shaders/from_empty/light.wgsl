// From empty, step 5: one light adds its share to each pixel of its volume.
//
// In:  the light; the G-buffer; depth.
// Out: radiance to add; in alpha 1, so that the sum says how many lights a pixel was lit by.
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer

@group(1) @binding(0) var depth: texture_2d<f32>;
@group(1) @binding(1) var g_albedo: texture_2d<f32>;
@group(1) @binding(2) var g_normal: texture_2d<u32>;
@group(1) @binding(3) var g_specular: texture_2d<u32>;
@group(1) @binding(4) var g_model: texture_2d<u32>;

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let texel_depth = textureLoad(depth, texel, 0).r;
    if texel_depth == 0.0 {
        return vec4f(0.0);              // the far plane: no surface, so nothing to light
    }
    let point = g_buffer::unpack(
        scene::position_from_depth(pixel.xy, scene::frame.resolution, texel_depth),
        textureLoad(g_albedo, texel, 0),
        textureLoad(g_normal, texel, 0).xy,
        textureLoad(g_specular, texel, 0),
        textureLoad(g_model, texel, 0).r,
    );
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);
    let radiance = lighting::evaluate_light(scene::lights[light], point, to_viewer);
    return vec4f(radiance, 1.0);
}
