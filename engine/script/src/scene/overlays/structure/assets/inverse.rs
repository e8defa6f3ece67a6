//! What takes a change of assets back.

use lightbench_assets::{Material, MaterialId};
use lightbench_world::{Entity, EntityMap, MeshRenderer};

use super::surface::SurfaceField;
use crate::scene::data::Data;
use crate::scene::shelf::{AssetId, Marks};

/// What takes a change of assets back. What it added is dropped apart.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct AssetInverse {
    /// Materials that have other values now.
    pub(super) painted: Option<(SurfaceField, Vec<Painted>)>,
    /// What entities were drawn with.
    pub(super) drawn: Vec<(Entity, MeshRenderer)>,
    /// Which part of that was changed.
    pub(super) part: Option<Part>,
    /// How assets were marked.
    pub(super) marks: Vec<(AssetId, Marks)>,
    /// What a material was called.
    pub(super) renamed: Option<(MaterialId, String)>,
}

/// A part of what an entity is drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Mesh,
    Material,
}

impl Part {
    /// Gives what is drawn the part of another one.
    pub(super) fn copy(self, from: &MeshRenderer, to: &mut MeshRenderer) {
        match self {
            Self::Mesh => to.mesh = from.mesh,
            Self::Material => to.material = from.material,
        }
    }
}

/// A material with another value in one field.
#[derive(Clone, Debug)]
pub(super) struct Painted {
    pub(super) id: MaterialId,
    /// What it was, or what the script has made it since.
    pub(super) before: Material,
    /// What it shall be; `None` for what it was before all changes by hand.
    pub(super) wanted: Option<Material>,
}

impl AssetInverse {
    /// Takes back all but what was painted.
    pub(in super::super) fn revert(&self, data: &mut Data) {
        for (entity, before) in self.drawn.iter().rev() {
            let (Some(part), Some(mut now)) = (self.part, data.world.get::<MeshRenderer>(*entity))
            else {
                continue;
            };
            part.copy(before, &mut now);
            // It was found just now.
            let _given = data.world.insert(*entity, now);
        }
        // From the end, because one may be among them twice.
        for (id, marks) in self.marks.iter().rev() {
            data.shelf.mark(*id, *marks);
        }
        if let Some((id, name)) = &self.renamed {
            rename(data, *id, name);
        }
    }

    /// Follows entities that have other handles now.
    pub(in super::super) fn follow(&mut self, map: &EntityMap) {
        for (entity, _) in &mut self.drawn {
            if let Some(new) = map.get(*entity) {
                *entity = new;
            }
        }
    }
}

pub(super) fn rename(data: &mut Data, id: MaterialId, name: &str) {
    if let Some(mut material) = data.assets.material(id).cloned() {
        name.clone_into(&mut material.name);
        // It was found just now.
        let _renamed = data.assets.replace_material(id, material);
    }
}
