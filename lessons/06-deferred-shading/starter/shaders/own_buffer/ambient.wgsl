// Light from everywhere, on each surface.
//
// In:  the G-buffer.
// Out: radiance to add.
#import lightbench::scene
#import own_layout

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let kept = own_layout::unpack(vec2i(pixel.xy));
    return vec4f(kept.base_color * scene::frame.sky, 0.0);
}
