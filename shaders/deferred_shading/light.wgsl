// Deferred shading, second pass: one light adds its share to each pixel of its volume.
//
// In:  the light; the G-buffer; depth.
// Out: radiance to add.
// Follows Deering et al. 1988, "The Triangle Processor and Normal Vector Shader", section 4.
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer

#ifdef DEPTH_TARGET
// A pass that writes stencil can't read the depth in the same texture, but a copy of it.
@group(1) @binding(0) var depth: texture_2d<f32>;
#else
@group(1) @binding(0) var depth: texture_depth_2d;
#endif
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
#ifdef DEPTH_TARGET
    let texel_depth = textureLoad(depth, texel, 0).r;
#else
    let texel_depth = textureLoad(depth, texel, 0);
#endif
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return vec4f(0.0);
    }
    let resolution = vec2f(textureDimensions(depth));
    let fragment = g_buffer::unpack(
        scene::position_from_depth(pixel.xy, resolution, texel_depth),
        textureLoad(g_albedo, texel, 0),
        textureLoad(g_normal, texel, 0).xy,
        textureLoad(g_specular, texel, 0),
        textureLoad(g_model, texel, 0).r,
    );
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);
    let radiance = lighting::evaluate_light(scene::lights[light], fragment, to_viewer);
    return vec4f(radiance, 0.0);
}
