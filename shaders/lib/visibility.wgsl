// What a visibility buffer holds of a pixel: which triangle of which object it shows.
//
// In:  an object's row and the number of a triangle of its mesh; or a texel.
// Out: the other. Two whole numbers, of 32 bits each or with COMPACT of 16.
// A texel of zeros shows nothing. With COMPACT, that is also what objects beyond 65,535 and
// triangles beyond 65,536 leave.
// Follows Burns and Hunt 2013, "The Visibility Buffer: A Cache-Friendly Approach to Deferred
// Shading", JCGT 2(2).
#define_import_path lightbench::visibility

struct Visible {
    instance: u32,                      // index in scene::instances
    triangle: u32,                      // of its mesh
    is_nothing: bool,
}

fn encode(instance: u32, triangle: u32) -> vec2u {
#ifdef COMPACT
    let fits = instance < 0xffffu && triangle <= 0xffffu;
    return select(vec2u(0u), vec2u(instance + 1u, triangle), fits);
#else
    return vec2u(instance + 1u, triangle);
#endif
}

fn decode(texel: vec2u) -> Visible {
    return Visible(texel.x - 1u, texel.y, texel.x == 0u);
}
