// Light indexing by bit packing: one light blends its number over those that are there.
//
// In:  the light and its number; depth, unless ANY_DEPTH. CAPACITY as in
//      shaders/lib/index_packing.wgsl.
// Out: 1/255 for the count; the number's bits, for the blend factor of the pass to move down.
// A light without a number is counted all the same, which shows that it was lost.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::scene
#import lightbench::index_packing
#import lightbench::light_reach

@group(1) @binding(0) var<storage, read> light_numbers: array<u32>;

struct Packed {
    @location(0) count: f32,
    @location(1) first: vec4f,
#if CAPACITY == 8
    @location(2) second: vec4f,
#endif
}

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> Packed {
    if !light_reach::is_reached(pixel.xy, scene::lights[light]) {
        discard;
    }
    let texels = index_packing::pack(light_numbers[light]);
    var out: Packed;
    out.count = 1.0 / 255.0;
    out.first = texels.first;
#if CAPACITY == 8
    out.second = texels.second;
#endif
    return out;
}
