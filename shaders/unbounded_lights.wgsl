// The lights without a range, ambient and directional ones, found once for all shaders that ask.
//
// In:  the lights.
// Out: how many there are, then which, in ascending order.
// One invocation takes one light after the other, so that they stay in order; it only looks at
// their kinds.
#import lightbench::scene

@group(1) @binding(0) var<storage, read_write> unbounded_lights: array<u32>;

@compute @workgroup_size(1)
fn compute_main() {
    var count = 0u;
    for (var i = 0u; i < scene::frame.light_count; i++) {
        if scene::lights[i].kind >= scene::LIGHT_DIRECTIONAL {
            count += 1u;
            unbounded_lights[count] = i;
        }
    }
    unbounded_lights[0] = count;
}
