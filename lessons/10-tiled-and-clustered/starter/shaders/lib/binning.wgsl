// Which lights reach which part of the view: tiles of the screen, cut along the view into slices.
//
// These functions run and find nothing. Fill them in one after the other; the text says how. Distances are
// metres along the view; positions are in view space: x to the right, y up, the eye at the origin, looking
// along -z.
#define_import_path binning

// Yours are in README.md.
const COLUMNS: u32 = 1u;        // tiles across
const ROWS: u32 = 1u;           // tiles down
const SLICES: u32 = 1u;         // slices of each tile
const FIRST_END: f32 = 1.0;     // where the first slice ends
const REACH: f32 = 100.0;       // where even the last slice has begun

// An end that is none.
const NO_END: f32 = 1.0e30;

// TASK tile: the width and height of a tile in pixels.
fn tile_size(resolution: vec2u) -> vec2u {
    return vec2u(1u);
}

// TASK tile: the tile of a pixel, counted from 0 at the upper left. `pixel` is @builtin(position).xy, the
// middle of the pixel.
fn tile_of(pixel: vec2f, resolution: vec2u) -> vec2u {
    return vec2u(0u);
}

// TASK tile: the slopes of the tile's edges as seen from the eye: left, right, bottom, top. A slope is x or y
// at a distance of 1. At the right and upper edge of the picture it is `spread`.
fn tile_slopes(tile: vec2u, resolution: vec2u, spread: vec2f) -> vec4f {
    return vec4f(0.0);
}

// TASK sphere: whether a sphere may meet what lies between the edges of a tile, at any distance.
fn meets_tile(center: vec3f, radius: f32, slopes: vec4f) -> bool {
    return false;
}

// TASK slice: the slice at a distance.
fn slice_of(distance: f32) -> u32 {
    return 0u;
}

// TASK slice: the distances at which a slice begins and ends.
fn slice_range(slice: u32) -> vec2f {
    return vec2f(0.0);
}

// TASK cluster: whether a sphere may meet what lies between the edges of a tile and the two distances of
// `range`.
fn meets_cluster(center: vec3f, radius: f32, slopes: vec4f, range: vec2f) -> bool {
    return false;
}
