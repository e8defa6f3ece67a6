//! The buffers of the engine that passes may bind beside the scene.

use crate::binding::EngineBuffer;

/// Buffers of the engine that passes may bind.
#[derive(Clone, Copy, Debug)]
pub struct EngineBuffers<'a> {
    /// Vertex positions of all meshes.
    pub mesh_positions: &'a wgpu::Buffer,
    /// The rest of the vertices.
    pub mesh_attributes: &'a wgpu::Buffer,
    /// The smooth group of each vertex.
    pub mesh_groups: &'a wgpu::Buffer,
    /// Indices of all meshes.
    pub mesh_indices: &'a wgpu::Buffer,
    /// Differs where one of the buffers is another than before.
    pub revision: u64,
}

impl EngineBuffers<'_> {
    /// One of them.
    pub fn get(&self, which: EngineBuffer) -> &wgpu::Buffer {
        match which {
            EngineBuffer::MeshPositions => self.mesh_positions,
            EngineBuffer::MeshAttributes => self.mesh_attributes,
            EngineBuffer::MeshGroups => self.mesh_groups,
            EngineBuffer::MeshIndices => self.mesh_indices,
        }
    }

    /// Says what of the scene is too large for shaders that bind `wanted`, if anything is. `most` is
    /// what the device binds at once, bytes.
    pub fn too_large(
        &self,
        wanted: impl Iterator<Item = EngineBuffer>,
        most: u64,
    ) -> Option<String> {
        let buffers = wanted.map(|which| (which, self.get(which).size()));
        let (which, bytes) = buffers.max_by_key(|(_, bytes)| *bytes)?;
        (bytes > most).then(|| {
            format!(
                "the scene's meshes have {} MiB of {}, and shaders of this pipeline fetch them from \
                 one buffer, of which this device binds {} MiB. Use fewer or smaller meshes, or a \
                 pipeline that does not fetch vertices",
                bytes >> 20,
                which.in_words(),
                most >> 20
            )
        })
    }
}
