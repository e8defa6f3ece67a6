//! Taking back what was changed by hand, and doing it again.

use lightbench::script::SettingValue;
use lightbench::script::overlays::{Edit, Overlays};
use lightbench::world::{Entity, Name, Value};

use super::Workbench;
use crate::ui::messages::say;

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

    /// Forgets all.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Takes note of changes that belong together.
    pub(super) fn note(&mut self, what: String, changes: Vec<Change>) {
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
        self.done.push(Step { what, changes });
        if self.done.len() > CAPACITY {
            self.done.remove(0);
        }
    }
}

impl Workbench {
    /// Takes back the last step. Returns whether there was one.
    pub fn undo(&mut self) -> bool {
        self.undo.seal();
        let Some(step) = self.undo.done.pop() else {
            return false;
        };
        for change in step.changes.iter().rev() {
            self.apply(
                &change.target,
                change.before.as_ref(),
                change.after.as_ref(),
            );
        }
        self.undo.undone.push(step);
        true
    }

    /// Does again what was taken back last. Returns whether there was something.
    pub fn redo(&mut self) -> bool {
        self.undo.seal();
        let Some(step) = self.undo.undone.pop() else {
            return false;
        };
        for change in &step.changes {
            self.apply(
                &change.target,
                change.after.as_ref(),
                change.before.as_ref(),
            );
        }
        self.undo.done.push(step);
        true
    }

    /// Goes to where so many steps are done.
    pub fn go_to_step(&mut self, steps: usize) {
        while self.undo.done.len() > steps && self.undo() {}
        while self.undo.done.len() < steps && self.redo() {}
    }

    /// Takes back the step that goes on, and forgets it.
    pub fn give_up_step(&mut self) {
        if self.undo.goes_on && self.undo() {
            self.undo.undone.pop();
        }
    }

    /// Makes a target what it was or is; `other` is what it is until then.
    fn apply(&mut self, target: &Target, content: Option<&Content>, other: Option<&Content>) {
        let result = match (target, content) {
            (Target::Structure, Some(Content::Edit(edit))) => {
                self.do_edit(edit.as_ref().clone()).map(drop)
            }
            (Target::Structure, _) => match other {
                Some(Content::Edit(edit)) => self.take_back_edit(edit),
                _ => Ok(()),
            },
            (Target::Field { entity, path }, Some(Content::Value(value))) => {
                self.lay_field(entity, path, value)
            }
            (Target::Field { entity, path }, _) => {
                self.lift_field(entity, path);
                Ok(())
            }
            (
                Target::Pipeline {
                    pipeline,
                    parameter,
                },
                content,
            ) => {
                if self.pipelines.selected() != pipeline {
                    self.select_pipeline(pipeline);
                }
                self.change_pipeline_parameter(parameter, setting(content));
                Ok(())
            }
            (Target::Scene { parameter }, content) => {
                self.change_scene_parameter(parameter, setting(content));
                Ok(())
            }
            (
                Target::Behaviour {
                    entity,
                    name,
                    parameter,
                },
                content,
            ) => {
                let entity = self.owner(*entity, name);
                match setting(content) {
                    Some(value) => self.change_behaviour(entity, parameter, &value),
                    None => Ok(()),
                }
            }
        };
        if let Err(error) = result {
            self.log.error(say!("undo.not_changed", error = error));
        }
    }

    /// The entity of a name in a scene that may have been loaded anew; without a name the same one.
    fn owner(&self, entity: Entity, name: &str) -> Entity {
        let named = self.scenes.scene().filter(|_| !name.is_empty());
        named
            .and_then(|scene| scene.world.find(name))
            .unwrap_or(entity)
    }

    /// The target of a behaviour's parameter, and its value.
    pub(super) fn behaviour_target(
        &self,
        entity: Entity,
        parameter: &str,
    ) -> (Target, Option<Content>) {
        let scene = self.scenes.scene();
        let name = scene.and_then(|scene| scene.world.get::<Name>(entity));
        let behaviours = scene.map(lightbench::script::Scene::behaviours);
        let value = behaviours.into_iter().flatten().find_map(|behaviour| {
            let of_it = behaviour.entity == entity;
            let mut all = behaviour.parameters.into_iter().filter(|_| of_it);
            let found = all.find(|known| known.name == parameter)?;
            Some(Content::Setting(found.value))
        });
        let target = Target::Behaviour {
            entity,
            name: name.map_or_else(String::new, |name| name.text),
            parameter: parameter.to_owned(),
        };
        (target, value)
    }

    /// All fields that were changed, with what they were set to, as changes back to the script.
    pub(super) fn lifted(&self) -> Vec<Change> {
        let all = self.overlays_now().into_iter().flat_map(Overlays::iter);
        all.map(|(name, path, overlay)| Change {
            target: Target::Field {
                entity: name.to_owned(),
                path: path.to_owned(),
            },
            before: Some(Content::Value(overlay.value.clone())),
            after: None,
        })
        .collect()
    }
}

fn setting(content: Option<&Content>) -> Option<SettingValue> {
    match content {
        Some(Content::Setting(value)) => Some(value.clone()),
        _ => None,
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
