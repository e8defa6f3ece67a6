// World-space light indexing, first pass: which lights moved since the frame before.
//
// In:  the lights; the sphere that each had in the frame before.
// Out: the indices of those whose sphere is another.
// Follows the world-space light indexing of Just Cause 2 (Persson 2013, "Practical Clustered
// Shading", history): most lights stand still, so that only a few cells change in a frame.
#import lightbench::scene
#import lightbench::culling

@group(1) @binding(0) var<storage, read> last_spheres: array<vec4f>;
// How many, then which.
@group(1) @binding(1) var<storage, read_write> moved_lights: array<atomic<u32>>;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    let index = thread.x;
    if index < arrayLength(&last_spheres) {
        var sphere = vec4f(0.0);
        if index < scene::frame.light_count {
            let light = scene::lights[index];
            let ball = culling::world_sphere(light);
            // Lights that reach everything are in no cell.
            if light.kind < scene::LIGHT_DIRECTIONAL {
                sphere = vec4f(ball.center, ball.radius);
            }
        }
        if any(sphere != last_spheres[index]) {
            let at = atomicAdd(&moved_lights[0], 1u);
            atomicStore(&moved_lights[1u + at], index);
        }
    }
}
