// What a light counts as in a heat map.
//
// In:  a light that a shader evaluates for a surface; COUNT_LIGHTS, which says what is counted.
// Out: 1 or 0. Heat maps make `lightbench::lighting` give that in place of light.
#define_import_path lightbench::light_counts

#import lightbench::scene
#import lightbench::surface

// The values of COUNT_LIGHTS; engine/render/src/heat_map.rs sets it.
const EVALUATED: i32 = 0;   // every light
const REACHING: i32 = 1;    // only where the surface lies in its range and cone
const IN_VAIN: i32 = 2;     // only where it does not

fn reaches(light: scene::Light, position: vec3f) -> bool {
    if light.kind == scene::LIGHT_AMBIENT || light.kind == scene::LIGHT_DIRECTIONAL {
        return true;
    }
    let offset = light.position - position;
    let is_in_range = dot(offset, offset) < light.range * light.range;
    if light.kind == scene::LIGHT_POINT {
        return is_in_range;
    }
    let to_light = surface::safe_normalize(offset);
    let cosine = dot(light.direction, -to_light);
    return is_in_range && cosine * light.angle_scale + light.angle_offset > 0.0;
}

fn count(light: scene::Light, position: vec3f) -> f32 {
    let what: i32 = #{COUNT_LIGHTS};
    if what == EVALUATED {
        return 1.0;
    }
    return select(0.0, 1.0, reaches(light, position) == (what == REACHING));
}
