// The picture of the balls, and below it a curve for each BRDF: how much it sends away of what arrives.
//
// In:  linear radiance; what was measured.
// Out: values of a display. From left to right the light sinks from straight above to the horizon; the white
//      line is where all that arrives is sent away, the lower edge is nothing, the upper one twice as much.
//      A curve is broken where lamp and eye can't change places.
#import lightbench::scene
#import lightbench::color
#import suspects

@group(1) @binding(0) var light: texture_2d<f32>;
@group(1) @binding(1) var measured: texture_2d<f32>;

// From where on the picture is the graph, as a share of its height.
const GRAPH_BEGINS: f32 = 0.4;

const COLORS = array<vec3f, 7>(
    vec3f(0.6), vec3f(1.0, 0.45, 0.05), vec3f(0.9, 0.06, 0.06), vec3f(0.85, 0.8, 0.08),
    vec3f(0.1, 0.7, 0.15), vec3f(0.1, 0.35, 1.0), vec3f(0.75, 0.2, 1.0),
);

// What was measured at a place from 0 to 1, straight between two angles.
fn measured_at(number: u32, place: f32) -> vec2f {
    let column = clamp(place * 90.0 - 0.5, 0.0, 88.999);
    let left = textureLoad(measured, vec2u(u32(column), number), 0).rg;
    let right = textureLoad(measured, vec2u(u32(column) + 1u, number), 0).rg;
    return mix(left, right, fract(column));
}

fn graph(across: f32, height: f32, pixel_size: vec2f) -> vec3f {
    var shown = vec3f(0.02);
    if abs(height - 1.0) < pixel_size.y {
        shown = vec3f(1.0);
    }
    for (var number = 0u; number < suspects::COUNT; number++) {
        let here = measured_at(number, across);
        let next = measured_at(number, across + pixel_size.x);
        // As thick as three pixels, and thicker where the curve is steep.
        let thickness = 1.5 * pixel_size.y + abs(next.x - here.x);
        let is_gap = here.y > 0.01 && fract(across * 20.0) < 0.35;
        if abs(height - here.x) < thickness && !is_gap {
            shown = COLORS[number];
        }
    }
    return shown;
}

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let place = pixel.xy / scene::frame.resolution;
    if place.y < GRAPH_BEGINS {
        let radiance = textureLoad(light, vec2i(pixel.xy), 0).rgb;
        return vec4f(color::encode_srgb(color::tone_map(radiance, color::CURVE_LINEAR)), 1.0);
    }
    let rows = scene::frame.resolution.y * (1.0 - GRAPH_BEGINS);
    let height = 2.0 * (1.0 - place.y) / (1.0 - GRAPH_BEGINS);
    let pixel_size = vec2f(1.0 / scene::frame.resolution.x, 2.0 / rows);
    return vec4f(color::encode_srgb(graph(place.x, height, pixel_size)), 1.0);
}
