// Light indexing by arrays: counts the lights that reach each pixel, so that it shows where one
// found no room in any array.
//
// In:  the light; depth, unless ANY_DEPTH.
// Out: 1/255, to add.
#import lightbench::scene
#import lightbench::light_reach

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> @location(0) f32 {
    if !light_reach::is_reached(pixel.xy, scene::lights[light]) {
        discard;
    }
    return 1.0 / 255.0;
}
