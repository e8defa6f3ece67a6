// The light that one point of a surface sends to the eye: the sum over all lamps.
//
// In:  a fragment; all lights of the scene.
// Out: linear radiance.
// The formulas are those of shaders/lib/by_hand.wgsl.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import by_hand

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let to_eye = surface::safe_normalize(scene::frame.camera_position - point.position);

    var radiance = vec3f(0.0);
    for (var i = 0u; i < scene::frame.light_count; i++) {
        let light = scene::lights[i];
        if light.kind == scene::LIGHT_AMBIENT {
            // The same radiance from everywhere: a matt surface reflects its share.
            radiance += point.base_color * light.intensity;
            continue;
        }
        let to_light = light.position - point.position;
        let arriving = by_hand::irradiance(light.intensity, to_light, point.normal);
        let direction = surface::safe_normalize(to_light);
        radiance += by_hand::lambert(point.base_color, arriving);
        radiance += by_hand::blinn_phong(
            point.specular, point.lobe.x, point.normal, direction, to_eye, arriving,
        );
    }
    return vec4f(radiance, 1.0);
}
