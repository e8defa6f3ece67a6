// What light needs to know of a surface, in the small buffers, and which surface it is.
//
// In:  a fragment. With LAYERED the object is transparent and has a layer.
// Out: normal, gloss and reflection model, packed as shaders/lib/g_buffer.wgsl does; the key of the surface. Of a
//      transparent object only the texels of its layer.
// Follows Kircher and Lawrance 2009, "Inferred Lighting".
#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::g_buffer
#import inference

struct SmallGBuffer {
    @location(0) normal: vec2u,
    @location(1) gloss: vec2f,
    @location(2) model: u32,
    @location(3) key: u32,
}

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> SmallGBuffer {
    let point = surface::fragment_surface(in, front_facing);
    let object = scene::drawn_objects[in.drawn];
#ifdef LAYERED
    if !inference::is_of_layer(vec2u(in.clip_position.xy), object.layer) {
        discard;
    }
#endif
    let packed = g_buffer::pack(point);
    return SmallGBuffer(
        packed.normal,
        g_buffer::pack_gloss(point.model, point.lobe),
        packed.model,
        inference::pack_surface(scene::distance_ahead(in.world_position), object.instance),
    );
}
