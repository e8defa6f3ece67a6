// The light that a point of a ball sends to the eye, by the BRDF of that ball.
//
// In:  a fragment; all lights of the scene; the number of the BRDF, counted from 1, as the material's exponent.
// Out: linear radiance.
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import suspects

struct Parameters {
    exponent: f32,
}

@group(2) @binding(0) var<uniform> parameters: Parameters;

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let point = surface::fragment_surface(in, front_facing);
    let suspect = suspects::Suspect(u32(point.lobe.x + 0.5) - 1u, parameters.exponent);
    // The surface's own frame: its normal is z.
    let across = surface::surface_tangent(vec3f(0.0, 1.0, 0.0), point.normal);
    let to_frame = transpose(mat3x3f(across, cross(point.normal, across), point.normal));
    let to_eye = to_frame * surface::safe_normalize(scene::frame.camera_position - point.position);

    var radiance = point.base_color * scene::frame.sky;
    for (var i = 0u; i < scene::frame.light_count; i++) {
        let light = scene::lights[i];
        if light.kind != scene::LIGHT_DIRECTIONAL {
            continue;
        }
        let to_light = to_frame * -light.direction;
        if min(to_light.z, to_eye.z) > 0.001 {
            radiance += point.base_color * light.intensity * to_light.z * suspects::brdf(suspect, to_light, to_eye);
        }
    }
    return vec4f(radiance, 1.0);
}
