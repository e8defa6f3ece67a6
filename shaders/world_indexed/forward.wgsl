// World-space light indexing, fourth pass: each fragment sums the lights of its cell of the world.
//
// In:  a fragment; the lists of cells; the cell size.
// Out: linear radiance, and opacity as alpha.
// Follows the world-space light indexing of Just Cause 2 (Persson 2013, "Practical Clustered
// Shading", history).
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import lightbench::world_grid

struct Parameters {
    cell_size: f32,
}

@group(1) @binding(0) var<storage, read> cell_lists: array<u32>;
@group(1) @binding(1) var<storage, read> unbounded_lights: array<u32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let fragment = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);

    var radiance = fragment.emissive;
    for (var i = 1u; i <= unbounded_lights[0]; i++) {
        let light = scene::lights[unbounded_lights[i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    let cell = world_grid::cell_index(fragment.position, parameters.cell_size);
    let list = cell * world_grid::STRIDE;
    for (var i = 1u; i <= min(cell_lists[list], world_grid::CAPACITY); i++) {
        let light = scene::lights[cell_lists[list + i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, fragment.opacity);
}
