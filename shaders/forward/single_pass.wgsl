// Forward shading, single pass: each fragment sums all lights that reach its object.
//
// In:  a fragment; the object's list of lights.
// Out: linear radiance, and opacity as alpha.
// The sum stays in registers and is rounded once, when it is written.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let fragment = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);
    let object = scene::drawn_objects[in.drawn];

#ifdef ADDED_LIGHT
    // An earlier pass has drawn what the surface emits.
    var radiance = vec3f(0.0);
#else
    var radiance = fragment.emissive;
#endif
    for (var i = 0u; i < object.light_count; i++) {
        let light = scene::lights[scene::object_lights[object.first_light + i]];
        radiance += lighting::evaluate_light(light, fragment, to_viewer);
    }
    return vec4f(radiance, fragment.opacity);
}
