// Asks of each object of the list which lamps reach it.
//
// In:  the list; the scene's lights, 64 at the most.
// Out: 1 in `in_view` for each object of the list, and in `reached` a bit for each lamp that reaches it.
#import lightbench::scene
#import bounds
#import survivors

@group(1) @binding(0) var<storage, read_write> counts: array<atomic<u32>>;
@group(1) @binding(1) var<storage, read> list: array<u32>;
@group(1) @binding(2) var<storage, read_write> in_view: array<u32>;
@group(1) @binding(3) var<storage, read_write> reached: array<u32>;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x >= atomicLoad(&counts[0]) {
        return;
    }
    let object = list[thread.x];
    let middle = survivors::middle(object);
    let halves = survivors::halves(object);
    var bits = vec2u(0u);
    var lamps = 0u;
    for (var i = 0u; i < min(scene::frame.light_count, 64u); i++) {
        let light = scene::lights[i];
        if light.kind == scene::LIGHT_POINT {
            lamps++;
            if !bounds::lamp_reaches(light.position, light.range, middle, halves) {
                continue;
            }
        }
        bits[i / 32u] |= 1u << (i % 32u);
    }
    in_view[object] = 1u;
    reached[2u * object] = bits.x;
    reached[2u * object + 1u] = bits.y;
    atomicAdd(&counts[2], lamps);
    // Light from everywhere is no lamp.
    let others = min(scene::frame.light_count, 64u) - lamps;
    atomicAdd(&counts[3], countOneBits(bits.x) + countOneBits(bits.y) - others);
}
