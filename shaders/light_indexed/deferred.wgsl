// Light-indexed deferred shading: each pixel of the G-buffer sums the lights whose numbers it
// holds.
//
// In:  depth and G-buffer; what shaders/lib/pixel_lights.wgsl reads.
// Out: radiance to add to what the surface emits; 1 where lights were lost.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::scene
#import lightbench::g_buffer
#import lightbench::pixel_lights

@group(1) @binding(5) var depth: texture_depth_2d;
@group(1) @binding(6) var g_albedo: texture_2d<f32>;
@group(1) @binding(7) var g_normal: texture_2d<u32>;
@group(1) @binding(8) var g_specular: texture_2d<u32>;
@group(1) @binding(9) var g_model: texture_2d<u32>;

struct Shaded {
    @location(0) hdr: vec4f,
    @location(1) over_capacity: f32,
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> Shaded {
    let texel = vec2i(pixel.xy);
    let texel_depth = textureLoad(depth, texel, 0);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return Shaded(vec4f(0.0), 0.0);
    }
    let fragment = g_buffer::unpack(
        scene::position_from_depth(pixel.xy, vec2f(textureDimensions(depth)), texel_depth),
        textureLoad(g_albedo, texel, 0),
        textureLoad(g_normal, texel, 0).xy,
        textureLoad(g_specular, texel, 0),
        textureLoad(g_model, texel, 0).r,
    );
    let found = pixel_lights::sum(texel, fragment);
    return Shaded(vec4f(found.radiance, 0.0), select(0.0, 1.0, found.lost));
}
