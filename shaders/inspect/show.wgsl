// Inspect: a slice of any target as a picture for people.
//
// In:  the target of `lightbench::inspected`; which sample, channels, range and map.
// Out: display-ready colours. What is not a number is magenta.
#import lightbench::color
#import lightbench::color_map
#import lightbench::inspected

struct Inspection {
    low: f32,       // shown as black
    high: f32,      // shown as white
    near: f32,      // metres; with `far`, turns depth into a distance
    far: f32,       // metres; infinity is sent as 0
    channels: u32,  // SHOW_…
    map: u32,       // MAP_…
    slice: i32,     // of a volume
    sample: i32,    // of a texel with several; below 0: the mean of all
}

@group(0) @binding(0) var<uniform> inspection: Inspection;

const SHOW_COLOR: u32 = 4u;     // 0 to 3 are single channels

const MAP_LIGHT: u32 = 0u;      // linear light, coded as sRGB
const MAP_DATA: u32 = 1u;       // values as they are
const MAP_FALSE_COLOR: u32 = 2u;

// Rust's numbers for these are in engine/render/src/inspect/show.rs.

fn is_nan(x: f32) -> bool {
    // Compilers may assume that x != x is false.
    return (bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u;
}

fn show(value: vec4f) -> vec4f {
    var shown = value.rgb;
    if inspection.channels != SHOW_COLOR {
        shown = vec3f(value[min(inspection.channels, 3u)]);
    }
    if is_nan(shown.r) || is_nan(shown.g) || is_nan(shown.b) {
        return vec4f(1.0, 0.0, 1.0, 1.0);
    }
    let scaled = saturate((shown - inspection.low) / (inspection.high - inspection.low));
    switch inspection.map {
        case MAP_LIGHT: { return vec4f(color::encode_srgb(scaled), 1.0); }
        case MAP_FALSE_COLOR: {
            // Of a colour, false colours show the luminance (Rec. 709).
            let value = dot(scaled, vec3f(0.2126, 0.7152, 0.0722));
            return vec4f(saturate(color_map::viridis(value)), 1.0);
        }
        default: { return vec4f(scaled, 1.0); }
    }
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec3i(vec2i(pixel.xy), inspection.slice);
    let value = inspected::load_value(texel, inspection.sample);
#ifdef DEPTH
    // Nothing was drawn at infinity: it is as far as the range shows.
    let metres = inspected::metres(value.r, inspection.near, inspection.far);
    return show(vec4f(vec3f(metres), 1.0));
#else
    return show(value);
#endif
}
