//! What a person changes by hand: fields of entities, parameters, lines of the console.

use lightbench::render::Problem;
use lightbench::script::overlays::{Overlays, line};
use lightbench::script::{LogLine, SettingValue};
use lightbench::world::{Entity, Value};

use super::Workbench;
use super::history::Script;
use super::log::Level;

/// What came of a line of the console.
#[derive(Debug)]
pub struct Evaluated {
    /// What it printed.
    pub printed: Vec<LogLine>,
    /// Its value, or what is wrong with it.
    pub result: Result<Option<String>, Problem>,
}

impl Workbench {
    /// What lies over the script of the scene on screen.
    pub fn overlays_now(&self) -> Option<&Overlays> {
        self.overlays.get(self.scenes.shown()?)
    }

    /// Changes a field of an entity by hand.
    ///
    /// # Errors
    /// A sentence that says why it can't be.
    pub fn set_field(&mut self, entity: Entity, path: &str, value: Value) -> Result<(), String> {
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        let overlays = self.overlays.entry(name).or_default();
        let Some(scene) = self.scenes.scene_mut() else {
            return Err("no scene is loaded".to_owned());
        };
        overlays.set(scene, entity, path, value.clone())?;
        let name = scene.keeps_by_name(entity)?;
        self.note_field(&name, path, &value, "changed by hand");
        self.canvas.invalidate();
        Ok(())
    }

    /// Gives a field back to the scene's script.
    pub fn reset_field(&mut self, entity: &str, path: &str) {
        let script = self.overlays_now().and_then(|overlays| {
            let overlay = overlays.get(entity, path)?;
            overlay.script.clone()
        });
        self.on_overlays(|overlays, scene| {
            overlays.reset(scene, entity, path);
        });
        if let Some(script) = script {
            self.note_field(entity, path, &script, "back to the script's value");
        }
    }

    /// Gives all fields of an entity back to the scene's script.
    pub fn reset_entity(&mut self, entity: &str) {
        for (_, path) in self.fields_of(Some(entity)) {
            self.reset_field(entity, &path);
        }
    }

    /// Gives everything back to the scene's script.
    pub fn reset_all_fields(&mut self) {
        for (entity, path) in self.fields_of(None) {
            self.reset_field(&entity, &path);
        }
    }

    /// All that was changed by hand, as lines for the end of the scene's script.
    pub fn overlay_lines(&self) -> String {
        let all = self.overlays_now().into_iter().flat_map(Overlays::iter);
        let lines = all.filter_map(|(entity, path, overlay)| line(entity, path, &overlay.value));
        lines.collect::<Vec<_>>().join("\n")
    }

    fn fields_of(&self, entity: Option<&str>) -> Vec<(String, String)> {
        let all = self.overlays_now().into_iter().flat_map(Overlays::iter);
        all.filter(|(name, ..)| entity.is_none_or(|entity| *name == entity))
            .map(|(name, path, _)| (name.to_owned(), path.to_owned()))
            .collect()
    }

    pub(super) fn on_overlays(
        &mut self,
        change: impl FnOnce(&mut Overlays, &mut lightbench::script::Scene),
    ) {
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        if let (Some(overlays), Some(scene)) =
            (self.overlays.get_mut(&name), self.scenes.scene_mut())
        {
            change(overlays, scene);
            self.canvas.invalidate();
        }
    }

    fn note_field(&mut self, entity: &str, path: &str, value: &Value, what: &str) {
        if let Some(line) = line(entity, path, value) {
            let target = format!("field {entity} {path}");
            let what = format!("{path} of {entity}, {what}");
            self.history.add(&target, what, Script::Scene, line);
        }
    }

    /// Gives a parameter of the selected pipeline a value, or with `None` its default.
    pub fn set_pipeline_parameter(&mut self, parameter: &str, value: Option<SettingValue>) {
        match value {
            Some(value) => self.pipelines.set(parameter, value),
            None => self.pipelines.unset(parameter),
        }
        self.did(
            &format!("pipeline parameter {parameter}"),
            format!("the pipeline's parameter {parameter}"),
        );
    }

    /// Gives a parameter of the selected scene a value, or with `None` its default.
    pub fn set_scene_parameter(&mut self, parameter: &str, value: Option<SettingValue>) {
        match value {
            Some(value) => self.scenes.set(parameter, value),
            None => self.scenes.unset(parameter),
        }
        self.did(
            &format!("scene parameter {parameter}"),
            format!("the scene's parameter {parameter}"),
        );
    }

    /// Gives a parameter of an entity's behaviour a value.
    pub fn set_behaviour_parameter(&mut self, entity: Entity, name: &str, value: &SettingValue) {
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        if let Err(error) = scene.set_behaviour(entity, name, value) {
            self.log.error(error);
        } else if let Some(line) = scene.behaviour_line(entity) {
            let target = format!("behaviour {entity} {name}");
            let what = format!("the behaviour's parameter {name}");
            self.history.add(&target, what, Script::Scene, line);
        }
    }

    /// Runs a line as scene script on the scene on screen. `None` where there is no scene.
    pub fn evaluate(&mut self, line: &str) -> Option<Evaluated> {
        let scene = self.scenes.scene_mut()?;
        let result = scene.evaluate(line);
        let printed = scene.take_log();
        for line in &printed {
            let text = line.text.clone();
            self.log.add(Level::Script, Some(line.place.clone()), text);
        }
        match &result {
            Ok(_) => {
                let what = "typed into the console";
                self.history.add("", what, Script::Scene, line.to_owned());
            }
            Err(problem) => self.log.problem(problem),
        }
        // What lies over the script lies over such lines too.
        self.on_overlays(|overlays, scene| overlays.follow(scene));
        self.canvas.invalidate();
        Some(Evaluated { printed, result })
    }
}
