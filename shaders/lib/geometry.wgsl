// What the vertex stage of a geometry pass hands to the fragment stage.
//
// In:  mesh vertices, in two streams: positions alone, then everything else.
// Out: `Vertex`, `VertexOutput` and `transform_vertex`; and the same with a mark that the whole
//      triangle has, for `#import lightbench::geometry`.
#define_import_path lightbench::geometry

#import lightbench::scene

struct Vertex {
    @location(0) position: vec3f,       // first stream
    @location(1) normal: vec3f,         // second stream, as the rest
    @location(2) uv: vec2f,
    @location(3) tangent: vec4f,        // w is the handedness of the bitangent
}

struct VertexOutput {
    @builtin(position) @invariant clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,         // world, not unit length
    @location(2) tangent: vec4f,        // world, not unit length
    @location(3) uv: vec2f,
    @location(4) @interpolate(flat) drawn: u32, // index in scene::drawn_objects
}

// What the shipped vertex stage does: a vertex of the drawn object, in the world and on the screen.
fn transform_vertex(vertex: Vertex, drawn: u32) -> VertexOutput {
    let instance = scene::instances[scene::drawn_objects[drawn].instance];
    var out: VertexOutput;
    out.world_position = scene::world_position(instance, vertex.position);
    out.clip_position = scene::clip_position(out.world_position);
    out.normal = scene::world_normal(instance, vertex.normal);
    out.tangent = vec4f(scene::world_tangent(instance, vertex.tangent.xyz), vertex.tangent.w);
    out.uv = vertex.uv;
    out.drawn = drawn;
    return out;
}

// A vertex with a number that is the same for its whole triangle: the fragment stage takes a
// `VertexOutput`, and `@location(5) @interpolate(flat) mark: u32` beside it.
struct MarkedOutput {
    @builtin(position) @invariant clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec2f,
    @location(4) @interpolate(flat) drawn: u32,
    @location(5) @interpolate(flat) mark: u32,
}

fn with_mark(out: VertexOutput, mark: u32) -> MarkedOutput {
    return MarkedOutput(
        out.clip_position, out.world_position, out.normal, out.tangent, out.uv, out.drawn, mark,
    );
}
