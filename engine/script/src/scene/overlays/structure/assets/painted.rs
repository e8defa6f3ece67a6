//! Values of materials that lie over those of the script.
//!
//! The list of changes says for each material and field what is wanted last, and what there was before
//! the first of them. So a change that is taken back from the end leaves what those before it say.

use std::collections::HashMap;

use lightbench_assets::{Material, MaterialId};

use super::super::{Done, Inverse};
use super::inverse::Painted;
use super::surface::{SurfaceField, SurfaceValue};
use crate::scene::Scene;
use crate::scene::overlays::Overlays;

fn painted(done: &Done) -> Option<(SurfaceField, &[Painted])> {
    match &done.inverse {
        Some(Inverse::Assets(inverse)) => {
            let (field, all) = inverse.painted.as_ref()?;
            Some((*field, all))
        }
        _ => None,
    }
}

/// What changes say of a field of a material, oldest first.
fn of_one(
    edits: &[Done],
    id: MaterialId,
    field: SurfaceField,
) -> impl DoubleEndedIterator<Item = &Painted> {
    let all = edits.iter().filter_map(painted);
    let own = all.filter(move |(painted, _)| *painted == field);
    own.flat_map(|(_, all)| all).filter(move |one| one.id == id)
}

/// What a field of a material was before all changes by hand; `None` where there are none.
pub(super) fn original(edits: &[Done], id: MaterialId, field: SurfaceField) -> Option<&Material> {
    of_one(edits, id, field).next().map(|one| &one.before)
}

fn write(scene: &mut Scene, id: MaterialId, field: SurfaceField, from: &Material) {
    let Some(mut material) = scene.assets.material(id).cloned() else {
        return;
    };
    field.copy(from, &mut material);
    // It was found just now.
    let _written = scene.assets.replace_material(id, material);
}

impl Overlays {
    /// Makes materials what they are without a change that was the last one.
    pub(in super::super) fn unpaint(&self, scene: &mut Scene, done: &Done) {
        let Some((field, all)) = painted(done) else {
            return;
        };
        for one in all.iter().rev() {
            let last = of_one(&self.edits, one.id, field).next_back();
            let wanted = match last {
                Some(last) => last
                    .wanted
                    .as_ref()
                    .or_else(|| original(&self.edits, one.id, field)),
                None => Some(&one.before),
            };
            write(scene, one.id, field, wanted.unwrap_or(&one.before));
        }
    }

    /// What a field of a material holds without changes by hand, where it was changed.
    #[must_use]
    pub fn script_surface(
        &self,
        scene: &Scene,
        id: MaterialId,
        field: SurfaceField,
    ) -> Option<SurfaceValue> {
        let last = of_one(&self.edits, id, field).next_back()?;
        last.wanted.as_ref()?;
        let original = original(&self.edits, id, field)?;
        Some(scene.value_of(original, field))
    }

    /// Paints again what something else has written since. Returns whether there was something.
    pub(in super::super::super) fn follow_surfaces(&mut self, scene: &mut Scene) {
        let revision = scene.assets.revision();
        if self.assets_seen == revision {
            return;
        }
        let mut places: HashMap<(MaterialId, SurfaceField), (usize, Option<Material>)> =
            HashMap::new();
        for (place, done) in self.edits.iter().enumerate() {
            let Some((field, all)) = painted(done) else {
                continue;
            };
            for one in all {
                let known = places.entry((one.id, field));
                known.or_insert((place, None)).1.clone_from(&one.wanted);
            }
        }
        for ((id, field), (first, wanted)) in places {
            let (Some(now), Some(wanted)) = (scene.assets.material(id).cloned(), wanted) else {
                continue;
            };
            if field.is_same(&now, &wanted) {
                continue;
            }
            // What the script says now is what is given back to it.
            if let Some(Inverse::Assets(inverse)) = &mut self.edits[first].inverse
                && let Some((_, all)) = &mut inverse.painted
                && let Some(one) = all.iter_mut().find(|one| one.id == id)
            {
                one.before = now;
            }
            write(scene, id, field, &wanted);
        }
        self.assets_seen = scene.assets.revision();
    }
}
