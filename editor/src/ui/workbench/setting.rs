//! Parameters that a person sets: of the pipeline, of the scene, of behaviours.

use lightbench::script::SettingValue;
use lightbench::world::Entity;

use super::Workbench;
use super::history::Script;
use super::undo::{Change, Content, Target};
use crate::ui::messages::say;

impl Workbench {
    /// Gives a parameter of the selected pipeline a value, or with `None` its default.
    pub fn set_pipeline_parameter(&mut self, parameter: &str, value: Option<SettingValue>) {
        let pipeline = self.pipelines.selected().to_owned();
        let slot = self.pipelines.slot(&pipeline);
        let before = slot.and_then(|slot| slot.settings.get(parameter)).cloned();
        let target = Target::Pipeline {
            pipeline,
            parameter: parameter.to_owned(),
        };
        self.note_setting(target, before, value.clone(), parameter);
        self.change_pipeline_parameter(parameter, value);
    }

    /// Gives a parameter of the selected scene a value, or with `None` its default.
    pub fn set_scene_parameter(&mut self, parameter: &str, value: Option<SettingValue>) {
        let settings = self.scenes.settings();
        let before = settings
            .and_then(|settings| settings.get(parameter))
            .cloned();
        let target = Target::Scene {
            parameter: parameter.to_owned(),
        };
        self.note_setting(target, before, value.clone(), parameter);
        self.change_scene_parameter(parameter, value);
    }

    /// Gives a parameter of an entity's behaviour a value.
    pub fn set_behaviour_parameter(&mut self, entity: Entity, name: &str, value: &SettingValue) {
        let (target, before) = self.behaviour_target(entity, name);
        if let Err(error) = self.change_behaviour(entity, name, value) {
            self.log.error(error);
            return;
        }
        let after = Some(Content::Setting(value.clone()));
        let change = Change {
            target,
            before,
            after,
        };
        self.undo.note(name.to_owned(), vec![change]);
    }

    fn note_setting(
        &mut self,
        target: Target,
        before: Option<SettingValue>,
        after: Option<SettingValue>,
        parameter: &str,
    ) {
        let change = Change {
            target,
            before: before.map(Content::Setting),
            after: after.map(Content::Setting),
        };
        self.undo.note(
            say!("setting.the_parameter", parameter = parameter),
            vec![change],
        );
    }

    pub(super) fn change_pipeline_parameter(
        &mut self,
        parameter: &str,
        value: Option<SettingValue>,
    ) {
        match value {
            Some(value) => self.pipelines.set(parameter, value),
            None => self.pipelines.unset(parameter),
        }
        self.did(
            &format!("pipeline parameter {parameter}"),
            say!("setting.the_pipeline_parameter", parameter = parameter),
        );
    }

    pub(super) fn change_scene_parameter(&mut self, parameter: &str, value: Option<SettingValue>) {
        match value {
            Some(value) => self.scenes.set(parameter, value),
            None => self.scenes.unset(parameter),
        }
        self.did(
            &format!("scene parameter {parameter}"),
            say!("setting.the_scene_parameter", parameter = parameter),
        );
    }

    pub(super) fn change_behaviour(
        &mut self,
        entity: Entity,
        name: &str,
        value: &SettingValue,
    ) -> Result<(), String> {
        let Some(scene) = self.scenes.scene_mut() else {
            return Err(say!("setting.no_scene_is_loaded").to_owned());
        };
        scene.set_behaviour(entity, name, value)?;
        if let Some(line) = scene.behaviour_line(entity) {
            let target = format!("behaviour {entity} {name}");
            let what = say!("setting.the_behaviour_parameter", name = name);
            self.history.add(&target, what, Script::Scene, line);
        }
        Ok(())
    }
}
