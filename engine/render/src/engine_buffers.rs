//! The buffers of the engine that passes may bind beside the scene.

use crate::binding::EngineBuffer;
use crate::scene::MeshBuffers;

/// Buffers of the engine that passes may bind.
#[derive(Clone, Copy, Debug)]
pub struct EngineBuffers<'a> {
    /// Those of all meshes.
    pub meshes: MeshBuffers<'a>,
    /// The views of all `shadow` passes.
    pub shadow_views: &'a wgpu::Buffer,
    /// Of each light the first of its views.
    pub light_shadows: &'a wgpu::Buffer,
    /// Differs where one of the buffers is another than before.
    pub revision: u64,
}

impl EngineBuffers<'_> {
    /// One of them.
    pub fn get(&self, which: EngineBuffer) -> &wgpu::Buffer {
        match which {
            EngineBuffer::MeshPositions => self.meshes.positions,
            EngineBuffer::MeshAttributes => self.meshes.attributes,
            EngineBuffer::MeshGroups => self.meshes.groups,
            EngineBuffer::MeshIndices => self.meshes.indices,
            EngineBuffer::ShadowViews => self.shadow_views,
            EngineBuffer::LightShadows => self.light_shadows,
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
                "the scene has {} MiB of {}, and shaders of this pipeline read them from one \
                 buffer, of which this device binds {} MiB. Use fewer or smaller meshes, or a \
                 pipeline that does not fetch vertices",
                bytes >> 20,
                which.in_words(),
                most >> 20
            )
        })
    }
}
