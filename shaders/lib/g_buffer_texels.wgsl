// The G-buffer as passes read it.
//
// In:  the targets of scripts/pipelines/parts/g_buffer.rhai, and depth: the depth buffer; with
//      DEPTH_TARGET a copy of it, for passes that write the stencil beside it and so can't read it;
//      with MULTISAMPLED a copy with four samples.
// Out: depth and surface of a pixel, or with MULTISAMPLED of one of its samples.
// A sample holds what its triangle shows at the pixel's middle, where it was shaded: position and all
// else belong to that point. Its depth is therefore read from the copy, which is of that point too.
#define_import_path lightbench::g_buffer_texels

#import lightbench::scene
#import lightbench::surface
#import lightbench::g_buffer

#ifdef MULTISAMPLED
@group(1) @binding(10) var depth: texture_multisampled_2d<f32>;
@group(1) @binding(11) var g_albedo: texture_multisampled_2d<f32>;
@group(1) @binding(12) var g_normal: texture_multisampled_2d<u32>;
@group(1) @binding(13) var g_specular: texture_multisampled_2d<u32>;
@group(1) @binding(14) var g_model: texture_multisampled_2d<u32>;
#else
#ifdef DEPTH_TARGET
@group(1) @binding(10) var depth: texture_2d<f32>;
#else
@group(1) @binding(10) var depth: texture_depth_2d;
#endif
@group(1) @binding(11) var g_albedo: texture_2d<f32>;
@group(1) @binding(12) var g_normal: texture_2d<u32>;
@group(1) @binding(13) var g_specular: texture_2d<u32>;
@group(1) @binding(14) var g_model: texture_2d<u32>;
#endif

// Reversed depth; 0, the far plane, where nothing was drawn. Without MULTISAMPLED the one sample is
// number 0.
fn depth_at(texel: vec2u, sample: u32) -> f32 {
#ifdef MULTISAMPLED
    return textureLoad(depth, texel, sample).r;
#else
#ifdef DEPTH_TARGET
    return textureLoad(depth, texel, sample).r;
#else
    return textureLoad(depth, texel, sample);
#endif
#endif
}

// What is drawn there, unlit.
fn surface_at(texel: vec2u, sample: u32) -> surface::Surface {
    let middle = vec2f(texel) + 0.5;
    let resolution = vec2f(textureDimensions(depth));
    return g_buffer::unpack(
        scene::position_from_depth(middle, resolution, depth_at(texel, sample)),
        textureLoad(g_albedo, texel, sample),
        textureLoad(g_normal, texel, sample).xy,
        textureLoad(g_specular, texel, sample),
        textureLoad(g_model, texel, sample).r,
    );
}
