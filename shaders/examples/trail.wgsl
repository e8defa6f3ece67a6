// A trail: a part of the last frame stays in this one.
//
// In:  linear radiance of this frame and of the last; `trail`, the share that stays.
// Out: their mixture; this frame alone where there was none before.
#import lightbench::scene

struct Parameters {
    trail: f32,
}

@group(1) @binding(0) var now: texture_2d<f32>;
@group(1) @binding(1) var last: texture_2d<f32>;
@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let share = select(parameters.trail, 0.0, scene::frame.history_frames == 0u);
    return mix(textureLoad(now, texel, 0), textureLoad(last, texel, 0), share);
}
