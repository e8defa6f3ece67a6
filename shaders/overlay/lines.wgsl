// Overlay: edges of triangles and normals of vertices as lines over a picture.
//
// In:  the scene; the engine's mesh buffers; which row of the instances, as the instance that is drawn.
// Out: coloured lines, multiplied by their opacity, for a depth test against the same objects.
//
// EDGES draws three lines for each triangle, six ends; NORMALS one for each corner, two ends. Without
// either only depth is drawn, so that lines behind other things are hidden.
// Source:  depth is reversed, so that a share more of it is a share nearer.
#import lightbench::scene
#import lightbench::mesh

struct Style {
    color: vec4f,       // linear opacity in a; display-ready colour, not multiplied yet
    length: f32,        // of a normal, as a share of the distance along the view
    nearer: f32,        // what depth of lines is multiplied by, so that they lie before their surface
    padding_a: f32,
    padding_b: f32,
}

@group(1) @binding(3) var<uniform> style: Style;

fn corner_of(index: u32) -> u32 {
#ifdef EDGES
    let triangle = index / 6u;
    let side = (index % 6u) / 2u;
    return triangle * 3u + (side + index % 2u) % 3u;
#else
#ifdef NORMALS
    return index / 2u;
#else
    return index;
#endif
#endif
}

@vertex
fn vertex_main(
    @builtin(vertex_index) index: u32,
    @builtin(instance_index) row: u32,
) -> @builtin(position) @invariant vec4f {
    let instance = scene::instances[row];
    let vertex = mesh::vertex_at(instance, corner_of(index));
    let position = scene::world_position(instance, mesh::position_of(vertex));
    var clip = scene::clip_position(position);
#ifdef NORMALS
    if index % 2u == 1u {
        // Of the same length in the picture wherever it is.
        let normal = scene::world_normal(instance, mesh::fetch(vertex).normal);
        let length = max(length(normal), 1e-20);
        clip = scene::clip_position(position + normal * (style.length * clip.w / length));
    }
#endif
#ifdef LINES
    // The near plane cuts off no line that it does not cut already.
    clip.z = min(clip.z * style.nearer, max(clip.z, clip.w));
#endif
    return clip;
}

@fragment
fn fragment_main() -> @location(0) vec4f {
    return vec4f(style.color.rgb * style.color.a, style.color.a);
}
