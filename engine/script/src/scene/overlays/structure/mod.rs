//! Changes of a scene's structure by hand: entities that come, go, hang elsewhere, are called otherwise,
//! and components that come and go.
//!
//! They are kept as a list of [`Edit`]s, each with what takes it back. The list lies over the script as
//! the changed fields do: when the script was loaded anew, it is done again from its beginning. One
//! whose entities are not there waits until they come. The last one can be taken back, and then the
//! world is as it was before it: handles, rows, places among siblings and numbers in files too.

mod assets;
mod edit;
mod finding;
mod inverse;
mod kinds;
mod lines;
mod replay;
#[cfg(test)]
mod tests;
mod work;

use std::collections::{HashMap, HashSet};

use lightbench_world::{Entity, scene_file};

pub(in crate::scene) use assets::LastListing;
pub use assets::{AssetEdit, Listed, Listing, Picture, SurfaceField, SurfaceValue};
pub use edit::{Edit, Who};
pub use finding::topmost;
pub use kinds::NewKind;

use super::{Overlay, Overlays};
use crate::scene::Scene;
use crate::scene::shelf::Stock;
use inverse::Inverse;

/// The tag of entities that the editor leaves alone.
pub const LOCKED: &str = "locked";

/// A change that was done, with what takes it back.
#[derive(Clone, Debug)]
pub(super) struct Done {
    pub(super) edit: Edit,
    /// A number of its own.
    serial: u64,
    /// What takes it back; `None` while it waits for its entities.
    inverse: Option<Inverse>,
    /// Changed fields of what it has removed.
    pub(super) fields: Vec<((String, String), Overlay)>,
    /// The greatest number that entities of the file have had by now.
    pub(super) greatest: u32,
    /// How much there was of assets before and after it.
    pub(super) stock: (Stock, Stock),
}

impl Done {
    /// One that waits for a scene.
    pub(super) fn waiting(
        edit: Edit,
        serial: u64,
        fields: Vec<((String, String), Overlay)>,
        greatest: u32,
    ) -> Self {
        Self {
            edit,
            serial,
            inverse: None,
            fields,
            greatest,
            stock: Default::default(),
        }
    }
}

impl Overlays {
    /// All changes of the structure, oldest first, and whether each waits for its entities.
    pub fn edits(&self) -> impl DoubleEndedIterator<Item = (&Edit, bool)> + ExactSizeIterator {
        let edits = self.edits.iter();
        edits.map(|done| (&done.edit, done.inverse.is_none()))
    }

    /// Changes the structure by hand. Gives the change as it was done, with the names and numbers of
    /// what it made.
    ///
    /// # Errors
    /// A sentence that says why it can't be done. Then nothing has changed.
    pub fn edit(&mut self, scene: &mut Scene, edit: Edit) -> Result<Edit, String> {
        self.follow(scene);
        let greatest = scene_file::number(&mut scene.world).max(self.greatest());
        let edit = edit.completed(scene, self, greatest)?;
        let fields = self.lift_those_of(scene, &edit);
        let before = scene.stock();
        let result = work::perform(scene, &edit, &self.edits);
        let stock = (before, scene.stock());
        if result.is_err() {
            scene.forget_added(&stock);
        }
        let goes = matches!(edit, Edit::Delete { .. } | Edit::Drop { .. });
        let fields = match (&result, goes) {
            (Ok(_), true) => fields,
            _ => {
                self.lay_back(scene, fields);
                Vec::new()
            }
        };
        let inverse = result?;
        let greatest = greatest.max(scene_file::number(&mut scene.world));
        self.follow_names(&inverse, false);
        self.copy_fields(&edit, scene);
        self.serial += 1;
        self.edits.push(Done {
            edit: edit.clone(),
            serial: self.serial,
            inverse: Some(inverse),
            fields,
            greatest,
            stock,
        });
        self.settle(scene);
        Ok(edit)
    }

    /// Takes back the last change of the structure. Gives it, or `None` where there was none.
    pub fn undo_edit(&mut self, scene: &mut Scene) -> Option<Edit> {
        let done = self.edits.pop()?;
        if let Some(inverse) = &done.inverse {
            self.forget_fields_of(scene, inverse);
            let map = inverse.revert(scene);
            for other in &mut self.edits {
                if let Some(other) = &mut other.inverse {
                    other.follow(&map);
                }
            }
            self.follow_names(inverse, true);
        }
        self.unpaint(scene, &done);
        scene.forget_added(&done.stock);
        self.lay_back(scene, done.fields);
        self.settle(scene);
        Some(done.edit)
    }

    /// The entities that the last change has made, not those below others of them.
    #[must_use]
    pub fn made_last(&self) -> &[Entity] {
        match self.edits.last().and_then(|done| done.inverse.as_ref()) {
            Some(Inverse::Made(made)) => made,
            _ => &[],
        }
    }

    fn greatest(&self) -> u32 {
        self.edits.last().map_or(0, |done| done.greatest)
    }

    /// Lays fields on again after the structure has changed.
    pub(super) fn settle(&mut self, scene: &mut Scene) {
        self.looked = None;
        self.follow(scene);
        scene.refresh();
    }

    /// Takes off the changed fields of what a change removes or copies, so that the script's own values
    /// go.
    fn lift_those_of(
        &mut self,
        scene: &mut Scene,
        edit: &Edit,
    ) -> Vec<((String, String), Overlay)> {
        let (entities, component) = match edit {
            Edit::Delete { of } | Edit::Copy { of, .. } => {
                let roots = finding::found(&scene.world, of);
                (with_all_below(scene, &roots), None)
            }
            Edit::Drop { of, component } => {
                let own = finding::found(&scene.world, of);
                (own.into_iter().collect(), Some(*component))
            }
            _ => return Vec::new(),
        };
        let goes = |(_, path): &(String, String), overlay: &Overlay| {
            let field = crate::scene::tables::field(path);
            let of_it = |kind| field.is_ok_and(|field| field.kind == kind);
            entities.contains(&overlay.entity) && component.is_none_or(of_it)
        };
        let keys = self.all.iter().filter(|(key, overlay)| goes(key, overlay));
        let keys: Vec<(String, String)> = keys.map(|(key, _)| key.clone()).collect();
        let lifted = keys.into_iter().filter_map(|key| {
            let overlay = self.all.remove(&key)?;
            overlay.clone().take_off(scene, &key.1);
            Some((key, overlay))
        });
        lifted.collect()
    }

    fn lay_back(&mut self, scene: &mut Scene, fields: Vec<((String, String), Overlay)>) {
        if fields.is_empty() {
            return;
        }
        for (key, overlay) in fields {
            self.all.insert(key, overlay.lifted());
        }
        self.looked = None;
        self.follow(scene);
    }

    /// Forgets the changed fields of what is about to be removed again.
    fn forget_fields_of(&mut self, scene: &Scene, inverse: &Inverse) {
        let Inverse::Made(made) = inverse else {
            return;
        };
        let gone = with_all_below(scene, made);
        self.all
            .retain(|_, overlay| !gone.contains(&overlay.entity));
    }

    /// Gives changed fields the new names of their entities.
    fn follow_names(&mut self, inverse: &Inverse, back: bool) {
        let Inverse::Renamed(renamed) = inverse else {
            return;
        };
        let new_names = renamed.iter().map(|one| match back {
            true => (one.entity, (&one.after, &one.before)),
            false => (one.entity, (&one.before, &one.after)),
        });
        let new_names: HashMap<Entity, (&String, &String)> = new_names.collect();
        // All at once, because two may have changed names with each other.
        let all = std::mem::take(&mut self.all).into_iter();
        let follow = |((name, path), overlay): ((String, String), Overlay)| {
            let name = match new_names.get(&overlay.entity) {
                Some((old, new)) if **old == name => (*new).clone(),
                _ => name,
            };
            ((name, path), overlay)
        };
        self.all = all.map(follow).collect();
    }

    /// Gives copies the changed fields of what they are copies of.
    fn copy_fields(&mut self, edit: &Edit, scene: &Scene) {
        let Edit::Copy { names, .. } = edit else {
            return;
        };
        for (source, copy) in names {
            let of_it = |(key, overlay): &(&(String, String), &Overlay)| {
                key.0 == *source && scene.world.contains(overlay.entity)
            };
            let own = self.all.iter().filter(of_it);
            let own: Vec<((String, String), Overlay)> = own
                .map(|(key, overlay)| ((copy.clone(), key.1.clone()), overlay.clone().lifted()))
                .collect();
            self.all.extend(own);
        }
    }
}

impl Scene {
    fn stock(&mut self) -> Stock {
        self.on_data(|data| data.stock())
    }

    /// Forgets the assets that a change has added.
    fn forget_added(&mut self, (before, after): &(Stock, Stock)) {
        if before != after {
            self.on_data(|data| data.forget_added(before, after));
        }
    }
}

/// Entities with all that hang on them.
fn with_all_below(scene: &Scene, roots: &[Entity]) -> HashSet<Entity> {
    let mut all: HashSet<Entity> = roots.iter().copied().collect();
    for root in roots {
        all.extend(scene.world.descendants(*root));
    }
    all
}
