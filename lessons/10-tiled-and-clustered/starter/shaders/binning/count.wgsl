// Counts what the lists are worth.
//
// In:  depth; the lists.
// Out: how many lights all pixels evaluate together, and how many of these reach their pixel. Lights without a
//      range reach everything and are left out.
#import lightbench::scene
#import lightbench::culling
#import cells

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var<storage, read> lists: array<u32>;
@group(1) @binding(2) var<storage, read_write> totals: array<atomic<u32>>;

@compute @workgroup_size(8, 8)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    if any(thread.xy >= textureDimensions(depth)) {
        return;
    }
    let texel_depth = textureLoad(depth, thread.xy, 0);
    if texel_depth == 0.0 {
        return;                         // sky is not lit
    }
    let pixel = vec2f(thread.xy) + 0.5;
    let position = scene::position_from_depth(pixel, scene::frame.resolution, texel_depth);
    let list = cells::list_of(pixel, scene::distance_ahead(position));
    var evaluated = 0u;
    var reaching = 0u;
    for (var i = 1u; i <= lists[list]; i++) {
        let light = scene::lights[lists[list + i]];
        if light.kind < scene::LIGHT_DIRECTIONAL {
            evaluated++;
            reaching += u32(culling::reaches(light, position));
        }
    }
    atomicAdd(&totals[1], evaluated);
    atomicAdd(&totals[2], reaching);
}
