// The lights that may reach a tile of the screen at any depth, found by one workgroup, as a mask.
//
// In:  the spheres around the lights, up to 4,096 at a time.
// Out: a mask of those whose sphere meets the tile. Each cluster of the tile then tests only these.
// Called by every invocation of the workgroup, in uniform control flow.
#define_import_path lightbench::column_lights

#import lightbench::scene
#import lightbench::culling

const BATCH: u32 = 4096u;
const WORDS: u32 = 128u;
const THREADS: u32 = 64u;

@group(1) @binding(0) var<storage, read> light_spheres: array<vec4f>;

var<workgroup> column_mask: array<atomic<u32>, WORDS>;

// Tests the lights from `first` on. Afterwards `mask` tells.
fn find(thread: u32, first: u32, sides: culling::Sides) {
    workgroupBarrier();
    for (var word = thread; word < WORDS; word += THREADS) {
        atomicStore(&column_mask[word], 0u);
    }
    workgroupBarrier();
    let count = min(scene::frame.light_count - first, BATCH);
    for (var i = thread; i < count; i += THREADS) {
        if culling::meets_sides(sphere(first + i), sides) {
            atomicOr(&column_mask[i >> 5u], 1u << (i & 31u));
        }
    }
    workgroupBarrier();
}

// The sphere around a light.
fn sphere(light: u32) -> culling::Sphere {
    let ball = light_spheres[light];
    return culling::Sphere(ball.xyz, ball.w);
}

// A word of the mask: bit i of word w is the light first + 32 w + i.
fn mask(word: u32) -> u32 {
    return atomicLoad(&column_mask[word]);
}
