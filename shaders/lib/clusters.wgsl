// Clusters: the tiles of the screen, cut along the view into slices.
//
// In:  positions and lights in view space. TILE is the side of a tile in pixels, SLICES the number
//      of slices.
// Out: the cluster of a position; the box around a cluster.
// Slices grow with distance, as perspective does, so that clusters are about as deep as they are
// wide: slice k begins at near · (far / near)^(k / SLICES). Follows Olsson, Billeter and Assarsson
// 2012, "Clustered Deferred and Forward Shading", section 3, with the slices that Sousa and Geffroy
// 2016 use in "The Devil is in the Details: idTech 666".
#define_import_path lightbench::clusters

#import lightbench::scene
#import lightbench::culling

const TILE: u32 = #{TILE}u;
const SLICES: u32 = #{SLICES}u;

// Where the last slice would begin if the far plane were farther: it takes all that lies beyond.
const FARTHEST: f32 = 10000.0;

// Where the slices end: at the far plane, or at FARTHEST where that is nearer.
fn far_end() -> f32 {
    return min(scene::frame.far, FARTHEST);
}

// Tiles across and down; those at the edges may be cut.
fn columns_and_rows() -> vec2u {
    return (vec2u(scene::frame.resolution) + TILE - 1u) / TILE;
}

// Distance along the view at which a slice begins.
fn slice_start(slice: u32) -> f32 {
    let near = scene::frame.near;
    return near * pow(far_end() / near, f32(slice) / f32(SLICES));
}

// The slice at a distance along the view.
fn slice_of(view_distance: f32) -> u32 {
    let near = scene::frame.near;
    let share = log(max(view_distance, near) / near) / log(far_end() / near);
    return min(u32(share * f32(SLICES)), SLICES - 1u);
}

// Which cluster holds a pixel at a distance: clusters of a tile follow one another.
fn cluster_of(pixel: vec2f, view_distance: f32) -> u32 {
    let tile = vec2u(pixel) / TILE;
    return (tile.y * columns_and_rows().x + tile.x) * SLICES + slice_of(view_distance);
}

// The box in view space around a slice of a tile, a little larger than it is, since the slice of a
// pixel is found with rounding.
fn cluster_box(tile: vec2u, slice: u32) -> culling::Box {
    let nearest = slice_start(slice) * 0.999;
    var farthest = slice_start(slice + 1u) * 1.001;
    if slice == SLICES - 1u {
        farthest = 1.0e30;
    }
    let scale = vec2f(1.0 / scene::frame.projection[0][0], 1.0 / scene::frame.projection[1][1]);
    let from_ndc = vec2f(tile * TILE) / scene::frame.resolution * 2.0 - 1.0;
    let to_ndc = vec2f((tile + 1u) * TILE) / scene::frame.resolution * 2.0 - 1.0;
    // Slopes of the edges; pixels count downward.
    let low = vec2f(from_ndc.x, -to_ndc.y) * scale;
    let high = vec2f(to_ndc.x, -from_ndc.y) * scale;
    return culling::Box(
        vec3f(min(low * nearest, low * farthest), -farthest),
        vec3f(max(high * nearest, high * farthest), -nearest),
    );
}
