// The sphere around each light, in view space, computed once for all tiles or clusters that ask.
//
// In:  the lights.
// Out: centre and radius of each; lights without a range have a radius that reaches everything.
#import lightbench::scene
#import lightbench::culling

@group(1) @binding(0) var<storage, read_write> light_spheres: array<vec4f>;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x < scene::frame.light_count {
        let ball = culling::light_sphere(scene::lights[thread.x]);
        light_spheres[thread.x] = vec4f(ball.center, ball.radius);
    }
}
