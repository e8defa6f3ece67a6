// Inferred lighting, first pass: what light needs to know of a surface, and which surface it is.
//
// In:  a fragment of the small buffers; without OBJECT_ID the smooth groups of meshes. With LAYERED
//      the object is transparent and has a layer.
// Out: normal, gloss and reflection model, packed as shaders/lib/g_buffer.wgsl does; what
//      shaders/lib/discontinuity.wgsl compares. Of a transparent object one texel in every 2 × 2.
// Follows Kircher and Lawrance 2009, "Inferred Lighting".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer
#import lightbench::discontinuity
#ifndef OBJECT_ID
#import lightbench::smooth_groups

@vertex
fn vertex_main(
    vertex: geometry::Vertex,
    @builtin(vertex_index) index: u32,
    @builtin(instance_index) drawn: u32,
) -> geometry::MarkedOutput {
    let out = geometry::transform_vertex(vertex, drawn);
    return geometry::with_mark(out, smooth_groups::group_of(index));
}
#endif

struct SmallGBuffer {
    @location(0) normal: vec2u,         // octahedral
    @location(1) gloss: vec2f,          // along the tangent and, for Ward, across it
    @location(2) model: u32,            // for Ward the tangent too
    @location(3) seen: vec2u,           // which surface
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
#ifndef OBJECT_ID
    @location(5) @interpolate(flat) group: u32,
#endif
    @builtin(front_facing) front_facing: bool,
) -> SmallGBuffer {
#ifdef OBJECT_ID
    let group = 0u;
#endif
    let fragment = surface::fragment_surface(in, front_facing);
    let packed = g_buffer::pack(fragment);
    let object = scene::drawn_objects[in.drawn];
#ifdef LAYERED
    if !discontinuity::is_of_layer(vec2u(in.clip_position.xy), object.layer) {
        discard;
    }
#endif
    let distance_ahead = scene::distance_ahead(in.world_position);
    return SmallGBuffer(
        packed.normal,
        g_buffer::pack_gloss(fragment.model, fragment.lobe),
        packed.model,
        discontinuity::pack(distance_ahead, object.instance, group),
    );
}
