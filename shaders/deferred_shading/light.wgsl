// Deferred shading, second pass: one light adds its share to each pixel of its volume.
//
// In:  the light; what shaders/lib/g_buffer_texels.wgsl reads. With EVERY_SAMPLE each sample is lit
//      on its own; without, and with several samples, all of a pixel as the first.
// Out: radiance to add.
// Follows Deering et al. 1988, "The Triangle Processor and Normal Vector Shader", section 4.
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting
#import lightbench::g_buffer_texels

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
#ifdef EVERY_SAMPLE
    @builtin(sample_index) sample: u32,
#endif
    @location(0) @interpolate(flat) light: u32,
) -> @location(0) vec4f {
#ifndef EVERY_SAMPLE
    let sample = 0u;
#endif
    let texel = vec2u(pixel.xy);
    if g_buffer_texels::depth_at(texel, sample) == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return vec4f(0.0);
    }
    let fragment = g_buffer_texels::surface_at(texel, sample);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);
    let radiance = lighting::evaluate_light(scene::lights[light], fragment, to_viewer);
    return vec4f(radiance, 0.0);
}
