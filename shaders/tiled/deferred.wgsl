// Tiled deferred shading with lists: each pixel of the G-buffer sums the lights of its tile.
//
// In:  what shaders/lib/g_buffer_texels.wgsl reads; the lists of `cull.wgsl`. TILE and CAPACITY as
//      there.
// Out: radiance to add to what the surface emits.
// Follows Olsson and Assarsson 2011, "Tiled Shading".
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer_texels

@group(1) @binding(0) var<storage, read> tile_lists: array<u32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2u(pixel.xy);
    let texel_depth = g_buffer_texels::depth_at(texel, 0u);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return vec4f(0.0);
    }
    let fragment = g_buffer_texels::surface_at(texel, 0u);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);

    let columns = (u32(scene::frame.resolution.x) + #{TILE}u - 1u) / #{TILE}u;
    let tile = vec2u(pixel.xy) / #{TILE}u;
    let list = (tile.y * columns + tile.x) * (#{CAPACITY}u + 1u);
    var radiance = vec3f(0.0);
    let end = list + tile_lists[list];
    for (var i = list + 1u; i <= end; i++) {
        let light = scene::lights[tile_lists[i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, 0.0);
}
