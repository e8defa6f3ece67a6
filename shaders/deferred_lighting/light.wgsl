// Deferred lighting, second pass: one light adds what arrives, before materials' colours.
//
// In:  the light; depth, normal and power of the thin G-buffer.
// Out: diffuse light; highlights, as a colour, or with MONOCHROME as one number in alpha.
// Follows Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer",
// ShaderX7, and Mittring 2009, "A Bit More Deferred - CryEngine 3".
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::normals
#import lightbench::g_buffer

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var g_normal: texture_2d<u32>;
@group(1) @binding(2) var g_power: texture_2d<f32>;

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
    // Base colour and specular are not known yet, and not needed.
    let fragment = g_buffer::unpack(
        scene::position_from_depth(pixel.xy, resolution, texel_depth),
        vec4f(0.0),
        textureLoad(g_normal, texel, 0).xy,
        textureLoad(g_power, texel, 0).r,
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
