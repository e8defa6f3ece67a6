// Sky: what shows where nothing was drawn.
//
// In:  the radiance of the scene's ambient lights, added up.
// Out: the same everywhere. Ambient light comes with equal radiance from every direction, so that is
//      what the eye sees in the directions that no object hides.
// The pass draws at depth 0, the far plane, and the depth test keeps it behind every object.
#import lightbench::scene

@fragment
fn fragment_main() -> @location(0) vec4f {
#ifdef COUNT_LIGHTS
    // No light is evaluated for it.
    return vec4f(0.0);
#else
    return vec4f(scene::frame.sky, 1.0);
#endif
}
