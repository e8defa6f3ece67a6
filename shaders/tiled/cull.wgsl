// Tiled forward shading, second pass: the list of lights of each tile.
//
// In:  depth of the pre-pass, with MULTISAMPLED all its samples; the spheres around the lights. TILE
//      is the side of a tile in pixels, CAPACITY the room of a list.
// Out: two lists a tile, for opaque and for transparent surfaces: the number of lights, then their
//      indices in ascending order. What does not fit is counted.
// Follows Harada, McKee and Yang 2012, "Forward+: Bringing Deferred Lighting to the Next Level".
#import lightbench::scene
#import lightbench::culling
#import lightbench::tile_lights

#ifdef MULTISAMPLED
@group(1) @binding(1) var depth: texture_depth_multisampled_2d;
#else
@group(1) @binding(1) var depth: texture_depth_2d;
#endif
@group(1) @binding(2) var<storage, read_write> tile_lists: array<u32>;
@group(1) @binding(3) var<storage, read_write> tile_lists_transparent: array<u32>;
@group(1) @binding(4) var<storage, read_write> tile_totals: array<atomic<u32>>;

// Invocations along a side of the workgroup, and pixels along a side that each looks at.
const SIDE: u32 = 8u;
const PIXELS: u32 = #{TILE}u / SIDE;

@compute @workgroup_size(SIDE, SIDE)
fn compute_main(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(num_workgroups) tiles: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let size = textureDimensions(depth);
    let corner = tile.xy * #{TILE}u;

    tile_lights::reset(thread);
    for (var p = 0u; p < PIXELS * PIXELS; p++) {
        let texel = corner + local.xy + vec2u(p % PIXELS, p / PIXELS) * SIDE;
        if all(texel < size) {
#ifdef MULTISAMPLED
            for (var s = 0u; s < textureNumSamples(depth); s++) {
                tile_lights::add_depth(textureLoad(depth, texel, s));
            }
#else
            tile_lights::add_depth(textureLoad(depth, texel, 0));
#endif
        }
    }
    let range = tile_lights::depth_range();
#ifdef DEPTH_MASK
    for (var p = 0u; p < PIXELS * PIXELS; p++) {
        let texel = corner + local.xy + vec2u(p % PIXELS, p / PIXELS) * SIDE;
        if all(texel < size) {
#ifdef MULTISAMPLED
            for (var s = 0u; s < textureNumSamples(depth); s++) {
                tile_lights::mark_slice(textureLoad(depth, texel, s), range);
            }
#else
            tile_lights::mark_slice(textureLoad(depth, texel, 0), range);
#endif
        }
    }
#endif

    let sides = culling::rectangle_sides(vec2f(corner), vec2f(corner + #{TILE}u), vec2f(size));
    let list = (tile.y * tiles.x + tile.x) * (#{CAPACITY}u + 1u);
    var solid_count = 0u;
    var clear_count = 0u;
    for (var first = 0u; first < scene::frame.light_count; first += tile_lights::BATCH) {
        tile_lights::find(thread, first, sides, range);
        // Each invocation writes the lights of one word, behind those of the words before it.
        if thread < tile_lights::WORDS {
            var solid_at = list + 1u + solid_count;
            var clear_at = list + 1u + clear_count;
            for (var word = 0u; word < thread; word++) {
                solid_at += countOneBits(tile_lights::solid(word));
                clear_at += countOneBits(tile_lights::clear(word));
            }
            let light = first + thread * 32u;
            let end = list + 1u + #{CAPACITY}u;
            for (var bits = tile_lights::solid(thread); bits != 0u && solid_at < end; solid_at++) {
                tile_lists[solid_at] = light + firstTrailingBit(bits);
                bits &= bits - 1u;
            }
            for (var bits = tile_lights::clear(thread); bits != 0u && clear_at < end; clear_at++) {
                tile_lists_transparent[clear_at] = light + firstTrailingBit(bits);
                bits &= bits - 1u;
            }
        }
        for (var word = 0u; word < tile_lights::WORDS; word++) {
            solid_count += countOneBits(tile_lights::solid(word));
            clear_count += countOneBits(tile_lights::clear(word));
        }
    }
    if thread == 0u {
        tile_lists[list] = min(solid_count, #{CAPACITY}u);
        tile_lists_transparent[list] = min(clear_count, #{CAPACITY}u);
        atomicAdd(&tile_totals[0], solid_count);
        atomicMax(&tile_totals[1], max(solid_count, clear_count));
        if max(solid_count, clear_count) > #{CAPACITY}u {
            atomicAdd(&tile_totals[2], 1u);
        }
    }
}
