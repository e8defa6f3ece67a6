// Light-indexed deferred shading: each pixel of the G-buffer sums the lights whose numbers it
// holds.
//
// In:  what shaders/lib/g_buffer_texels.wgsl and shaders/lib/pixel_lights.wgsl read. EVERY_SAMPLE as in
//      shaders/deferred_shading/light.wgsl.
// Out: radiance to add to what the surface emits; 1 where lights were lost.
// Follows Trebilco 2007, "Light Indexed Deferred Rendering".
#import lightbench::g_buffer_texels
#import lightbench::pixel_lights

struct Shaded {
    @location(0) hdr: vec4f,
    @location(1) over_capacity: f32,
}

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
#ifdef EVERY_SAMPLE
    @builtin(sample_index) sample: u32,
#endif
) -> Shaded {
#ifndef EVERY_SAMPLE
    let sample = 0u;
#endif
    let texel = vec2u(pixel.xy);
    if g_buffer_texels::depth_at(texel, sample) == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return Shaded(vec4f(0.0), 0.0);
    }
    let fragment = g_buffer_texels::surface_at(texel, sample);
    let found = pixel_lights::sum(vec2i(texel), fragment);
    return Shaded(vec4f(found.radiance, 0.0), select(0.0, 1.0, found.lost));
}
