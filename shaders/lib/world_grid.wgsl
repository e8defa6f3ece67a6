// A grid of cells over the world, each with a list of the lights that reach it.
//
// In:  positions and spheres in world space. COLUMNS is the number of cells along x and z, LAYERS
//      along y (1: cells reach from the bottom of the world to its top), CAPACITY the room of a list.
// Out: the cell of a position; whether a sphere reaches a cell.
// The grid repeats itself without end, so that the world may be of any size: a cell holds the lights
// of all its repetitions. Those of another repetition are out of range and add nothing.
// Follows the world-space light indexing of Just Cause 2 (Persson 2013, "Practical Clustered
// Shading", history).
#define_import_path lightbench::world_grid

#import lightbench::culling

const CELLS: vec3i = vec3i(#{COLUMNS}, #{LAYERS}, #{COLUMNS});
const CAPACITY: u32 = #{CAPACITY}u;
// Words of a list: the number of lights that reach the cell, then those that have room.
const STRIDE: u32 = CAPACITY + 1u;

// The remainder that is never negative.
fn wrap(value: vec3i) -> vec3i {
    return ((value % CELLS) + CELLS) % CELLS;
}

// The cell of a position, before the grid repeats itself.
fn coordinates(position: vec3f, cell_size: f32) -> vec3i {
    return vec3i(floor(position / cell_size));
}

// Cells of the grid.
fn cell_count() -> u32 {
    return u32(CELLS.x * CELLS.y * CELLS.z);
}

// The number of the cell that holds a position.
fn cell_index(position: vec3f, cell_size: f32) -> u32 {
    let cell = vec3u(wrap(coordinates(position, cell_size)));
    return (cell.y * u32(CELLS.z) + cell.z) * u32(CELLS.x) + cell.x;
}

// The cell of such a number.
fn cell_of_index(index: u32) -> vec3i {
    let across = u32(CELLS.x);
    let deep = u32(CELLS.z);
    return vec3i(vec3u(index % across, index / (across * deep), index / across % deep));
}

// Whether a sphere in world space reaches a cell or one of its repetitions.
fn reaches(ball: culling::Sphere, cell: vec3i, cell_size: f32) -> bool {
    if ball.radius <= 0.0 {
        return false;
    }
    // Far beyond what whole numbers of cells can say, or wider than the grid: it reaches all.
    if ball.radius > cell_size * 10000.0 {
        return true;
    }
    let first = coordinates(ball.center - ball.radius, cell_size);
    let last = coordinates(ball.center + ball.radius, cell_size);
    let ahead = wrap(cell - first);
    if any(ahead > last - first) && CELLS.y > 1 {
        return false;
    }
    if any(ahead.xz > last.xz - first.xz) {
        return false;
    }
    if any(last.xz - first.xz >= CELLS.xz) || (CELLS.y > 1 && last.y - first.y >= CELLS.y) {
        return true;
    }
    // The nearest repetition is the only one that the sphere can reach: test it as it is.
    var low = vec3f(first + ahead) * cell_size;
    var high = low + cell_size;
    if CELLS.y == 1 {
        low.y = -1.0e30;
        high.y = 1.0e30;
    }
    return culling::meets_box(ball, culling::Box(low, high));
}
