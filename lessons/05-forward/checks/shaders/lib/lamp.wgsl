// What one light adds, as a number in place of radiance: lamps 0 to 7 add their power of two to red, lamps 8
// to 15 to green, and light from everywhere adds 1 to blue.
//
// In:  a light; a point of a surface.
// Out: the number, and 0 where the light does not reach.
#define_import_path lamp

#import lightbench::scene
#import lightbench::surface

fn radiance(light: scene::Light, point: surface::Surface, to_viewer: vec3f) -> vec3f {
    if light.kind == scene::LIGHT_AMBIENT {
        return vec3f(0.0, 0.0, 1.0);
    }
    if distance(light.position, point.position) >= light.range {
        return vec3f(0.0);
    }
    // Lights have no number of their own: it is where they are among all.
    var number = 0u;
    while number < scene::frame.light_count && any(scene::lights[number].position != light.position) {
        number++;
    }
    let power = exp2(f32(number % 8u));
    return select(vec3f(power, 0.0, 0.0), vec3f(0.0, power, 0.0), number >= 8u);
}
