// Clustered forward shading: each fragment sums the lights of its cluster.
//
// In:  a fragment; the lists of clusters. TILE and SLICES as in shaders/lib/clusters.wgsl.
// Out: linear radiance, and opacity as alpha.
// Follows Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import lightbench::clusters

@group(1) @binding(0) var<storage, read> cluster_lists: array<vec2u>;
@group(1) @binding(1) var<storage, read> cluster_lights: array<u32>;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let fragment = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);

    let distance_ahead = scene::distance_ahead(fragment.position);
    let list = cluster_lists[clusters::cluster_of(in.clip_position.xy, distance_ahead)];
    var radiance = fragment.emissive;
    for (var i = list.x; i < list.x + list.y; i++) {
        let light = scene::lights[cluster_lights[i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, fragment.opacity);
}
