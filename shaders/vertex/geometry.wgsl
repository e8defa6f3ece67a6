// The vertex stage of every geometry pass whose shader brings none of its own.
//
// In:  mesh vertices and the instance that the draw call names.
// Out: `VertexOutput`, or, with POSITION_ONLY (no fragment stage: a depth pre-pass), the position.
#import lightbench::scene
#import lightbench::geometry

#ifdef POSITION_ONLY
@vertex
fn vertex_main(
    @location(0) position: vec3f,
    @builtin(instance_index) drawn: u32,
) -> @builtin(position) @invariant vec4f {
    let instance = scene::instances[scene::drawn_objects[drawn].instance];
    return scene::clip_position(scene::world_position(instance, position));
}
#else
@vertex
fn vertex_main(
    vertex: geometry::Vertex,
    @builtin(instance_index) drawn: u32,
) -> geometry::VertexOutput {
    return geometry::transform_vertex(vertex, drawn);
}
#endif
