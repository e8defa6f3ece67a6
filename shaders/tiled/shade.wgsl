// Tiled deferred shading, second pass: one workgroup finds the lights of its tile and shades it.
//
// In:  what shaders/lib/g_buffer_texels.wgsl reads, and emitted light; the spheres around the lights.
//      TILE is the side of a tile in pixels.
// Out: linear radiance of the tile's pixels; the number of lights of each tile, for display.
// Lights are taken 1,024 at a time and shaded with before the next are looked for, so that no list can
// be too long. Each pixel's sum stays in registers and is rounded once.
// Follows Andersson 2011, "DirectX 11 Rendering in Battlefield 3", and Lauritzen 2010, "Deferred
// Rendering for Current and Future Rendering Pipelines".
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer_texels
#import lightbench::culling
#import lightbench::tile_lights

@group(1) @binding(1) var emitted: texture_2d<f32>;
#ifdef FULL_FLOAT
@group(1) @binding(2) var hdr: texture_storage_2d<rgba32float, write>;
#else
@group(1) @binding(2) var hdr: texture_storage_2d<rgba16float, write>;
#endif
@group(1) @binding(3) var<storage, read_write> tile_totals: array<atomic<u32>>;
@group(1) @binding(4) var tile_light_count: texture_storage_2d<r32uint, write>;

// Invocations along a side of the workgroup, and pixels along a side that each shades.
const SIDE: u32 = 8u;
const PIXELS: u32 = #{TILE}u / SIDE;
const OWN_PIXELS: u32 = PIXELS * PIXELS;

@compute @workgroup_size(SIDE, SIDE)
fn compute_main(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let size = textureDimensions(emitted);
    let corner = tile.xy * #{TILE}u;

    var depths: array<f32, OWN_PIXELS>;
    tile_lights::reset(thread);
    for (var p = 0u; p < OWN_PIXELS; p++) {
        let texel = corner + local.xy + vec2u(p % PIXELS, p / PIXELS) * SIDE;
        depths[p] = 0.0;
        if all(texel < size) {
            depths[p] = g_buffer_texels::depth_at(texel, 0u);
            tile_lights::add_depth(depths[p]);
        }
    }
    let range = tile_lights::depth_range();
#ifdef DEPTH_MASK
    for (var p = 0u; p < OWN_PIXELS; p++) {
        tile_lights::mark_slice(depths[p], range);
    }
#endif

    var surfaces: array<surface::Surface, OWN_PIXELS>;
    var radiance: array<vec3f, OWN_PIXELS>;
    for (var p = 0u; p < OWN_PIXELS; p++) {
        let texel = corner + local.xy + vec2u(p % PIXELS, p / PIXELS) * SIDE;
        surfaces[p] = g_buffer_texels::surface_at(texel, 0u);
        radiance[p] = textureLoad(emitted, texel, 0).rgb;
    }

    let sides = culling::rectangle_sides(vec2f(corner), vec2f(corner + #{TILE}u), vec2f(size));
    var count = 0u;
    for (var first = 0u; first < scene::frame.light_count; first += tile_lights::BATCH) {
        tile_lights::find(thread, first, sides, range);
        for (var word = 0u; word < tile_lights::WORDS; word++) {
            var bits = tile_lights::solid(word);
            count += countOneBits(bits);
            while bits != 0u {
                let light = scene::lights[first + word * 32u + firstTrailingBit(bits)];
                bits &= bits - 1u;
                for (var p = 0u; p < OWN_PIXELS; p++) {
                    if depths[p] > 0.0 {
                        let to_viewer = surface::safe_normalize(
                            scene::frame.camera_position - surfaces[p].position
                        );
                        radiance[p] += lighting::evaluate_light(light, surfaces[p], to_viewer);
                    }
                }
            }
        }
    }

    for (var p = 0u; p < OWN_PIXELS; p++) {
        let texel = corner + local.xy + vec2u(p % PIXELS, p / PIXELS) * SIDE;
        if all(texel < size) {
            textureStore(hdr, texel, vec4f(radiance[p], 1.0));
        }
    }
    if thread == 0u {
        textureStore(tile_light_count, tile.xy, vec4u(count));
        atomicAdd(&tile_totals[0], count);
        atomicMax(&tile_totals[1], count);
    }
}
