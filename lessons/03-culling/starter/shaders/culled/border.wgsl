// A thin line around the part of the picture that counts as the view.
#import lightbench::scene

struct Parameters {
    window: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let from_middle = abs(pixel.xy - 0.5 * scene::frame.resolution);
    let beyond = from_middle - 0.5 * parameters.window * scene::frame.resolution;
    let is_line = max(beyond.x, beyond.y) > 0.0 && max(beyond.x, beyond.y) <= 1.0;
    return vec4f(1.0, 1.0, 1.0, select(0.0, 1.0, is_line && parameters.window < 1.0));
}
