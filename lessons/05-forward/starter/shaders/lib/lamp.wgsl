// What one light adds to what a surface sends to the eye.
//
// In:  a light; a point of a surface; the direction to the eye, length 1.
// Out: linear radiance.
// Lambert and normalised Blinn-Phong, as in shaders/lib/lighting.wgsl, with the falloff of
// shaders/lib/own_falloff.wgsl.
#define_import_path lamp

#import lightbench::scene
#import lightbench::surface
#import lightbench::brdf
#import own_falloff

fn radiance(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> vec3f {
    if light.kind == scene::LIGHT_AMBIENT {
        return point.base_color * light.intensity;
    }
    let offset = light.position - point.position;
    let to_light = surface::safe_normalize(offset);
    let cosine = max(dot(point.normal, to_light), 0.0);
    let arriving = light.intensity * own_falloff::falloff(length(offset), light.range) * cosine;

    let half_vector = surface::safe_normalize(to_light + to_viewer);
    let n_dot_h = saturate(dot(point.normal, half_vector));
    let lobe = brdf::normalized_blinn_phong(n_dot_h, point.lobe.x);
    return arriving * (point.base_color / brdf::PI + point.specular * lobe);
}
