//! Which assets count beside those that something uses, and which count no more.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering};

use lightbench_assets::{AssetCounts, MaterialId, MeshId, TextureId};

use super::data::Data;

/// A mesh, a material or a texture of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AssetId {
    /// A mesh.
    Mesh(MeshId),
    /// A material.
    Material(MaterialId),
    /// A texture.
    Texture(TextureId),
}

/// Marks of assets. Tables never lose an item from their middle, so that ids stay valid.
#[derive(Clone, Debug, Default)]
pub(super) struct Shelf {
    /// Those that are written to files though nothing uses them.
    kept: BTreeSet<AssetId>,
    /// Those that a person has removed.
    gone: BTreeSet<AssetId>,
    /// Tells marks from others.
    revision: u64,
}

/// One sequence for the whole program: no two shelves give one revision to different marks.
fn next_revision() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}

/// The marks of one asset.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Marks {
    pub(super) kept: bool,
    pub(super) gone: bool,
}

impl Shelf {
    pub(super) fn marks(&self, id: AssetId) -> Marks {
        Marks {
            kept: self.kept.contains(&id),
            gone: self.gone.contains(&id),
        }
    }

    pub(super) fn mark(&mut self, id: AssetId, marks: Marks) {
        for (set, on) in [(&mut self.kept, marks.kept), (&mut self.gone, marks.gone)] {
            match on {
                true => set.insert(id),
                false => set.remove(&id),
            };
        }
        self.revision = next_revision();
    }

    /// A number that changes with every change to any mark.
    pub(super) fn revision(&self) -> u64 {
        self.revision
    }

    /// Those that a person has removed.
    pub(super) fn gone(&self) -> &BTreeSet<AssetId> {
        &self.gone
    }

    /// Those that are written though nothing uses them.
    pub(super) fn kept(&self) -> impl Iterator<Item = AssetId> + '_ {
        self.kept.iter().copied()
    }
}

/// How much a scene's tables of assets hold.
#[derive(Default, Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stock {
    counts: AssetCounts,
    triangles: usize,
}

impl Stock {
    fn has(&self, id: AssetId) -> bool {
        let (number, count) = match id {
            AssetId::Mesh(id) => (id.0, self.counts.meshes),
            AssetId::Material(id) => (id.0, self.counts.materials),
            AssetId::Texture(id) => (id.0, self.counts.textures),
        };
        (number as usize) < count
    }

    /// All that `self` has and `before` had not.
    fn since(&self, before: &Self) -> impl Iterator<Item = AssetId> {
        let (old, new) = (before.counts, self.counts);
        let range = |from: usize, to: usize| from as u32..to as u32;
        let meshes = range(old.meshes, new.meshes).map(|id| AssetId::Mesh(MeshId(id)));
        let materials = range(old.materials, new.materials);
        let textures = range(old.textures, new.textures);
        meshes
            .chain(materials.map(|id| AssetId::Material(MaterialId(id))))
            .chain(textures.map(|id| AssetId::Texture(TextureId(id))))
    }
}

impl Data {
    pub(super) fn stock(&self) -> Stock {
        Stock {
            counts: self.assets.counts(),
            triangles: self.triangles,
        }
    }

    /// Forgets what was added between two moments. Where more has come since, it stays in the tables
    /// and counts no more.
    pub(super) fn forget_added(&mut self, before: &Stock, after: &Stock) {
        if self.stock().counts != after.counts {
            for id in after.since(before) {
                let marks = Marks {
                    kept: false,
                    gone: true,
                };
                self.shelf.mark(id, marks);
            }
            return;
        }
        self.assets.truncate(before.counts);
        self.triangles = before.triangles;
        let has = |id| before.has(id);
        let recipes = &mut self.recipes;
        recipes.meshes.retain(|id, _| has(AssetId::Mesh(*id)));
        recipes.textures.retain(|id, _| has(AssetId::Texture(*id)));
        recipes.normals.retain(|id| has(AssetId::Texture(*id)));
        self.materials.retain(|id, _| has(AssetId::Material(*id)));
        self.shelf.kept.retain(|id| has(*id));
        self.shelf.gone.retain(|id| has(*id));
        self.shelf.revision = next_revision();
    }
}
