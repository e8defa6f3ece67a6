//! The meshes of a model, shared between loads as long as they stay the same.

use lightbench_world::MaterialId;

use crate::cache::{Kept, Key, Reuse};
use crate::{Mesh, Shared};

/// Meshes with the model's own numbers of their materials.
#[derive(Clone, Debug, Default)]
pub(crate) struct ModelMeshes {
    pub(crate) list: Vec<(Shared<Mesh>, MaterialId)>,
    keys: Vec<Key>,
}

impl ModelMeshes {
    /// Shares new meshes. One that is bit for bit a mesh of before is that mesh: a file of which a
    /// part changed is read as a whole, and the other parts keep their revisions.
    pub(crate) fn share(reuse: &Reuse, meshes: Vec<(Mesh, MaterialId)>) -> Self {
        let mut shared = Self::default();
        for (mesh, material) in meshes {
            let key = Key::new("mesh", &mesh.digest());
            let known = reuse.find(&key);
            let mesh = known.unwrap_or_else(|| reuse.keep(key, Shared::shared(mesh)));
            shared.list.push((mesh, material));
            shared.keys.push(key);
        }
        shared
    }

    /// Notes that a load uses them, so that each can be found when it is built again.
    pub(crate) fn touch(&self, reuse: &Reuse) {
        for key in &self.keys {
            let _: Option<Shared<Mesh>> = reuse.find(key);
        }
    }

    /// The bytes that they hold.
    pub(crate) fn byte_count(&self) -> usize {
        self.list.iter().map(|(mesh, _)| mesh.bytes()).sum()
    }
}
