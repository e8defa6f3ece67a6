// Deferred lighting, second pass: one light adds what arrives, before materials' colours.
//
// In:  the light; depth and the thin G-buffer.
// Out: diffuse light; highlights, as a colour, or with MONOCHROME as one number in alpha. Both are
//      multiplied by the material's colours later, so that light which no colour multiplies, the
//      part of a Fresnel term that rises at grazing angles, has no place here.
// Follows Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer",
// ShaderX7, and Mittring 2009, "A Bit More Deferred - CryEngine 3".
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::normals
#import lightbench::g_buffer

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var g_normal: texture_2d<u32>;
@group(1) @binding(2) var g_gloss: texture_2d<f32>;
@group(1) @binding(3) var g_model: texture_2d<u32>;

struct LightBuffer {
    @location(0) diffuse: vec4f,
#ifndef MONOCHROME
    @location(1) highlight: vec4f,
#endif
}

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> LightBuffer {
    var out: LightBuffer;
    let texel = vec2i(pixel.xy);
    let texel_depth = textureLoad(depth, texel, 0);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return out;
    }
    let resolution = vec2f(textureDimensions(depth));
    // Colours are not known yet, and not needed.
    let fragment = g_buffer::unpack_thin(
        scene::position_from_depth(pixel.xy, resolution, texel_depth),
        textureLoad(g_normal, texel, 0).xy,
        textureLoad(g_gloss, texel, 0).rg,
        textureLoad(g_model, texel, 0).r,
    );
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);
    let arriving = lighting::arriving_light(scene::lights[light], fragment, to_viewer);
#ifdef MONOCHROME
    out.diffuse = vec4f(arriving.diffuse, g_buffer::luminance(arriving.highlight));
#else
    out.diffuse = vec4f(arriving.diffuse, 0.0);
    out.highlight = vec4f(arriving.highlight, 0.0);
#endif
    return out;
}
