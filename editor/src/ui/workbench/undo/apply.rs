//! Making what was changed what it was, or is.

use lightbench::script::SettingValue;
use lightbench::script::overlays::Overlays;
use lightbench::world::{Entity, Name};

use super::super::Workbench;
use super::{Change, Content, Target};
use crate::ui::messages::say;

impl Workbench {
    /// Makes a target what it was or is; `other` is what it is until then.
    pub(super) fn apply(
        &mut self,
        target: &Target,
        content: Option<&Content>,
        other: Option<&Content>,
    ) {
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
            (Target::Place(_), Some(Content::Place(place))) => {
                self.stand_at(place);
                Ok(())
            }
            (Target::Dials(_), Some(Content::Dials(dials))) => {
                self.set_dials(*dials);
                Ok(())
            }
            (Target::Moment(_), Some(Content::Moment(moment))) => {
                self.go_to_moment(moment);
                Ok(())
            }
            (Target::Entry(_), Some(Content::Entry(entry))) => {
                self.bring_entry_back(entry);
                Ok(())
            }
            (Target::Entry(name), _) => {
                self.delete_entry(name);
                Ok(())
            }
            (Target::Note(name), Some(Content::Text(note))) => {
                self.set_note(name, note);
                Ok(())
            }
            (Target::NumberKeys, Some(Content::NumberKeys(keys))) => {
                self.undo.number_keys = Some(keys.clone());
                Ok(())
            }
            (
                Target::Place(_)
                | Target::Dials(_)
                | Target::Moment(_)
                | Target::Note(_)
                | Target::NumberKeys,
                _,
            ) => Ok(()),
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
    pub(in crate::ui::workbench) fn behaviour_target(
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
    pub(in crate::ui::workbench) fn lifted(&self) -> Vec<Change> {
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
