// The second pass: one lamp adds what arrives from it, before materials' colours.
//
// In:  the light; depth and the thin G-buffer.
// Out: what `gather` makes of it, to be added.
#import lightbench::scene
#import lightbench::surface
#import lightbench::brdf
#import lightbench::lighting
#import lightbench::normals
#import own_buffer

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var g_normal: texture_2d<u32>;
@group(1) @binding(2) var g_gloss: texture_2d<f32>;

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) number: u32,
) -> own_buffer::Gathered {
    let texel = vec2i(pixel.xy);
    let texel_depth = textureLoad(depth, texel, 0);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here, so there is nothing to light.
        return own_buffer::Gathered(vec4f(0.0), vec4f(0.0));
    }
    let light = scene::lights[number];
    if light.kind == scene::LIGHT_AMBIENT {
        // The same radiance L from everywhere lays E = π L on a surface.
        return own_buffer::gather(brdf::PI * light.intensity, 1.0, 0.0);
    }

    let normal = normals::decode_octahedral(textureLoad(g_normal, texel, 0).xy);
    let power = exp2(10.5 * textureLoad(g_gloss, texel, 0).r);
    let position = scene::position_from_depth(pixel.xy, scene::frame.resolution, texel_depth);
    let offset = light.position - position;
    let to_light = surface::safe_normalize(offset);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - position);

    let facing = light.intensity * lighting::distance_falloff(dot(offset, offset), light.range);
    let half_vector = surface::safe_normalize(to_light + to_viewer);
    let n_dot_h = saturate(dot(normal, half_vector));
    let lobe = brdf::normalized_blinn_phong(n_dot_h, power);
    return own_buffer::gather(facing, dot(normal, to_light), lobe);
}
