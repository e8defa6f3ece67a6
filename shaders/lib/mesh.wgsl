// Meshes as shaders fetch them: vertices and triangles from the engine's buffers.
//
// In:  an instance, which knows where its mesh lies; the number of a corner: three for each
//      triangle.
// Out: the vertex at that corner, as a vertex buffer would hand it to the vertex stage.
// Called by passes that draw with .pull_vertices, and by passes that look up triangles themselves.
#define_import_path lightbench::mesh

#import lightbench::scene
#import lightbench::geometry

// All meshes one after the other: x, y, z of each vertex.
@group(1) @binding(0) var<storage, read> mesh_positions: array<f32>;
// Normal, texture coordinates and tangent of each vertex.
@group(1) @binding(1) var<storage, read> mesh_attributes: array<f32>;
// Three for each triangle, counted from the mesh's first vertex.
@group(1) @binding(2) var<storage, read> mesh_indices: array<u32>;

const POSITION_WORDS: u32 = 3u;
const ATTRIBUTE_WORDS: u32 = 9u;

// Which vertex of all meshes is at a corner.
fn vertex_at(instance: scene::Instance, corner: u32) -> u32 {
    return instance.base_vertex + mesh_indices[instance.first_index + corner];
}

fn position_of(vertex: u32) -> vec3f {
    let at = vertex * POSITION_WORDS;
    return vec3f(mesh_positions[at], mesh_positions[at + 1u], mesh_positions[at + 2u]);
}

fn fetch(vertex: u32) -> geometry::Vertex {
    let at = vertex * ATTRIBUTE_WORDS;
    return geometry::Vertex(
        position_of(vertex),
        vec3f(mesh_attributes[at], mesh_attributes[at + 1u], mesh_attributes[at + 2u]),
        vec2f(mesh_attributes[at + 3u], mesh_attributes[at + 4u]),
        vec4f(
            mesh_attributes[at + 5u],
            mesh_attributes[at + 6u],
            mesh_attributes[at + 7u],
            mesh_attributes[at + 8u],
        ),
    );
}
