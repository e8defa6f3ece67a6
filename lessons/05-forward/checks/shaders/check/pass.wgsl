// What a pass adds to a pixel, as a number.
//
// In:  a fragment; the list that the pass gives to its object. With BASE its surface emits 32 in blue.
// Out: the sum of what the lights of the list add; in alpha 1 for each run.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lamp

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let object = scene::drawn_objects[in.drawn];
#ifdef BASE
    var total = vec3f(0.0, 0.0, 32.0);
#else
    var total = vec3f(0.0);
#endif
    for (var i = 0u; i < object.light_count; i++) {
        let light = scene::lights[scene::object_lights[object.first_light + i]];
        total += lamp::radiance(light, point, vec3f(0.0));
    }
    return vec4f(total, 1.0);
}
