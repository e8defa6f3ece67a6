// World-space light indexing, second pass: cells that a moved light leaves or enters are filled
// again, the others are left as they are.
//
// In:  the lights that moved, where they are and where they were; the cell size.
// Out: the lists of the cells; how many were filled, and how many have more lights than room.
// Follows the world-space light indexing of Just Cause 2 (Persson 2013, "Practical Clustered
// Shading", history).
#import lightbench::scene
#import lightbench::culling
#import lightbench::world_grid

struct Parameters {
    cell_size: f32,
}

@group(1) @binding(0) var<storage, read> last_spheres: array<vec4f>;
@group(1) @binding(1) var<storage, read> moved_lights: array<u32>;
@group(1) @binding(2) var<storage, read_write> cell_lists: array<u32>;
// Cells filled, cells over capacity, bits of the cell size of the frame before.
@group(1) @binding(3) var<storage, read_write> grid_totals: array<atomic<u32>>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

fn sphere_now(light: u32) -> culling::Sphere {
    if light >= scene::frame.light_count || scene::lights[light].kind >= scene::LIGHT_DIRECTIONAL {
        return culling::Sphere(vec3f(0.0), 0.0);
    }
    return culling::world_sphere(scene::lights[light]);
}

fn sphere_before(light: u32) -> culling::Sphere {
    return culling::Sphere(last_spheres[light].xyz, last_spheres[light].w);
}

@compute @workgroup_size(64)
fn compute_main(@builtin(global_invocation_id) thread: vec3u) {
    if thread.x >= world_grid::cell_count() {
        return;
    }
    let cell = world_grid::cell_of_index(thread.x);
    let size = parameters.cell_size;

    // Cells of another size are other cells.
    var changed = atomicLoad(&grid_totals[2]) != bitcast<u32>(size);
    for (var i = 1u; i <= moved_lights[0] && !changed; i++) {
        let light = moved_lights[i];
        changed = world_grid::reaches(sphere_now(light), cell, size)
            || world_grid::reaches(sphere_before(light), cell, size);
    }
    let list = thread.x * world_grid::STRIDE;
    if changed {
        var count = 0u;
        for (var light = 0u; light < scene::frame.light_count; light++) {
            if world_grid::reaches(sphere_now(light), cell, size) {
                count += 1u;
                if count <= world_grid::CAPACITY {
                    cell_lists[list + count] = light;
                }
            }
        }
        cell_lists[list] = count;
        atomicAdd(&grid_totals[0], 1u);
    }
    if cell_lists[list] > world_grid::CAPACITY {
        atomicAdd(&grid_totals[1], 1u);
    }
}
