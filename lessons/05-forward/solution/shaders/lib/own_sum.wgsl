// The light that a point of a surface sends to the eye.
#define_import_path own_sum

#import lightbench::scene
#import lightbench::surface
#import lamp

fn reaches(light: scene::Light, point: vec3f) -> bool {
    return light.kind != scene::LIGHT_POINT || distance(light.position, point) < light.range;
}

// TASK sum: what is emitted, unless it was drawn before, and each light of the list that reaches the point.
fn sum(point: surface::Surface, to_viewer: vec3f, first: u32, count: u32, again: bool) -> vec4f {
    var total = vec4f(select(point.emissive, vec3f(0.0), again), 0.0);
    for (var i = first; i < first + count; i++) {
        let light = scene::lights[scene::object_lights[i]];
        if reaches(light, point.position) {
            total += vec4f(lamp::radiance(light, point, to_viewer), 1.0);
        }
    }
    return total;
}
