// The vertex stage of a `lights` pass: where each light can reach.
//
// In:  vertices of a unit sphere or cone and the volume that the draw call names, or, with
//      FULL_SCREEN, vertex indices 0, 1, 2.
// Out: the light's index, constant over the volume.
#import lightbench::scene

struct VolumeOutput {
    @builtin(position) clip_position: vec4f,
    @location(0) @interpolate(flat) light: u32,
}

#ifdef FULL_SCREEN
@vertex
fn vertex_main(
    @builtin(vertex_index) index: u32,
    @builtin(instance_index) draw: u32,
) -> VolumeOutput {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return VolumeOutput(vec4f(corner * 2.0 - 1.0, 0.0, 1.0), scene::light_volumes[draw].light);
}
#else
@vertex
fn vertex_main(@location(0) position: vec3f, @builtin(instance_index) draw: u32) -> VolumeOutput {
    let volume = scene::light_volumes[draw];
    let p = vec4f(position, 1.0);
    let world = vec3f(dot(volume.row_x, p), dot(volume.row_y, p), dot(volume.row_z, p));
    return VolumeOutput(scene::clip_position(world), volume.light);
}
#endif
