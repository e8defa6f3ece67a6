// One lamp on one pixel, as a number.
//
// In:  a fragment of a volume; depth.
// Out: the lamp's power of two where it reaches the surface; in blue 1, for each run.
#import lightbench::scene
#import lightbench::geometry
#import check_lamps

@group(1) @binding(0) var depth: texture_depth_2d;

@fragment
fn fragment_main(in: geometry::VertexOutput) -> @location(0) vec4f {
    let instance = scene::instances[scene::drawn_objects[in.drawn].instance];
    let number = u32(scene::materials[instance.material].emissive.r);
    let texel_depth = textureLoad(depth, vec2i(in.clip_position.xy), 0);
    if texel_depth == 0.0 {
        return vec4f(0.0, 0.0, 1.0, 0.0);
    }
    let position = scene::position_from_depth(
        in.clip_position.xy, scene::frame.resolution, texel_depth,
    );
    return vec4f(check_lamps::bit(number, position), 1.0, 0.0);
}
