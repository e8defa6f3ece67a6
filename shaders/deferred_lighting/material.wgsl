// Deferred lighting, third pass: materials meet the light that was gathered for their pixels.
//
// In:  a fragment; the light buffer. With MONOCHROME highlights take their colour from the diffuse
//      light, which is exact where all lights of a pixel have one hue.
// Out: linear radiance.
// Follows Engel 2008, "Designing a Renderer for Multiple Lights: The Light Pre-Pass Renderer".
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer

@group(1) @binding(0) var light_diffuse: texture_2d<f32>;
#ifndef MONOCHROME
@group(1) @binding(1) var light_highlight: texture_2d<f32>;
#endif

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let fragment = surface::fragment_surface(in, front_facing);
    let texel = vec2i(in.clip_position.xy);
    let diffuse = textureLoad(light_diffuse, texel, 0);
#ifdef MONOCHROME
    let highlight = diffuse.rgb * (diffuse.a / max(g_buffer::luminance(diffuse.rgb), 1e-6));
#else
    let highlight = textureLoad(light_highlight, texel, 0).rgb;
#endif
    let radiance = fragment.emissive
        + fragment.base_color * diffuse.rgb
        + fragment.specular * highlight;
    return vec4f(radiance, 1.0);
}
