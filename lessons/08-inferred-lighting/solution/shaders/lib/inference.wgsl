// Which surface a texel of a small buffer shows, and whose light a fragment takes.
//
// Distances are metres along the view.
#define_import_path inference

const DEPTH_BITS: u32 = 12u;
const FIRST_PLACE = vec2u(1u, 0u);

// Distances are kept from here to there.
const NEAREST: f32 = 0.1;
const FARTHEST: f32 = 1000.0;

// Each transparent layer has one texel in so many, across and down.
const PERIOD: u32 = 3u;

// Codes of a distance but for 0, and the steps between them.
const CODES: u32 = (1u << DEPTH_BITS) - 1u;
const STEPS: f32 = f32(CODES - 1u);

// TASK key: equal steps of the logarithm, so that each is the same share of the distance.
fn pack_surface(distance: f32, object: u32) -> u32 {
    let share = log(distance / NEAREST) / log(FARTHEST / NEAREST);
    let code = 1u + u32(round(clamp(share, 0.0, 1.0) * STEPS));
    return object << DEPTH_BITS | code;
}

fn distance_of(key: u32) -> f32 {
    let code = key & CODES;
    return NEAREST * pow(FARTHEST / NEAREST, f32(max(code, 1u) - 1u) / STEPS);
}

// TASK same: 1 / distance is linear on the screen.
fn expected_distance(distance: f32, slope: vec2f, offset: vec2f) -> f32 {
    return 1.0 / max(1.0 / distance + dot(slope, offset), 1.0 / FARTHEST);
}

fn is_same(key: u32, object: u32, expected: f32, tolerance: f32) -> bool {
    if key == 0u || (key ^ (object << DEPTH_BITS)) > CODES {
        return false;
    }
    return abs(distance_of(key) - expected) <= tolerance * expected;
}

// TASK filter: bilinear weights of those that show the surface, brought to 1. Where these are all 0, each of them
// counts as much; where there are none, all texels as usual.
fn weights(fraction: vec2f, same: vec4<bool>) -> vec4f {
    let rest = 1.0 - fraction;
    let bilinear = vec4f(rest.x, fraction.x, rest.x, fraction.x) * vec4f(rest.yy, fraction.yy);
    if !any(same) {
        return bilinear;
    }
    let own = select(vec4f(0.0), bilinear, same);
    let sum = own.x + own.y + own.z + own.w;
    if sum < 0.001 {
        let each = select(vec4f(0.0), vec4f(1.0), same);
        return each / dot(each, vec4f(1.0));
    }
    return own / sum;
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

// TASK stipple: each layer is one column farther right and one row farther down than the one before.
fn place_of(layer: u32) -> vec2u {
    return (FIRST_PLACE + layer) % PERIOD;
}

fn is_of_layer(texel: vec2u, layer: u32) -> bool {
    return all(texel % PERIOD == place_of(layer));
}

fn layer_footprint(at: vec2f, layer: u32) -> Footprint {
    let place = vec2f(place_of(layer));
    let steps = (at - 0.5 - place) / f32(PERIOD);
    return Footprint(vec2i(floor(steps) * f32(PERIOD) + place), fract(steps));
}
