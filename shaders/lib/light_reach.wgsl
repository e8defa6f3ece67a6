// Whether a light reaches what a pixel shows.
//
// In:  a pixel of the light's volume; depth, or with ANY_DEPTH none.
// Out: yes or no. With depth it is asked of the surface there; with ANY_DEPTH of the whole line of
//      sight, for transparent surfaces and for pixels whose samples differ in depth.
#define_import_path lightbench::light_reach

#import lightbench::scene
#import lightbench::culling

#ifdef ANY_DEPTH
fn is_reached(pixel: vec2f, light: scene::Light) -> bool {
    // The distance of the light from the line of sight, in view space.
    let sight = normalize(scene::view_direction(pixel, scene::frame.resolution));
    let center = (scene::frame.view * vec4f(light.position, 1.0)).xyz;
    return length(cross(sight, center)) < light.range;
}
#else
@group(1) @binding(1) var depth: texture_depth_2d;

fn is_reached(pixel: vec2f, light: scene::Light) -> bool {
    let texel_depth = textureLoad(depth, vec2i(pixel), 0);
    if texel_depth == 0.0 {
        // The far plane: nothing was drawn here.
        return false;
    }
    let resolution = vec2f(textureDimensions(depth));
    return culling::reaches(light, scene::position_from_depth(pixel, resolution, texel_depth));
}
#endif
