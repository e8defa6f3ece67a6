// Visibility buffer, first pass: which triangle of which object each pixel shows.
//
// In:  corners, three for each triangle; the vertex stage fetches their vertices.
// Out: object and triangle, as shaders/lib/visibility.wgsl packs them. With ALPHA_TEST fragments in
//      holes are discarded as everywhere else.
// Follows Burns and Hunt 2013, "The Visibility Buffer: A Cache-Friendly Approach to Deferred
// Shading".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::mesh
#import lightbench::visibility

#ifdef ALPHA_TEST
@vertex
fn vertex_main(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) drawn: u32,
) -> geometry::MarkedOutput {
    let instance = scene::instances[scene::drawn_objects[drawn].instance];
    let vertex = mesh::fetch(mesh::vertex_at(instance, corner));
    return geometry::with_mark(geometry::transform_vertex(vertex, drawn), corner / 3u);
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @location(5) @interpolate(flat) triangle: u32,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec2u {
    // Called for its discard.
    _ = surface::fragment_surface(in, front_facing);
    return visibility::encode(scene::drawn_objects[in.drawn].instance, triangle);
}
#else
struct Corner {
    @builtin(position) @invariant clip_position: vec4f,
    @location(0) @interpolate(flat) instance: u32,
    @location(1) @interpolate(flat) triangle: u32,
}

@vertex
fn vertex_main(
    @builtin(vertex_index) corner: u32,
    @builtin(instance_index) drawn: u32,
) -> Corner {
    let row = scene::drawn_objects[drawn].instance;
    let instance = scene::instances[row];
    let position = mesh::position_of(mesh::vertex_at(instance, corner));
    return Corner(
        scene::clip_position(scene::world_position(instance, position)),
        row,
        corner / 3u,
    );
}

@fragment
fn fragment_main(in: Corner) -> @location(0) vec2u {
    return visibility::encode(in.instance, in.triangle);
}
#endif
