// World-space light indexing, third pass: keeps where the lights are for the next frame.
//
// In:  the lights; the cell size.
// Out: their spheres, with a radius of 0 where there is no light or where it reaches everything.
#import lightbench::scene
#import lightbench::culling

struct Parameters {
    cell_size: f32,
}

@group(1) @binding(0) var<storage, read_write> last_spheres: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> grid_totals: array<u32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    let index = thread.x;
    if index < arrayLength(&last_spheres) {
        var sphere = vec4f(0.0);
        if index < scene::frame.light_count && scene::lights[index].kind < scene::LIGHT_DIRECTIONAL {
            let ball = culling::world_sphere(scene::lights[index]);
            sphere = vec4f(ball.center, ball.radius);
        }
        last_spheres[index] = sphere;
    }
    if index == 0u {
        grid_totals[2] = bitcast<u32>(parameters.cell_size);
    }
}
