// One light on what the G-buffer holds.
#import lightbench::scene
#import lightbench::surface
#import lightbench::lighting

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var g_color: texture_2d<f32>;
@group(1) @binding(2) var g_normal: texture_2d<f32>;

@fragment
fn fragment_main(
    @builtin(position) pixel: vec4f,
    @location(0) @interpolate(flat) light: u32,
) -> @location(0) vec4f {
    let texel = vec2i(pixel.xy);
    let color = textureLoad(g_color, texel, 0);
    let normal = textureLoad(g_normal, texel, 0);
    let resolution = vec2f(textureDimensions(depth));
    let position = scene::position_from_depth(pixel.xy, resolution, textureLoad(depth, texel, 0));
    let found = surface::Surface(position, normal.xyz, color.rgb, vec3f(color.a), vec3f(0.0), 1.0, 0u, normal.ww, vec3f(0.0));
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - position);
    let radiance = lighting::evaluate_light(scene::lights[light], found, to_viewer);
    return vec4f(radiance, 0.0);
}
