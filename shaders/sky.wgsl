// Sky: what shows where nothing was drawn.
//
// In:  the scene's ambient lights.
// Out: their radiance. Ambient light comes with equal radiance from every direction, so that is
//      what the eye sees in the directions that no object hides.
// The pass draws at depth 0, the far plane, and the depth test keeps it behind every object.
#import lightbench::scene

@fragment
fn fragment_main() -> @location(0) vec4f {
    var radiance = vec3f(0.0);
    for (var i = 0u; i < scene::frame.light_count; i++) {
        if scene::lights[i].kind == scene::LIGHT_AMBIENT {
            radiance += scene::lights[i].intensity;
        }
    }
    return vec4f(radiance, 1.0);
}
