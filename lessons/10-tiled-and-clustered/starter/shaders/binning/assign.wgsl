// Which lights reach each cell.
//
// In:  the lights of the scene; the functions of shaders/lib/binning.wgsl. CAPACITY is the room of a list.
// Out: a list for each cell: the number of lights, then their indices. With SLICED a cell is a slice of a
//      tile; without, only the first of a tile has a list, for all of the tile.
// Follows Harada, McKee and Yang 2012, "Forward+: Bringing Deferred Lighting to the Next Level", and Olsson,
// Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading".
#import lightbench::scene
#import lightbench::culling
#import binning

@group(1) @binding(0) var<storage, read_write> lists: array<u32>;
@group(1) @binding(1) var<storage, read_write> totals: array<atomic<u32>>;

fn is_listed(light: scene::Light, cell: vec3u) -> bool {
    if light.kind >= scene::LIGHT_DIRECTIONAL {
        return true;                    // reaches everything
    }
    let ball = culling::light_sphere(light);
    // What the edges of the picture see at a distance of 1.
    let spread = 1.0 / vec2f(scene::frame.projection[0][0], scene::frame.projection[1][1]);
    let slopes = binning::tile_slopes(cell.xy, vec2u(scene::frame.resolution), spread);
    if !binning::meets_tile(ball.center, ball.radius, slopes) {
        return false;
    }
#ifdef SLICED
    // A little more than the slice, since the slice of a pixel is found with rounding.
    let range = binning::slice_range(cell.z) * vec2f(0.999, 1.001);
    return binning::meets_cluster(ball.center, ball.radius, slopes, range);
#else
    return true;
#endif
}

@compute @workgroup_size(4, 2, 4)
fn compute_main(@builtin(global_invocation_id) cell: vec3u) {
    if any(cell >= vec3u(binning::COLUMNS, binning::ROWS, binning::SLICES)) {
        return;
    }
#ifndef SLICED
    if cell.z > 0u {
        return;
    }
#endif
    let index = (cell.z * binning::ROWS + cell.y) * binning::COLUMNS + cell.x;
    let list = index * (#{CAPACITY}u + 1u);
    var count = 0u;
    for (var i = 0u; i < scene::frame.light_count && count < #{CAPACITY}u; i++) {
        if is_listed(scene::lights[i], cell) {
            count++;
            lists[list + count] = i;
        }
    }
    lists[list] = count;
    atomicAdd(&totals[0], count);
}
