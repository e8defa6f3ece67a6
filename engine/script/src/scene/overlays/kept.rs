//! Changes by hand as plain data, which can be written down and laid on the scene of another run.

use lightbench_world::{Entity, Value};

use super::structure::Done;
use super::{Edit, Overlay, Overlays};

/// A changed field: the entity's name, the field's path, and the value.
pub type KeptField = (String, String, Value);

/// A change of the structure, with what laid on the fields that it took away.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptEdit {
    /// What was done.
    pub edit: Edit,
    /// Changed fields of what it has removed, which come back with that.
    pub fields: Vec<KeptField>,
    /// The greatest number that entities of the file have had by then.
    pub greatest: u32,
}

/// All that was changed by hand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeptOverlays {
    /// Changed fields, by the entity's name and the field's path.
    pub fields: Vec<KeptField>,
    /// Changes of the structure, oldest first.
    pub edits: Vec<KeptEdit>,
}

impl KeptOverlays {
    /// How many changes there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.fields.len() + self.edits.len()
    }

    /// Whether nothing was changed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Overlays {
    /// What was changed, as plain data.
    #[must_use]
    pub fn kept(&self) -> KeptOverlays {
        let field = |(entity, path): &(String, String), overlay: &Overlay| {
            (entity.clone(), path.clone(), overlay.value.clone())
        };
        let fields = self.all.iter();
        let edits = self.edits.iter().map(|done| KeptEdit {
            edit: done.edit.clone(),
            fields: done.fields.iter().map(|(k, o)| field(k, o)).collect(),
            greatest: done.greatest,
        });
        KeptOverlays {
            fields: fields.map(|(key, overlay)| field(key, overlay)).collect(),
            edits: edits.collect(),
        }
    }

    /// Changes that wait for a scene: [`Overlays::lay_on`] lays them on one.
    #[must_use]
    pub fn from_kept(kept: KeptOverlays) -> Self {
        let edits = kept.edits.into_iter().zip(1..).map(|(kept, serial)| {
            let fields = kept.fields.into_iter().map(waiting).collect();
            Done::waiting(kept.edit, serial, fields, kept.greatest)
        });
        let edits: Vec<Done> = edits.collect();
        Self {
            all: kept.fields.into_iter().map(waiting).collect(),
            serial: edits.len() as u64,
            edits,
            looked: None,
            assets_seen: 0,
        }
    }
}

/// A changed field that waits for its entity.
pub(super) fn waiting((entity, path, value): KeptField) -> ((String, String), Overlay) {
    let overlay = Overlay {
        value,
        script: None,
        contested: false,
        in_force: None,
        entity: Entity::NONE,
        aim: None,
    };
    ((entity, path), overlay)
}
