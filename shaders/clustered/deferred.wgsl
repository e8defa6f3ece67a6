// Clustered deferred shading: each pixel of the G-buffer sums the lights of its cluster.
//
// In:  depth and G-buffer; the lists of clusters. TILE and SLICES as in shaders/lib/clusters.wgsl.
// Out: radiance to add to what the surface emits.
// Follows Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading".
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer
#import lightbench::culling
#import lightbench::clusters

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var g_albedo: texture_2d<f32>;
@group(1) @binding(2) var g_normal: texture_2d<u32>;
@group(1) @binding(3) var g_specular: texture_2d<u32>;
@group(1) @binding(4) var g_model: texture_2d<u32>;
@group(1) @binding(5) var<storage, read> cluster_lists: array<vec2u>;
@group(1) @binding(6) var<storage, read> cluster_lights: array<u32>;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let texel_depth = textureLoad(depth, texel, 0);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return vec4f(0.0);
    }
    let fragment = g_buffer::unpack(
        scene::position_from_depth(pixel.xy, vec2f(textureDimensions(depth)), texel_depth),
        textureLoad(g_albedo, texel, 0),
        textureLoad(g_normal, texel, 0).xy,
        textureLoad(g_specular, texel, 0),
        textureLoad(g_model, texel, 0).r,
    );
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);

    let list = cluster_lists[clusters::cluster_of(pixel.xy, culling::view_distance(texel_depth))];
    var radiance = vec3f(0.0);
    for (var i = list.x; i < list.x + list.y; i++) {
        let light = scene::lights[cluster_lights[i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, 0.0);
}
