//! Changes of a scene's materials, meshes and textures by hand, and of which of them entities have.

mod inverse;
mod listing;
mod naming;
mod painted;
mod surface;
#[cfg(test)]
mod tests;
mod work;

use std::collections::HashSet;

use lightbench_assets::MaterialId;
use lightbench_world::Transform;

use super::Who;
use super::edit::{free_name, is_taken, spell};
use crate::scene::Scene;
use crate::scene::shelf::AssetId;
use crate::spelling::spell_text;

pub(super) use inverse::AssetInverse;
pub(in crate::scene) use listing::LastListing;
pub use listing::{Listed, Listing};
pub use surface::{Picture, SurfaceField, SurfaceValue};
pub(super) use work::perform;

/// A change of assets, in terms that hold over loads. [`Who`] names assets as it does entities.
#[derive(Clone, Debug, PartialEq)]
pub enum AssetEdit {
    /// Makes a material.
    NewMaterial {
        /// What it is called; empty for a name that is free.
        name: String,
        /// Of which it is a copy; none for a matt grey.
        like: Option<Who>,
    },
    /// Calls a material otherwise.
    RenameMaterial {
        /// Which.
        of: Who,
        /// Its new name.
        name: String,
    },
    /// Removes materials. What is drawn with them gets the default material.
    DeleteMaterial {
        /// Which.
        of: Vec<Who>,
    },
    /// Changes one field of materials.
    Paint {
        /// What it is that is changed.
        field: SurfaceField,
        /// Which materials, each with its new value; `None` for the script's own.
        of: Vec<(Who, Option<SurfaceValue>)>,
    },
    /// Gives entities a material to be drawn with.
    Dress {
        /// Which entities.
        of: Vec<Who>,
        /// The material; `None` for the one that the script gave.
        material: Option<Who>,
    },
    /// Makes a mesh.
    NewMesh {
        /// The calls that make it, as in `sphere(0.5)`.
        recipe: String,
    },
    /// Gives entities a mesh to be drawn with.
    Reshape {
        /// Which entities.
        of: Vec<Who>,
        /// The mesh; `None` for the one that the script gave.
        mesh: Option<Who>,
    },
    /// Removes a mesh that nothing is drawn with.
    DeleteMesh {
        /// Which.
        of: Who,
    },
    /// Makes a texture.
    NewTexture {
        /// The calls that make it, as in `picture("wall.png")`.
        recipe: String,
    },
    /// Removes a texture that no material has.
    DeleteTexture {
        /// Which.
        of: Who,
    },
    /// Adds a model of a file with all its parts, as an entity.
    AddModel {
        /// The file's path.
        path: String,
        /// What the entity is called; empty for the file's name.
        name: String,
        /// The first of the numbers in files; 0 for the next one.
        number: u32,
        /// Where it stands.
        place: Transform,
    },
}

impl AssetEdit {
    /// What was done, in words.
    pub(super) fn words(&self) -> String {
        match self {
            Self::NewMaterial { name, like: None } => format!("Create material {name}"),
            Self::NewMaterial {
                name,
                like: Some(like),
            } => format!("Duplicate material {} as {name}", like.words()),
            Self::RenameMaterial { of, name } => {
                format!("Rename material {} to {name}", of.words())
            }
            Self::DeleteMaterial { of } => format!("Delete {}", materials(of.iter())),
            Self::Paint { field, of } => {
                let all = materials(of.iter().map(|(who, _)| who));
                match of.iter().all(|(_, value)| value.is_none()) {
                    true => format!("{} of {all} back to the script", field.name()),
                    false => format!("{} of {all}", field.name()),
                }
            }
            Self::Dress { of, material } => match material {
                Some(material) => format!("Material {} for {}", material.words(), spell(of)),
                None => format!("Material of {} back to the script", spell(of)),
            },
            Self::Reshape { of, mesh } => match mesh {
                Some(mesh) => format!("Mesh {} for {}", mesh.words(), spell(of)),
                None => format!("Mesh of {} back to the script", spell(of)),
            },
            Self::NewMesh { recipe } => format!("Create mesh {recipe}"),
            Self::DeleteMesh { of } => format!("Delete mesh {}", of.words()),
            Self::NewTexture { recipe } => format!("Add texture {recipe}"),
            Self::DeleteTexture { of } => format!("Delete texture {}", of.words()),
            Self::AddModel { path, .. } => format!("Add {path}"),
        }
    }

    /// The line of a scene script that does the same, where there is one.
    pub(super) fn line(&self) -> Option<String> {
        match self {
            Self::AddModel {
                path, name, place, ..
            } => {
                let at = super::super::lines::spell_point(place.translation);
                let (path, name) = (spell_text(path), spell_text(name));
                Some(format!(
                    "{{ let it = load_model({path}); it.name = {name}; it.at({at}); }}"
                ))
            }
            _ => None,
        }
    }

    /// The change with names for what it makes, if it can be done.
    pub(super) fn completed(
        self,
        scene: &Scene,
        taken: &mut HashSet<String>,
        greatest: u32,
    ) -> Result<Self, String> {
        let assets = &scene.assets;
        match &self {
            Self::NewMaterial { name, like } => {
                let mut taken = scene.material_names();
                let wanted = match like {
                    Some(like) => {
                        naming::find_material(assets, like)?;
                        &like.name
                    }
                    None => "material",
                };
                let name = match name.is_empty() {
                    true => free_name(wanted, &mut taken),
                    false if taken.contains(name) => return Err(named_so(name)),
                    false => name.clone(),
                };
                let like = like.clone();
                return Ok(Self::NewMaterial { name, like });
            }
            Self::RenameMaterial { of, name } => {
                changeable(scene, of)?;
                if name.trim().is_empty() {
                    return Err("a name has at least one letter".to_owned());
                }
                if *name != of.name && scene.material_names().contains(name) {
                    return Err(named_so(name));
                }
            }
            Self::DeleteMaterial { of } => {
                some(of.len())?;
                of.iter()
                    .try_for_each(|of| changeable(scene, of).map(drop))?;
            }
            Self::Paint { field, of } => {
                some(of.len())?;
                for (of, value) in of {
                    changeable(scene, of)?;
                    value.iter().try_for_each(|value| field.check(value))?;
                }
            }
            Self::Dress { of, material } => {
                super::edit::are_present(scene, of)?;
                if let Some(material) = material {
                    naming::find_material(assets, material)?;
                }
            }
            Self::Reshape { of, mesh } => {
                super::edit::are_present(scene, of)?;
                if let Some(mesh) = mesh {
                    naming::find_mesh(assets, mesh)?;
                }
            }
            Self::NewMesh { .. } | Self::NewTexture { .. } => {}
            Self::DeleteMesh { of } => {
                let id = naming::find_mesh(assets, of)?;
                scene.deletable(AssetId::Mesh(id), of)?;
            }
            Self::DeleteTexture { of } => {
                let id = naming::find_texture(assets, of)?;
                scene.deletable(AssetId::Texture(id), of)?;
            }
            Self::AddModel {
                path,
                name,
                number,
                place,
            } => {
                let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
                let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
                let name = match name.is_empty() {
                    true => {
                        let mut free = free_name(stem, taken);
                        // Its parts are called after it.
                        while taken.iter().any(|name| work::is_part_of(name, &free)) {
                            free = free_name(stem, taken);
                        }
                        free
                    }
                    false if taken.contains(name) => return Err(is_taken(name)),
                    false => name.clone(),
                };
                let number = if *number == 0 { greatest + 1 } else { *number };
                return Ok(Self::AddModel {
                    path: path.clone(),
                    name,
                    number,
                    place: *place,
                });
            }
        }
        Ok(self)
    }
}

fn materials<'a>(of: impl ExactSizeIterator<Item = &'a Who>) -> String {
    let (count, first) = (of.len(), of.last());
    match first {
        Some(one) if count == 1 => format!("material {}", one.words()),
        _ => format!("{count} materials"),
    }
}

fn some(count: usize) -> Result<(), String> {
    match count {
        0 => Err("no material is chosen".to_owned()),
        _ => Ok(()),
    }
}

fn named_so(name: &str) -> String {
    format!("another material is called `{name}`")
}

/// Refuses materials that are not there, and the default one, which no file can hold.
fn changeable(scene: &Scene, who: &Who) -> Result<MaterialId, String> {
    let id = naming::find_material(&scene.assets, who)?;
    match id {
        MaterialId(0) => Err(
            "the default material is the same in all scenes: duplicate it, and change the copy"
                .to_owned(),
        ),
        id => Ok(id),
    }
}
