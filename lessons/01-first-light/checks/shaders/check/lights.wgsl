// Row n tells of light n: its place and kind, its intensity, how many there are.
#import lightbench::scene

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let index = u32(pixel.y);
    if index >= scene::frame.light_count {
        return vec4f(0.0, 0.0, 0.0, -1.0);
    }
    let light = scene::lights[index];
    switch u32(pixel.x) {
        case 0u: { return vec4f(light.position, f32(light.kind)); }
        case 1u: { return vec4f(light.intensity, light.range); }
        default: { return vec4f(f32(scene::frame.light_count)); }
    }
}
