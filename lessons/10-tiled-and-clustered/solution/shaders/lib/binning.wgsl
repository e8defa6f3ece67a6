// Which lights reach which part of the view: tiles of the screen, cut along the view into slices.
//
// Distances are metres along the view; positions are in view space.
#define_import_path binning

const COLUMNS: u32 = 16u;
const ROWS: u32 = 9u;
const SLICES: u32 = 12u;
const FIRST_END: f32 = 3.0;
const REACH: f32 = 60.0;

// An end that is none.
const NO_END: f32 = 1.0e30;

// TASK tile: so large that COLUMNS × ROWS tiles cover the picture.
fn tile_size(resolution: vec2u) -> vec2u {
    let tiles = vec2u(COLUMNS, ROWS);
    return (resolution + tiles - 1u) / tiles;
}

fn tile_of(pixel: vec2f, resolution: vec2u) -> vec2u {
    return vec2u(pixel) / tile_size(resolution);
}

// The slope of a place in the picture, in pixels from the upper left.
fn slope_at(place: vec2f, resolution: vec2u, spread: vec2f) -> vec2f {
    let share = place / vec2f(resolution);
    return spread * vec2f(2.0 * share.x - 1.0, 1.0 - 2.0 * share.y);
}

fn tile_slopes(tile: vec2u, resolution: vec2u, spread: vec2f) -> vec4f {
    let size = tile_size(resolution);
    let upper_left = slope_at(vec2f(tile * size), resolution, spread);
    let lower_right = slope_at(vec2f((tile + 1u) * size), resolution, spread);
    return vec4f(upper_left.x, lower_right.x, lower_right.y, upper_left.y);
}

// TASK sphere: a plane through the eye with the slope s has the normal (1, -s) in the plane of `along` and
// the distance ahead. The sphere is out if it lies wholly beyond one of the four.
fn beyond(along: f32, ahead: f32, slope: f32) -> f32 {
    return (along - slope * ahead) / sqrt(1.0 + slope * slope);
}

fn meets_tile(center: vec3f, radius: f32, slopes: vec4f) -> bool {
    let ahead = -center.z;
    return beyond(center.x, ahead, slopes.x) >= -radius
        && beyond(center.x, ahead, slopes.y) <= radius
        && beyond(center.y, ahead, slopes.z) >= -radius
        && beyond(center.y, ahead, slopes.w) <= radius;
}

// TASK slice: the first slice ends at FIRST_END; each other is longer than the one before by the same factor.
fn slice_of(distance: f32) -> u32 {
    if distance < FIRST_END {
        return 0u;
    }
    let share = log(distance / FIRST_END) / log(REACH / FIRST_END);
    return min(1u + u32(share * f32(SLICES - 1u)), SLICES - 1u);
}

fn slice_begin(slice: u32) -> f32 {
    if slice == 0u {
        return 0.0;
    }
    return FIRST_END * pow(REACH / FIRST_END, f32(slice - 1u) / f32(SLICES - 1u));
}

fn slice_range(slice: u32) -> vec2f {
    if slice == SLICES - 1u {
        return vec2f(slice_begin(slice), NO_END);
    }
    return vec2f(slice_begin(slice), slice_begin(slice + 1u));
}

// TASK cluster: the box around the cluster, and the place in it that is nearest to the sphere's centre (Arvo
// 1990, "A Simple Method for Box-Sphere Intersection Testing", Graphics Gems).
fn meets_cluster(center: vec3f, radius: f32, slopes: vec4f, range: vec2f) -> bool {
    let near_edges = slopes * range.x;
    let far_edges = slopes * range.y;
    let lowest = min(near_edges, far_edges);
    let highest = max(near_edges, far_edges);
    let low = vec3f(lowest.x, lowest.z, -range.y);
    let high = vec3f(highest.y, highest.w, -range.x);
    return distance(center, clamp(center, low, high)) <= radius;
}
