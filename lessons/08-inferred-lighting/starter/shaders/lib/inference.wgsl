// Which surface a texel of a small buffer shows, and whose light a fragment takes.
//
// These functions run and find nothing. Fill them in one after the other; the text says how. Distances are metres
// along the view.
#define_import_path inference

// Yours are in README.md.
const DEPTH_BITS: u32 = 8u;             // bits of a key that hold the distance
const FIRST_PLACE = vec2u(0u, 0u);      // column and row of the first transparent layer in each 3 × 3 texels

// Distances are kept from here to there.
const NEAREST: f32 = 0.1;
const FARTHEST: f32 = 1000.0;

// Each transparent layer has one texel in so many, across and down.
const PERIOD: u32 = 3u;

// TASK key: what a texel keeps of the surface that it shows: the distance in the lower DEPTH_BITS bits, as one of
// their codes from 1 on, and the object's number above, as far as it fits. 0 is no surface.
fn pack_surface(distance: f32, object: u32) -> u32 {
    return 0u;
}

// TASK key: the distance that a key holds.
fn distance_of(key: u32) -> f32 {
    return 0.0;
}

// TASK same: the distance at which a fragment's plane lies at another pixel.
//
// distance:  of the fragment
// slope:     by how much 1 / distance changes to the next pixel on the right and below
// offset:    from the fragment to the other place, in pixels
fn expected_distance(distance: f32, slope: vec2f, offset: vec2f) -> f32 {
    return 0.0;
}

// TASK same: whether a key is that of an object, at a distance that is off by at most a share of the expected one.
fn is_same(key: u32, object: u32, expected: f32, tolerance: f32) -> bool {
    return false;
}

// TASK filter: how much of the light of four texels a fragment takes: upper left, upper right, lower left and lower
// right. Together it is 1.
//
// fraction:  where the fragment lies between their middles, from 0 to 1 across and down
// same:      which of them show its surface
fn weights(fraction: vec2f, same: vec4<bool>) -> vec4f {
    return vec4f(0.0);
}

// Four texels around a place, and where the place lies between their middles.
struct Footprint {
    corner: vec2i,                      // the upper left one
    fraction: vec2f,                    // from 0 to 1 across and down
}

// The four texels of a small buffer around a place in it, in texels from its upper left corner.
fn footprint(at: vec2f) -> Footprint {
    let from_middle = at - 0.5;
    return Footprint(vec2i(floor(from_middle)), fract(from_middle));
}

// TASK stipple: whether a texel belongs to a transparent layer.
fn is_of_layer(texel: vec2u, layer: u32) -> bool {
    return false;
}

// TASK stipple: the four texels of a layer around a place. The others of the four are PERIOD texels farther right
// and down.
fn layer_footprint(at: vec2f, layer: u32) -> Footprint {
    return Footprint(vec2i(0), vec2f(0.0));
}
