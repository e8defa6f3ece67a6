// Clustered shading: lights meet clusters. Runs twice; first it counts, then, with FILL, it writes.
//
// In:  the spheres around the lights; with FILL where the list of each cluster begins. TILE and SLICES as in
//      shaders/lib/clusters.wgsl.
// Out: the length of each cluster's list; or the lists, each in ascending order of light indices.
// One workgroup looks after one tile: together its invocations find the lights of the tile, then
// each takes one slice of it.
// Follows Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading", section 4.
#import lightbench::scene
#import lightbench::culling
#import lightbench::clusters
#import lightbench::column_lights

// For each cluster: where its list begins, and how long it is.
#ifdef FILL
@group(1) @binding(1) var<storage, read> cluster_lists: array<vec2u>;
@group(1) @binding(2) var<storage, read_write> cluster_lights: array<u32>;
#else
@group(1) @binding(1) var<storage, read_write> cluster_lists: array<vec2u>;
#endif

@compute @workgroup_size(64)
fn compute_main(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(num_workgroups) tiles: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let corner = tile.xy * clusters::TILE;
    let sides = culling::rectangle_sides(
        vec2f(corner),
        vec2f(corner + clusters::TILE),
        scene::frame.resolution,
    );
    let owns_slice = thread < clusters::SLICES;
    let space = clusters::cluster_box(tile.xy, thread);
    let cluster = (tile.y * tiles.x + tile.x) * clusters::SLICES + min(thread, clusters::SLICES - 1u);

    var count = 0u;
#ifdef FILL
    let begin = cluster_lists[cluster].x;
    let room = arrayLength(&cluster_lights);
#endif
    for (var first = 0u; first < scene::frame.light_count; first += column_lights::BATCH) {
        column_lights::find(thread, first, sides);
        let words = (min(scene::frame.light_count - first, column_lights::BATCH) + 31u) / 32u;
        for (var word = 0u; word < words; word++) {
            var bits = column_lights::mask(word);
            while bits != 0u && owns_slice {
                let index = first + word * 32u + firstTrailingBit(bits);
                bits &= bits - 1u;
                if culling::meets_box(column_lights::sphere(index), space) {
#ifdef FILL
                    if begin + count < room {
                        cluster_lights[begin + count] = index;
                    }
#endif
                    count += 1u;
                }
            }
        }
    }
#ifndef FILL
    if owns_slice {
        cluster_lists[cluster] = vec2u(0u, count);
    }
#endif
}
