// Heat map: counts as colours, the picture of a pipeline that shows how much work each pixel made.
//
// In:  `counts`, in red; `heat_map_most`, the count that is shown brightest.
// Out: display-ready colours: viridis from 0 to the most, white where there is more.
#import lightbench::color_map

struct Parameters {
    heat_map_most: f32,
}

@group(1) @binding(0) var counts: texture_2d<f32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let count = textureLoad(counts, vec2i(pixel.xy), 0).r;
    if count > parameters.heat_map_most {
        return vec4f(1.0);
    }
    let share = saturate(count / parameters.heat_map_most);
    return vec4f(saturate(color_map::viridis(share)), 1.0);
}
