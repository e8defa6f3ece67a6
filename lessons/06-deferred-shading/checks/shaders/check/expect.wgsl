// What a pixel should be lit by.
//
// In:  depth; all lamps.
// Out: the sum of the powers of two of the lamps that reach the surface; how many spheres a little larger
//      than the volumes hold the surface; how many of these the line of sight meets.
#import lightbench::scene
#import check_lamps

@group(1) @binding(0) var depth: texture_depth_2d;

// Volumes are larger than the range, by 2 %.
const LARGER = 1.021;

@fragment
fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let texel_depth = textureLoad(depth, vec2i(pixel.xy), 0);
    let position = scene::position_from_depth(pixel.xy, scene::frame.resolution, texel_depth);
    let eye = scene::frame.camera_position;
    let sight = normalize(position - eye);
    var lamps = vec2f(0.0);
    var around = 0.0;
    var met = 0.0;
    for (var i = 0u; i < scene::frame.light_count; i++) {
        let lamp = scene::lights[i];
        if lamp.kind != scene::LIGHT_POINT {
            continue;
        }
        if texel_depth > 0.0 {
            lamps += check_lamps::bit(i, position);
            around += select(0.0, 1.0, distance(lamp.position, position) < LARGER * lamp.range);
        }
        let across = cross(lamp.position - eye, sight);
        met += select(0.0, 1.0, length(across) < LARGER * lamp.range);
    }
    return vec4f(lamps, around, met);
}
