// Light indexing by arrays: one light writes its number into the channel of its array.
//
// In:  the light and its number; depth, unless ANY_DEPTH. CAPACITY as in
//      shaders/lib/index_packing.wgsl.
// Out: the number, in all channels: the pass writes only that of the light's array.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::scene
#import lightbench::index_packing
#import lightbench::light_reach

@group(1) @binding(0) var<storage, read> light_numbers: array<u32>;

struct Channels {
    @location(0) first: vec4f,
#if CAPACITY == 8
    @location(1) second: vec4f,
#endif
}

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> Channels {
    if light_numbers[light] == 0u || !light_reach::is_reached(pixel.xy, scene::lights[light]) {
        discard;
    }
    let texels = index_packing::pack(light_numbers[light]);
    var out: Channels;
    out.first = texels.first;
#if CAPACITY == 8
    out.second = texels.second;
#endif
    return out;
}
