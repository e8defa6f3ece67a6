// The vertex stage of every full-screen pass: one triangle that covers the target.
//
// In:  vertex indices 0, 1, 2.
// Out: clip positions (-1, -1), (3, -1), (-1, 3): a triangle has no diagonal to shade twice.

@vertex
fn vertex_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}
