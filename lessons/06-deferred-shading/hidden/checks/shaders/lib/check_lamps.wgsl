// Which lamps reach a point, as a sum of powers of two: lamps 0 to 7 in x, lamps 8 to 15 in y.
//
// In:  the number of a lamp; a point of a surface.
// Out: the lamp's power of two, and 0 where it does not reach.
#define_import_path check_lamps

#import lightbench::scene

fn bit(number: u32, position: vec3f) -> vec2f {
    let lamp = scene::lights[number];
    let reaches = distance(lamp.position, position) < lamp.range;
    let power = select(0.0, exp2(f32(number % 8u)), reaches);
    return select(vec2f(power, 0.0), vec2f(0.0, power), number >= 8u);
}
