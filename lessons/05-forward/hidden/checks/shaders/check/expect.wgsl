// What a pixel should get: of each light that reaches it once.
//
// In:  depth; all lights.
// Out: the sum of what the lights add as numbers; in alpha how many of them reach. 0 where nothing is drawn.
#import lightbench::scene
#import lightbench::surface
#import lamp

@group(1) @binding(0) var depth: texture_depth_2d;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel_depth = textureLoad(depth, vec2i(pixel.xy), 0);
    if texel_depth == 0.0 {
        return vec4f(0.0);
    }
    var point: surface::Surface;
    point.position = scene::position_from_depth(pixel.xy, scene::frame.resolution, texel_depth);
    var total = vec4f(0.0);
    for (var i = 0u; i < scene::frame.light_count; i++) {
        let added = lamp::radiance(scene::lights[i], point, vec3f(0.0));
        total += vec4f(added, select(0.0, 1.0, any(added > vec3f(0.0))));
    }
    return total;
}
