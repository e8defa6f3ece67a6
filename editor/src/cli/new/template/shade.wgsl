// TITLE: the light that one point of a surface sends to the viewer.
//
// In:  a fragment; the list of lights that reach its object; `rim`, which the pipeline declares.
// Out: linear radiance.
// `lightbench docs shaders` tells what each imported module gives.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting

// Each member is a parameter of the pipeline, by its name.
struct Parameters {
    rim: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - point.position);

    // The sum of all lights, which every pipeline computes with the same function.
    let object = scene::drawn_objects[in.drawn];
    var radiance = point.emissive;
    for (var i = 0u; i < object.light_count; i++) {
        let light = scene::lights[scene::object_lights[object.first_light + i]];
        radiance += lighting::evaluate_light(light, point, to_viewer);
    }

    // Something of your own. An edge is where the surface turns away from the viewer.
    let edge = 1.0 - saturate(dot(point.normal, to_viewer));
    radiance += parameters.rim * point.base_color * edge * edge * edge * edge;

    return vec4f(radiance, 1.0);
}
