//! Taking back what a person did, and doing it again.
//!
//! What is done is kept as steps of changes. A change has what was before it and what is after it: a value,
//! where a value was set; where the editor stood, where a scene or a pipeline was chosen; the whole scene,
//! where time ran or a line of the console was run.

mod apply;
mod dials;
mod keys;
mod moments;
mod places;
mod travel;

use lightbench::script::SettingValue;
use lightbench::script::overlays::Edit;
use lightbench::world::{Entity, Value};

pub use self::dials::Dials;
pub use self::keys::NumberKeys;
pub use self::moments::Moment;
pub use self::places::{Chosen, Place};
use super::notebook::Deleted;

/// Something that a person can change.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A field of the entity of a name.
    Field {
        /// The entity's name.
        entity: String,
        /// The field, as in `light.range`.
        path: String,
    },
    /// A parameter of a pipeline.
    Pipeline {
        /// The pipeline's name.
        pipeline: String,
        /// The parameter's.
        parameter: String,
    },
    /// A parameter of the scene.
    Scene {
        /// The parameter's name.
        parameter: String,
    },
    /// The list of changes of the scene's structure, which grows or shrinks by one.
    Structure,
    /// A parameter of an entity's behaviour.
    Behaviour {
        /// The entity, until the scene is loaded anew.
        entity: Entity,
        /// The entity's name, by which it is found again.
        name: String,
        /// The parameter's name.
        parameter: String,
    },
    /// Which scene and pipelines there are, with their values; the name tells one choice from another.
    Place(String),
    /// The settings of the comparison and of time, one of them by its name.
    Dials(&'static str),
    /// The scene as it stands, changed in a way that has a name.
    Moment(&'static str),
    /// An entry of the notebook, by its name.
    Entry(String),
    /// The note of an entry of the notebook.
    Note(String),
    /// The number keys of pipelines.
    NumberKeys,
}

impl Target {
    /// Whether it is something of the scene that is on screen.
    fn is_of_a_scene(&self) -> bool {
        matches!(
            self,
            Self::Field { .. } | Self::Structure | Self::Behaviour { .. }
        )
    }
}

/// What somebody has set.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// A field's value.
    Value(Value),
    /// A parameter's value.
    Setting(SettingValue),
    /// A change of the scene's structure.
    Edit(Box<Edit>),
    /// Where the editor stands.
    Place(Box<Place>),
    /// Settings of the comparison and of time.
    Dials(Dials),
    /// The scene as it stands.
    Moment(Moment),
    /// An entry of the notebook that is not there, or was not.
    Entry(Deleted),
    /// Number keys of pipelines.
    NumberKeys(NumberKeys),
    /// A text.
    Text(String),
}

/// One change: what it was before and is after. `None` where nobody has set anything.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What was changed.
    pub target: Target,
    /// What it was.
    pub before: Option<Content>,
    /// What it is.
    pub after: Option<Content>,
}

/// What is taken back at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What was done, in words.
    pub what: String,
    changes: Vec<Change>,
    /// The scene in which it was done, where it was done to one.
    scene: Option<String>,
    /// The names of what was chosen before it, where it chooses something else.
    chosen: Vec<String>,
}

impl Step {
    fn changes_the_same(&self, other: &[Change]) -> bool {
        let pairs = self.changes.iter().zip(other);
        self.changes.len() == other.len() && pairs.into_iter().all(|(a, b)| a.target == b.target)
    }
}

/// Steps that are kept; older ones can't be taken back.
const CAPACITY: usize = 100_000;

/// What was done and what was taken back.
#[derive(Debug, Default)]
pub struct Undo {
    done: Vec<Step>,
    /// The last one taken back is at the end.
    undone: Vec<Step>,
    /// Whether the last step goes on, as while a slider is dragged.
    goes_on: bool,
    /// How many steps are to be done, while that waits for a scene.
    heading: Option<usize>,
    /// Something is done of which no note is taken: it is a part of a step, or the program does it.
    quiet: bool,
    /// The scene that is on screen, for the steps that are done to it.
    scene: Option<String>,
    /// The settings that are known.
    dials: Option<Dials>,
    /// Number keys that pipelines are to have, until they have them.
    number_keys: Option<NumberKeys>,
    /// Scenes that were kept as they stood.
    moments: moments::Moments,
    /// How often something was done, taken back or done again.
    revision: u64,
}

impl Undo {
    /// What can be taken back, oldest first.
    pub fn done(&self) -> &[Step] {
        &self.done
    }

    /// What can be done again, the next one last.
    pub fn undone(&self) -> &[Step] {
        &self.undone
    }

    /// The next change begins a step of its own.
    pub fn seal(&mut self) {
        self.goes_on = false;
    }

    /// Forgets all that could be taken back.
    pub fn clear(&mut self) {
        *self = Self {
            scene: self.scene.take(),
            dials: self.dials,
            quiet: self.quiet,
            revision: self.revision,
            ..Self::default()
        };
    }

    /// Another scene is on screen.
    pub(super) fn scene_is(&mut self, name: &str) {
        self.scene = Some(name.to_owned());
        self.goes_on = false;
    }

    /// Begins anew, as with another project.
    pub(super) fn begin_anew(&mut self) {
        self.clear();
        self.revision = 0;
    }

    /// Whether steps are to be taken back or done again as soon as a scene is there.
    pub fn is_waiting(&self) -> bool {
        self.heading.is_some()
    }

    /// How often something was done, taken back or done again since the start.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// The change of the structure that makes up the step that goes on.
    pub(super) fn growing(&self) -> Option<&Edit> {
        let last = self.done.last().filter(|_| self.goes_on)?;
        match last.changes.as_slice() {
            [
                Change {
                    target: Target::Structure,
                    after: Some(Content::Edit(edit)),
                    ..
                },
            ] => Some(edit),
            _ => None,
        }
    }

    /// Puts another change in the place of that one.
    pub(super) fn regrow(&mut self, edit: Edit) {
        self.revision += 1;
        if let Some(change) = self
            .done
            .last_mut()
            .and_then(|last| last.changes.first_mut())
        {
            change.after = Some(Content::Edit(Box::new(edit)));
        }
    }

    /// Takes note of changes that belong together.
    pub(super) fn note(&mut self, what: String, changes: Vec<Change>) {
        self.note_with(what, changes, Vec::new());
    }

    /// The same, with the names of what was chosen before.
    pub(super) fn note_with(&mut self, what: String, changes: Vec<Change>, chosen: Vec<String>) {
        if self.quiet {
            return;
        }
        self.revision += 1;
        // Who goes on working does not wait for what was to be taken back.
        self.heading = None;
        if self.goes_on
            && let Some(last) = self.done.last_mut()
            && last.changes_the_same(&changes)
        {
            for (old, new) in last.changes.iter_mut().zip(changes) {
                old.after = new.after;
            }
            return;
        }
        if changes.iter().all(|change| change.before == change.after) {
            return;
        }
        self.goes_on = true;
        self.undone.clear();
        let scene = changes.iter().any(|change| change.target.is_of_a_scene());
        self.done.push(Step {
            what,
            scene: scene.then(|| self.scene.clone()).flatten(),
            changes,
            chosen,
        });
        if self.done.len() > CAPACITY {
            self.done.remove(0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(parameter: &str, before: f64, after: f64) -> Vec<Change> {
        let content = |number: f64| Some(Content::Setting(SettingValue::Number(number)));
        vec![Change {
            target: Target::Scene {
                parameter: parameter.to_owned(),
            },
            before: content(before),
            after: content(after),
        }]
    }

    #[test]
    fn a_drag_is_one_step_and_what_does_nothing_is_none() {
        let mut undo = Undo::default();
        undo.note("a".to_owned(), change("a", 0.0, 1.0));
        undo.note("a".to_owned(), change("a", 1.0, 2.0));
        assert_eq!(undo.done()[0].changes, change("a", 0.0, 2.0));
        undo.note("b".to_owned(), change("b", 0.0, 1.0));
        undo.seal();
        undo.note("b".to_owned(), change("b", 1.0, 2.0));
        undo.seal();
        undo.note("b".to_owned(), change("b", 2.0, 2.0));
        undo.note("b".to_owned(), change("b", 2.0, 3.0));
        assert_eq!(undo.done()[2].changes, change("b", 1.0, 2.0));
        let what: Vec<&str> = undo.done().iter().map(|step| step.what.as_str()).collect();
        assert_eq!(what, ["a", "b", "b", "b"]);
        for _ in 0..CAPACITY {
            undo.seal();
            undo.note("c".to_owned(), change("c", 0.0, 1.0));
        }
        assert_eq!(undo.done().len(), CAPACITY);
        assert_eq!(undo.done()[0].what, "c", "the oldest are gone");
        undo.clear();
        assert!(undo.done().is_empty() && undo.undone().is_empty());
    }
}
