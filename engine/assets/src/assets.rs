//! The table of everything that a scene draws.

use std::collections::HashMap;
use std::ops::Deref;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use lightbench_world::{MaterialId, MeshBounds, MeshId};
use thiserror::Error;

use crate::{Material, Mesh, ReflectionModels, Texture, TextureId};

/// An item and the revision at which it got its present value.
#[derive(Clone, Debug)]
pub struct Entry<T> {
    /// The item.
    pub value: T,
    /// Never given twice in a run of the program, not even in another
    /// [`Assets`]: equal revisions mean equal values.
    pub revision: u64,
}

/// A value that several [`Assets`] may hold, with one revision in all of them:
/// what was uploaded for one of them serves the others.
pub type Shared<T> = Entry<Arc<T>>;

impl<T> Entry<Arc<T>> {
    /// A value that nobody holds yet.
    #[must_use]
    pub fn shared(value: T) -> Self {
        Self {
            value: Arc::new(value),
            revision: next_revision(),
        }
    }
}

impl<T> Deref for Entry<Arc<T>> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

/// An id that belongs to no item.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("there is no {kind} {index}; the scene has {count}")]
pub struct UnknownAsset {
    kind: &'static str,
    index: u32,
    count: usize,
}

/// Items in the order in which they were added, with their names.
#[derive(Clone, Debug)]
struct Table<T> {
    kind: &'static str,
    entries: Vec<Entry<T>>,
    names: Vec<String>,
    by_name: HashMap<String, u32>,
}

impl<T> Table<T> {
    fn new(kind: &'static str) -> Self {
        Self {
            kind,
            entries: Vec::new(),
            names: Vec::new(),
            by_name: HashMap::new(),
        }
    }

    fn add(&mut self, name: &str, entry: Entry<T>) -> u32 {
        let index = self.entries.len() as u32;
        self.entries.push(entry);
        self.names.push(name.to_owned());
        self.by_name.insert(name.to_owned(), index);
        index
    }

    fn replace(&mut self, index: u32, name: &str, value: T) -> Result<u64, UnknownAsset> {
        let count = self.entries.len();
        let entry = self.entries.get_mut(index as usize).ok_or(UnknownAsset {
            kind: self.kind,
            index,
            count,
        })?;
        let revision = next_revision();
        *entry = Entry { value, revision };
        if self.names[index as usize] != name {
            let old = std::mem::replace(&mut self.names[index as usize], name.to_owned());
            for name in [old.as_str(), name] {
                match self.names.iter().rposition(|other| other == name) {
                    Some(latest) => self.by_name.insert(name.to_owned(), latest as u32),
                    None => self.by_name.remove(name),
                };
            }
        }
        Ok(revision)
    }

    /// Drops the items from a place on.
    fn truncate(&mut self, count: usize) {
        self.entries.truncate(count);
        let dropped = self.names.split_off(count.min(self.names.len()));
        for name in dropped {
            match self.names.iter().rposition(|other| *other == name) {
                Some(latest) => self.by_name.insert(name, latest as u32),
                None => self.by_name.remove(&name),
            };
        }
    }

    fn get(&self, index: u32) -> Option<&T> {
        self.entries.get(index as usize).map(|entry| &entry.value)
    }
}

/// How many items [`Assets`] have of each kind.
#[derive(Default, Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssetCounts {
    /// Meshes.
    pub meshes: usize,
    /// Materials.
    pub materials: usize,
    /// Textures.
    pub textures: usize,
}

/// All meshes, materials and textures of a scene.
///
/// Items are not removed while others come behind them, so that ids stay valid;
/// they may be replaced, as when a file changes on the disk. Meshes and textures are shared, so that a
/// clone costs only the tables. Several items may have one name: it finds the
/// latest.
///
/// [`MaterialId`]`(0)` is always the default material and
/// [`TextureId::PLACEHOLDER`] the checker for missing pictures.
#[derive(Clone, Debug)]
pub struct Assets {
    meshes: Table<Arc<Mesh>>,
    bounds: Vec<MeshBounds>,
    materials: Table<Material>,
    textures: Table<Arc<Texture>>,
    revision: u64,
    /// The revision of the last change but for new values of materials.
    roster: u64,
}

/// One sequence for the whole program: two scenes never give the same revision
/// to different values, even when one began as a clone of the other.
fn next_revision() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed) + 1
}

/// The same for everybody.
fn placeholder() -> Shared<Texture> {
    static PLACEHOLDER: OnceLock<Shared<Texture>> = OnceLock::new();
    let made = PLACEHOLDER.get_or_init(|| Shared::shared(Texture::placeholder()));
    made.clone()
}

impl Default for Assets {
    fn default() -> Self {
        Self::new()
    }
}

impl Assets {
    /// The default material and the placeholder texture, nothing else.
    #[must_use]
    pub fn new() -> Self {
        let mut assets = Self {
            meshes: Table::new("mesh"),
            bounds: Vec::new(),
            materials: Table::new("material"),
            textures: Table::new("texture"),
            revision: 0,
            roster: 0,
        };
        assets.add_material(Material::default());
        assets.add_shared_texture(placeholder());
        assets
    }

    /// A number that changes with every change to any item, and is never that of
    /// other [`Assets`].
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Like [`Assets::revision`], but the same where materials only took other values: what there is,
    /// and what it is called, has not changed then.
    #[must_use]
    pub fn roster_revision(&self) -> u64 {
        self.roster
    }

    /// There is something new, or under a new name.
    fn enlist(&mut self, revision: u64) {
        self.revision = revision;
        self.roster = revision;
    }

    /// Adds a mesh.
    pub fn add_mesh(&mut self, mesh: Mesh) -> MeshId {
        self.add_shared_mesh(Shared::shared(mesh))
    }

    /// Adds a mesh that others hold too.
    pub fn add_shared_mesh(&mut self, mesh: Shared<Mesh>) -> MeshId {
        self.enlist(next_revision());
        self.bounds.push(mesh.bounds());
        let name = mesh.name.clone();
        MeshId(self.meshes.add(&name, mesh))
    }

    /// Adds a material.
    pub fn add_material(&mut self, material: Material) -> MaterialId {
        self.enlist(next_revision());
        let name = material.name.clone();
        let entry = Entry {
            value: material,
            revision: self.revision,
        };
        MaterialId(self.materials.add(&name, entry))
    }

    /// Adds a texture.
    pub fn add_texture(&mut self, texture: Texture) -> TextureId {
        self.add_shared_texture(Shared::shared(texture))
    }

    /// Adds a texture that others hold too.
    pub fn add_shared_texture(&mut self, texture: Shared<Texture>) -> TextureId {
        self.enlist(next_revision());
        let name = texture.name.clone();
        TextureId(self.textures.add(&name, texture))
    }

    /// Puts another mesh, and its name, in the place of one.
    ///
    /// # Errors
    /// An id that belongs to no mesh.
    pub fn replace_mesh(&mut self, id: MeshId, mesh: Mesh) -> Result<(), UnknownAsset> {
        let bounds = mesh.bounds();
        let name = mesh.name.clone();
        let revision = self.meshes.replace(id.0, &name, Arc::new(mesh))?;
        self.enlist(revision);
        self.bounds[id.0 as usize] = bounds;
        Ok(())
    }

    /// Puts another material, and its name, in the place of one.
    ///
    /// # Errors
    /// An id that belongs to no material.
    pub fn replace_material(
        &mut self,
        id: MaterialId,
        material: Material,
    ) -> Result<(), UnknownAsset> {
        let name = material.name.clone();
        let before = self.material(id).map(|before| before.name == name);
        self.revision = self.materials.replace(id.0, &name, material)?;
        if before == Some(false) {
            self.roster = self.revision;
        }
        Ok(())
    }

    /// Puts another texture, and its name, in the place of one.
    ///
    /// # Errors
    /// An id that belongs to no texture.
    pub fn replace_texture(&mut self, id: TextureId, texture: Texture) -> Result<(), UnknownAsset> {
        let name = texture.name.clone();
        let revision = self.textures.replace(id.0, &name, Arc::new(texture))?;
        self.enlist(revision);
        Ok(())
    }

    /// How many items there are.
    #[must_use]
    pub fn counts(&self) -> AssetCounts {
        AssetCounts {
            meshes: self.meshes.entries.len(),
            materials: self.materials.entries.len(),
            textures: self.textures.entries.len(),
        }
    }

    /// Drops what was added since there were so many items, as when its making is taken back. The
    /// default material and the placeholder stay. Ids of what is dropped belong to nothing, until
    /// something else is added.
    pub fn truncate(&mut self, counts: AssetCounts) {
        if self.counts() == counts {
            return;
        }
        self.enlist(next_revision());
        self.meshes.truncate(counts.meshes);
        self.bounds.truncate(counts.meshes);
        self.materials.truncate(counts.materials.max(1));
        self.textures.truncate(counts.textures.max(1));
    }

    /// The mesh of an id.
    #[must_use]
    pub fn mesh(&self, id: MeshId) -> Option<&Arc<Mesh>> {
        self.meshes.get(id.0)
    }

    /// The material of an id.
    #[must_use]
    pub fn material(&self, id: MaterialId) -> Option<&Material> {
        self.materials.get(id.0)
    }

    /// The texture of an id.
    #[must_use]
    pub fn texture(&self, id: TextureId) -> Option<&Arc<Texture>> {
        self.textures.get(id.0)
    }

    /// The latest mesh of a name.
    #[must_use]
    pub fn find_mesh(&self, name: &str) -> Option<MeshId> {
        self.meshes.by_name.get(name).copied().map(MeshId)
    }

    /// The latest material of a name.
    #[must_use]
    pub fn find_material(&self, name: &str) -> Option<MaterialId> {
        self.materials.by_name.get(name).copied().map(MaterialId)
    }

    /// The latest texture of a name.
    #[must_use]
    pub fn find_texture(&self, name: &str) -> Option<TextureId> {
        self.textures.by_name.get(name).copied().map(TextureId)
    }

    /// All meshes; the place in the slice is the id.
    #[must_use]
    pub fn meshes(&self) -> &[Entry<Arc<Mesh>>] {
        &self.meshes.entries
    }

    /// Bounds of all meshes; the place in the slice is the id.
    #[must_use]
    pub fn mesh_bounds(&self) -> &[MeshBounds] {
        &self.bounds
    }

    /// All materials; the place in the slice is the id.
    #[must_use]
    pub fn materials(&self) -> &[Entry<Material>] {
        &self.materials.entries
    }

    /// The reflection models that materials ask for.
    #[must_use]
    pub fn reflection_models(&self) -> ReflectionModels {
        let entries = self.materials.entries.iter();
        let models = entries.map(|entry| entry.value.reflection.model());
        models.fold(ReflectionModels::default(), ReflectionModels::with)
    }

    /// All textures; the place in the slice is the id.
    #[must_use]
    pub fn textures(&self) -> &[Entry<Arc<Texture>>] {
        &self.textures.entries
    }
}

#[cfg(test)]
mod tests;
