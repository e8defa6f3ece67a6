// Clustered deferred shading: each pixel of the G-buffer sums the lights of its cluster.
//
// In:  what shaders/lib/g_buffer_texels.wgsl reads; the lists of clusters. TILE and SLICES as in
//      shaders/lib/clusters.wgsl, EVERY_SAMPLE as in shaders/deferred_shading/light.wgsl.
// Out: radiance to add to what the surface emits.
// Follows Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading".
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer_texels
#import lightbench::culling
#import lightbench::clusters

@group(1) @binding(0) var<storage, read> cluster_lists: array<vec2u>;
@group(1) @binding(1) var<storage, read> cluster_lights: array<u32>;

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
#ifdef EVERY_SAMPLE
    @builtin(sample_index) sample: u32,
#endif
) -> @location(0) vec4f {
#ifndef EVERY_SAMPLE
    let sample = 0u;
#endif
    let texel = vec2u(pixel.xy);
    let texel_depth = g_buffer_texels::depth_at(texel, sample);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return vec4f(0.0);
    }
    let fragment = g_buffer_texels::surface_at(texel, sample);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);

    let list = cluster_lists[clusters::cluster_of(pixel.xy, culling::view_distance(texel_depth))];
    var radiance = vec3f(0.0);
    for (var i = list.x; i < list.x + list.y; i++) {
        let light = scene::lights[cluster_lights[i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, 0.0);
}
