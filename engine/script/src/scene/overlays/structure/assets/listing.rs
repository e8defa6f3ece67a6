//! The assets of a scene for who chooses among them.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::{Arc, Mutex, PoisonError};

use lightbench_assets::{Assets, MaterialId, MeshId, TextureId};
use lightbench_world::{ClipVolume, Entity, MeshRenderer};

use super::super::Who;
use super::naming;
use crate::scene::Scene;
use crate::scene::data::Data;
use crate::scene::recipes::MeshRecipe;
pub use crate::scene::shelf::AssetId;
use crate::scene::shelf::Shelf;

/// An asset of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    /// Its id, until the scene is loaded anew.
    pub id: AssetId,
    /// What to call it in changes.
    pub who: Who,
    /// The calls that make it, where it is a mesh or a texture that calls with few values have made.
    pub recipe: Option<String>,
    /// Whether it is there though nothing uses it: then it can be deleted.
    pub is_kept: bool,
}

/// All assets that there are for a person: meshes, then materials, then textures.
#[derive(Debug, Default, PartialEq)]
pub struct Listing {
    all: Vec<Listed>,
    meshes: usize,
    materials: usize,
}

impl Listing {
    /// All of them.
    #[must_use]
    pub fn all(&self) -> &[Listed] {
        &self.all
    }

    /// The meshes.
    #[must_use]
    pub fn meshes(&self) -> &[Listed] {
        &self.all[..self.meshes]
    }

    /// The materials.
    #[must_use]
    pub fn materials(&self) -> &[Listed] {
        &self.all[self.meshes..][..self.materials]
    }

    /// The textures.
    #[must_use]
    pub fn textures(&self) -> &[Listed] {
        &self.all[self.meshes + self.materials..]
    }
}

/// What a listing was made from: while it stays the same, so does the listing.
#[derive(Debug, PartialEq, Eq)]
struct Stamp {
    assets: u64,
    shelf: u64,
    /// Those that were deleted and that something uses still.
    gone_but_used: BTreeSet<AssetId>,
}

/// The last listing of a scene: panels ask for it in each frame, and a scene may have thousands of meshes.
#[derive(Debug, Default)]
pub(in crate::scene) struct LastListing(Mutex<Option<(Stamp, Arc<Listing>)>>);

impl Scene {
    /// All meshes, materials and textures that there are for a person: not what was deleted and is not
    /// used, and not the default material and the texture for missing pictures. While nothing changes,
    /// it is the same list.
    #[must_use]
    pub fn listed(&self) -> Arc<Listing> {
        let data = self.stage.lock();
        let stamp = Stamp {
            assets: self.assets.roster_revision(),
            shelf: data.shelf.revision(),
            gone_but_used: self.gone_but_used(&data.shelf),
        };
        let last = self.last_listing.0.lock();
        let mut last = last.unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some((before, listing)) if *before == stamp => Arc::clone(listing),
            _ => {
                let listing = Arc::new(self.list(&data, &stamp.gone_but_used));
                *last = Some((stamp, Arc::clone(&listing)));
                listing
            }
        }
    }

    fn list(&self, data: &Data, gone_but_used: &BTreeSet<AssetId>) -> Listing {
        let assets = &self.assets;
        let counts = assets.counts();
        let listed = |id: AssetId, who: &Who| {
            let marks = data.shelf.marks(id);
            if marks.gone && !gone_but_used.contains(&id) {
                return None;
            }
            let recipe = match id {
                AssetId::Mesh(id) => match data.recipes.meshes.get(&id) {
                    Some(MeshRecipe::Calls(calls)) => Some(calls.clone()),
                    _ => None,
                },
                AssetId::Texture(id) => data.recipes.textures.get(&id).cloned(),
                AssetId::Material(_) => None,
            };
            Some(Listed {
                id,
                who: who.clone(),
                recipe,
                is_kept: marks.kept,
            })
        };
        let mut all = Vec::with_capacity(counts.meshes + counts.materials + counts.textures);
        let meshes = names(assets.meshes().iter().map(|entry| &*entry.value.name));
        let ids = (0..).map(|id| AssetId::Mesh(MeshId(id)));
        all.extend(ids.zip(&meshes).filter_map(|(id, who)| listed(id, who)));
        let meshes = all.len();
        // The first of these two tables is nobody's.
        let materials = names(assets.materials().iter().map(|entry| &*entry.value.name));
        let ids = (0..).map(|id| AssetId::Material(MaterialId(id)));
        let rest = ids.zip(&materials).skip(1);
        all.extend(rest.filter_map(|(id, who)| listed(id, who)));
        let materials = all.len() - meshes;
        let textures = names(assets.textures().iter().map(|entry| &*entry.value.name));
        let ids = (0..).map(|id| AssetId::Texture(TextureId(id)));
        let rest = ids.zip(&textures).skip(1);
        all.extend(rest.filter_map(|(id, who)| listed(id, who)));
        Listing {
            all,
            meshes,
            materials,
        }
    }

    /// What was deleted and something uses still.
    fn gone_but_used(&self, shelf: &Shelf) -> BTreeSet<AssetId> {
        if shelf.gone().is_empty() {
            return BTreeSet::new();
        }
        let renderers = self.world.columns::<MeshRenderer>();
        let volumes = self.world.columns::<ClipVolume>().mesh().iter();
        let meshes = renderers.mesh().iter().chain(volumes);
        let meshes = meshes.map(|id| AssetId::Mesh(*id));
        let materials = renderers.material().iter().map(|id| AssetId::Material(*id));
        let drawn = meshes
            .chain(materials)
            .filter(|id| shelf.gone().contains(id));
        let textures = shelf.gone().iter().copied().filter(|id| match id {
            AssetId::Texture(id) => !textured(&self.assets, shelf, *id).is_empty(),
            _ => false,
        });
        drawn.chain(textures).collect()
    }

    /// What to call a material in changes.
    #[must_use]
    pub fn who_is_material(&self, id: MaterialId) -> Who {
        naming::material(&self.assets, id)
    }

    /// What to call a mesh in changes.
    #[must_use]
    pub fn who_is_mesh(&self, id: MeshId) -> Who {
        naming::mesh(&self.assets, id)
    }

    /// The material that is called so.
    #[must_use]
    pub fn find_material(&self, who: &Who) -> Option<MaterialId> {
        naming::find_material(&self.assets, who).ok()
    }

    /// The entities that are drawn with a mesh or a material, and with a texture by their material.
    #[must_use]
    pub fn users(&self, id: AssetId) -> Vec<Entity> {
        let renderers = self.world.columns::<MeshRenderer>();
        let rows = renderers.mesh().iter().zip(renderers.material());
        let textured = match id {
            AssetId::Texture(id) => self.textured(id).into_iter().collect(),
            _ => BTreeSet::new(),
        };
        let uses = |(mesh, material): (&MeshId, &MaterialId)| match id {
            AssetId::Mesh(id) => *mesh == id,
            AssetId::Material(id) => *material == id,
            AssetId::Texture(_) => textured.contains(material),
        };
        let all = rows.zip(renderers.entities());
        let mut users: Vec<Entity> = all
            .filter(|(row, _)| uses(*row))
            .map(|(_, entity)| *entity)
            .collect();
        if let AssetId::Mesh(id) = id {
            let volumes = self.world.columns::<ClipVolume>();
            let bounded = volumes.mesh().iter().zip(volumes.entities());
            users.extend(bounded.filter(|(mesh, _)| **mesh == id).map(|(_, e)| *e));
        }
        users
    }

    /// The materials that have a texture.
    #[must_use]
    pub fn textured(&self, id: TextureId) -> Vec<MaterialId> {
        textured(&self.assets, &self.stage.lock().shelf, id)
            .into_iter()
            .collect()
    }

    /// Refuses to delete what is used, and what is not a person's own.
    pub(super) fn deletable(&self, id: AssetId, who: &Who) -> Result<(), String> {
        let name = who.words();
        let users = self.users(id);
        let drawn = users.first().map(|first| match users.len() {
            1 => {
                let user = super::super::finding::named(&self.world, *first);
                format!("{user} is drawn with {name}: give it another one first")
            }
            count => format!("{count} entities are drawn with {name}: give them another one first"),
        });
        let in_material = match id {
            AssetId::Texture(id) => self.textured(id).first().copied(),
            _ => None,
        };
        if let Some(material) = in_material {
            let material = naming::material(&self.assets, material).words();
            return Err(format!(
                "the material {material} has {name}: give it another texture first"
            ));
        }
        if let Some(drawn) = drawn {
            return Err(drawn);
        }
        match self.stage.lock().shelf.marks(id).kept {
            true => Ok(()),
            false => Err(format!(
                "{name} was not added by hand: it goes when the scene's script makes it no more"
            )),
        }
    }

    /// Names of materials that a new one can't have.
    pub(super) fn material_names(&self) -> HashSet<String> {
        let data = self.stage.lock();
        let all = self.assets.materials().iter().enumerate();
        let there = all.filter(|(id, _)| {
            let id = AssetId::Material(MaterialId(*id as u32));
            !data.shelf.marks(id).gone
        });
        there.map(|(_, entry)| entry.value.name.clone()).collect()
    }
}

/// All names of a table, each with which of its kind it is.
fn names<'a>(all: impl Iterator<Item = &'a str>) -> Vec<Who> {
    let mut counts: HashMap<&str, u32> = HashMap::new();
    all.map(|name| {
        let count = counts.entry(name).or_default();
        *count += 1;
        Who {
            name: name.to_owned(),
            nth: *count - 1,
        }
    })
    .collect()
}

/// The materials that have a texture, but for those that were deleted.
fn textured(assets: &Assets, shelf: &Shelf, id: TextureId) -> BTreeSet<MaterialId> {
    let all = assets.materials().iter().enumerate();
    let all = all.map(|(place, entry)| (MaterialId(place as u32), &entry.value));
    let has = all.filter(|(own, material)| {
        let pictures = [material.base_color_texture, material.normal_texture];
        pictures.contains(&Some(id)) && !shelf.marks(AssetId::Material(*own)).gone
    });
    has.map(|(own, _)| own).collect()
}
