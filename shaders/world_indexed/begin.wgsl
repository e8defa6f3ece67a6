// World-space light indexing: sets what is counted in a frame back to zero.
//
// In:  the counts of the frame before.
// Out: zeros; the cell size of the frame before stays.
@group(1) @binding(0) var<storage, read_write> grid_totals: array<u32>;
@group(1) @binding(1) var<storage, read_write> moved_lights: array<u32>;

@compute @workgroup_size(1)
fn compute_main() {
    grid_totals[0] = 0u;
    grid_totals[1] = 0u;
    moved_lights[0] = 0u;
}
