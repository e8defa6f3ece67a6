// Smooth groups: which part of a mesh, between its hard edges, a vertex belongs to.
//
// In:  the number of a vertex among those of all meshes: @builtin(vertex_index) of an indexed draw.
// Out: its group, 0 to 255, the same for all corners of a triangle. Meshes of more groups use
//      numbers twice.
// The engine finds groups once for each mesh and keeps a byte for each vertex.
#define_import_path lightbench::smooth_groups

// Four vertices a word, the first in the lowest bits.
@group(1) @binding(0) var<storage, read> mesh_groups: array<u32>;

fn group_of(vertex: u32) -> u32 {
    return (mesh_groups[vertex / 4u] >> (8u * (vertex % 4u))) & 0xffu;
}
