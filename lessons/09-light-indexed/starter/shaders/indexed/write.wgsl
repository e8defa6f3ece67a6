// One light writes its number into the pixels that it reaches.
//
// In:  the light; depth.
// Out: 1/255 for the count; the number, packed. A light beyond the last number writes none, and is counted all
//      the same.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::scene
#import lightbench::light_reach
#import indexing

struct Written {
    @location(0) count: f32,
    @location(1) indices: vec4f,
}

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> Written {
    if !light_reach::is_reached(pixel.xy, scene::lights[light]) {
        discard;
    }
    let number = light + 1u;
    if number > indexing::most_lights() {
        return Written(1.0 / 255.0, vec4f(0.0));
    }
    return Written(1.0 / 255.0, indexing::pack(number));
}
