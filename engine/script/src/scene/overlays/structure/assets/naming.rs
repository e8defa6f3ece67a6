//! Assets by what they are called. Ids are others after a load; names and their order are not.

use lightbench_assets::{Assets, MaterialId, MeshId, TextureId};

use super::super::Who;

fn find<'a>(mut names: impl Iterator<Item = &'a str>, who: &Who) -> Option<u32> {
    let mut place = 0;
    let mut nth = 0;
    names
        .find(|name| {
            let same = *name == who.name;
            let found = same && nth == who.nth;
            nth += u32::from(same);
            place += u32::from(!found);
            found
        })
        .map(|_| place)
}

fn name<'a>(names: impl Iterator<Item = &'a str> + Clone, id: u32) -> Who {
    let own = names.clone().nth(id as usize).unwrap_or_default();
    let before = names.take(id as usize).filter(|name| *name == own);
    Who {
        name: own.to_owned(),
        nth: before.count() as u32,
    }
}

fn meshes(assets: &Assets) -> impl Iterator<Item = &str> + Clone {
    assets.meshes().iter().map(|entry| &*entry.value.name)
}

fn materials(assets: &Assets) -> impl Iterator<Item = &str> + Clone {
    assets.materials().iter().map(|entry| &*entry.value.name)
}

fn textures(assets: &Assets) -> impl Iterator<Item = &str> + Clone {
    assets.textures().iter().map(|entry| &*entry.value.name)
}

/// What to call a mesh.
pub(super) fn mesh(assets: &Assets, id: MeshId) -> Who {
    name(meshes(assets), id.0)
}

/// What to call a material.
pub(super) fn material(assets: &Assets, id: MaterialId) -> Who {
    name(materials(assets), id.0)
}

/// What to call a texture.
pub(super) fn texture(assets: &Assets, id: TextureId) -> Who {
    name(textures(assets), id.0)
}

/// The mesh that is called so.
pub(super) fn find_mesh(assets: &Assets, who: &Who) -> Result<MeshId, String> {
    let found = find(meshes(assets), who).map(MeshId);
    found.ok_or_else(|| missing("mesh", who))
}

/// The material that is called so.
pub(super) fn find_material(assets: &Assets, who: &Who) -> Result<MaterialId, String> {
    let found = find(materials(assets), who).map(MaterialId);
    found.ok_or_else(|| missing("material", who))
}

/// The texture that is called so.
pub(super) fn find_texture(assets: &Assets, who: &Who) -> Result<TextureId, String> {
    let found = find(textures(assets), who).map(TextureId);
    found.ok_or_else(|| missing("texture", who))
}

fn missing(kind: &str, who: &Who) -> String {
    format!("there is no {kind} `{}` now", who.words())
}
