// Discontinuity-sensitive filtering: light of a small buffer is taken for a fragment of a large
// picture from those texels alone that show the same surface.
//
// In:  for each texel of the small buffers, what it shows: a depth, an object and a smooth group,
//      or with OBJECT_ID an object alone. For a fragment the same, and how its depth changes from
//      pixel to pixel.
// Out: whether a texel shows the fragment's surface.
// Depth is linear, in 16 bits from the camera to the far plane; 0 is nothing. Object and group have
// 8 bits each, so that objects share numbers where there are more than 256; an object alone has 16.
// Follows Kircher and Lawrance 2009, "Inferred Lighting: Fast Dynamic Lighting and Shadows for
// Opaque and Translucent Objects"; numbers of objects alone are Pettineo's variant of it. A
// surface's depth is continued along its plane, where 1 / depth is linear, so that slopes are not
// taken for edges.
#define_import_path lightbench::discontinuity

#import lightbench::scene

// Where depth ends if the far plane is farther or infinite.
const FARTHEST: f32 = 10000.0;

// The layers that transparent objects are stippled into: texels of each 2 × 2 that have odd numbers
// in x, in y, or in both. The others are always those of opaque objects.
fn place_of_layer(layer: u32) -> vec2u {
    let place = layer + 1u;
    return vec2u(place & 1u, place >> 1u);
}

fn is_of_layer(texel: vec2u, layer: u32) -> bool {
    return all((texel & vec2u(1u)) == place_of_layer(layer));
}

// One step of the kept depth, metres.
fn depth_step() -> f32 {
    return min(scene::frame.far, FARTHEST) / 65534.0;
}

// What a texel keeps. `view_distance` is along the view, metres.
fn pack(view_distance: f32, object: u32, group: u32) -> vec2u {
#ifdef OBJECT_ID
    return vec2u(object % 65535u + 1u, 0u);
#else
    let depth = 1u + u32(min(round(view_distance / depth_step()), 65534.0));
    return vec2u(depth, (object & 0xffu) << 8u | (group & 0xffu));
#endif
}

// A fragment as it looks for texels of its surface.
struct Seeker {
    inverse_distance: f32,              // 1 / distance along the view, 1 / metres
    slope: vec2f,                       // its change to the next pixel on the right and below
    own: vec2u,                         // what a texel of it would keep
    tolerance: f32,                     // share of the distance by which depth may differ
}

// Whether a texel shows the surface; `offset` is where it lies, in pixels from the fragment.
fn is_same_surface(texel: vec2u, seeker: Seeker, offset: vec2f) -> bool {
#ifdef OBJECT_ID
    return texel.x == seeker.own.x;
#else
    if texel.x == 0u || texel.y != seeker.own.y {
        return false;
    }
    let inverse = seeker.inverse_distance + dot(seeker.slope, offset);
    let expected = 1.0 / max(inverse, 1e-6);
    let found = f32(texel.x - 1u) * depth_step();
    return abs(found - expected) <= seeker.tolerance * expected + depth_step();
#endif
}
