// The lights of one tile of the screen, found by one workgroup.
//
// In:  depths of the tile's pixels; the spheres around the lights.
// Out: for each batch of 1,024 lights, a mask of those that may reach the tile. A mask keeps the order
//      of the lights, so that sums come out the same on every run, and it can't overflow.
// Follows Andersson 2011, "DirectX 11 Rendering in Battlefield 3"; with DEPTH_MASK also Harada 2012,
// "A 2.5D Culling for Forward+", SIGGRAPH Asia.
//
// All functions are called by every invocation of the workgroup, in uniform control flow.
#define_import_path lightbench::tile_lights

#import lightbench::scene
#import lightbench::culling

// Lights that are tested at once, and the words of their mask.
const BATCH: u32 = 1024u;
const WORDS: u32 = 32u;
// Invocations of a workgroup. There are few, each with several pixels and lights: that keeps
// barriers cheap where a processor runs the workgroup.
const THREADS: u32 = 64u;

@group(1) @binding(0) var<storage, read> light_spheres: array<vec4f>;

// Distances are kept as bits: those of positive floats are ordered as the floats are.
var<workgroup> nearest_bits: atomic<u32>;
var<workgroup> farthest_bits: atomic<u32>;
var<workgroup> sky_pixels: atomic<u32>;
var<workgroup> depth_slices: atomic<u32>;
var<workgroup> solid_mask: array<atomic<u32>, WORDS>;
var<workgroup> clear_mask: array<atomic<u32>, WORDS>;

// What lies between two distances along the view.
struct DepthRange {
    nearest: f32,
    farthest: f32,
}

// Begins a tile.
fn reset(thread: u32) {
    if thread == 0u {
        atomicStore(&nearest_bits, 0x7f7fffffu);
        atomicStore(&farthest_bits, 0u);
        atomicStore(&sky_pixels, 0u);
        atomicStore(&depth_slices, 0u);
    }
    workgroupBarrier();
}

// Takes a pixel into account: its reversed depth, 0 for sky.
fn add_depth(depth: f32) {
    if depth == 0.0 {
        atomicOr(&sky_pixels, 1u);
        return;
    }
    let distance_bits = bitcast<u32>(culling::view_distance(depth));
    atomicMin(&nearest_bits, distance_bits);
    atomicMax(&farthest_bits, distance_bits);
}

// The distances between which the tile has opaque surfaces. Sky does not count.
fn depth_range() -> DepthRange {
    workgroupBarrier();
    return DepthRange(
        bitcast<f32>(atomicLoad(&nearest_bits)),
        bitcast<f32>(atomicLoad(&farthest_bits)),
    );
}

// One of 32 slices between the distances of a range.
fn slice_of(view_distance: f32, range: DepthRange) -> u32 {
    let share = (view_distance - range.nearest) / max(range.farthest - range.nearest, 1e-6);
    return u32(clamp(share * 32.0, 0.0, 31.0));
}

// Marks the slice in which a pixel lies; after `depth_range`.
fn mark_slice(depth: f32, range: DepthRange) {
    if depth != 0.0 {
        atomicOr(&depth_slices, 1u << slice_of(culling::view_distance(depth), range));
    }
}

// Whether a slice with a surface lies within the ball's distances.
fn meets_slices(ball: culling::Sphere, range: DepthRange) -> bool {
    let first = slice_of(max(-ball.center.z - ball.radius, range.nearest), range);
    let last = slice_of(min(-ball.center.z + ball.radius, range.farthest), range);
    let from_first = 0xffffffffu << first;
    let to_last = 0xffffffffu >> (31u - last);
    return (atomicLoad(&depth_slices) & from_first & to_last) != 0u;
}

// Tests the lights from `first` on against the tile. Afterwards `solid` and `clear` tell.
fn find(thread: u32, first: u32, sides: culling::Sides, range: DepthRange) {
    workgroupBarrier();
    if thread < WORDS {
        atomicStore(&solid_mask[thread], 0u);
        atomicStore(&clear_mask[thread], 0u);
    }
    workgroupBarrier();
    // Transparent surfaces lie anywhere before the farthest opaque one, or the sky.
    var farthest = range.farthest;
    if atomicLoad(&sky_pixels) != 0u {
        farthest = 1.0e30;
    }
    // Balls that are large beside the tile meet its four planes and its distances far more often than
    // what lies between them all; the box around that tells most of these apart.
    let space = culling::sides_box(sides, range.nearest, range.farthest);
    let any_solid = range.nearest <= range.farthest;
    let count = min(scene::frame.light_count - first, BATCH);
    for (var i = thread; i < count; i += THREADS) {
        let sphere = light_spheres[first + i];
        let ball = culling::Sphere(sphere.xyz, sphere.w);
        let meets = culling::meets_sides(ball, sides);
        let reaches_clear = meets && culling::meets_range(ball, 0.0, farthest);
        var reaches_solid = meets && any_solid && culling::meets_box(ball, space);
#ifdef DEPTH_MASK
        reaches_solid = reaches_solid && meets_slices(ball, range);
#endif
        let bit = 1u << (i & 31u);
        if reaches_solid {
            atomicOr(&solid_mask[i >> 5u], bit);
        }
        if reaches_clear {
            atomicOr(&clear_mask[i >> 5u], bit);
        }
    }
    workgroupBarrier();
}

// A word of the mask of the lights that may reach opaque surfaces.
fn solid(word: u32) -> u32 {
    return atomicLoad(&solid_mask[word]);
}

// A word of the mask of the lights that may reach transparent surfaces.
fn clear(word: u32) -> u32 {
    return atomicLoad(&clear_mask[word]);
}
