//! What a person changes by hand: fields of entities, and by lines of the console.

use lightbench::render::Problem;
use lightbench::script::LogLine;
use lightbench::script::overlays::{Overlays, line};
use lightbench::world::{Entity, Value};

use super::Workbench;
use super::history::Script;
use super::log::Level;
use super::undo::{Change, Content, Target};
use crate::ui::messages::say;

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
        let name = self.name_kept(entity)?;
        self.set_fields(
            &say!("hand.field_of", path = path, name = name),
            &[(entity, path, value)],
        )
    }

    /// Changes fields of entities by hand, in one step that `what` names.
    ///
    /// # Errors
    /// A sentence that says why one can't be changed. Those before it are.
    pub fn set_fields(
        &mut self,
        what: &str,
        fields: &[(Entity, &str, Value)],
    ) -> Result<(), String> {
        let (changes, result) = self.change_fields(fields);
        self.undo.note(what.to_owned(), changes);
        result
    }

    /// Changes a field as a part of a step.
    pub(super) fn change_field(
        &mut self,
        entity: Entity,
        path: &str,
        value: Value,
    ) -> Result<Change, String> {
        let (mut changes, result) = self.change_fields(&[(entity, path, value)]);
        result?;
        changes
            .pop()
            .ok_or_else(|| say!("hand.no_scene_is_loaded").to_owned())
    }

    /// Changes fields, those before the first that can't be.
    fn change_fields(
        &mut self,
        fields: &[(Entity, &str, Value)],
    ) -> (Vec<Change>, Result<(), String>) {
        let shown = self.scenes.shown().unwrap_or_default().to_owned();
        let Some(scene) = self.scenes.scene_mut() else {
            return (Vec::new(), Err(say!("hand.no_scene_is_loaded").to_owned()));
        };
        let entities: Vec<Entity> = fields.iter().map(|(entity, ..)| *entity).collect();
        let names = match scene.keep_names(&entities) {
            Ok(names) => names,
            Err(why) => return (Vec::new(), Err(why)),
        };
        let overlays = self.overlays.entry(shown).or_default();
        let content = |overlays: &Overlays, name: &str, path: &str| {
            let overlay = overlays.get(name, path)?;
            Some(Content::Value(overlay.value.clone()))
        };
        let before: Vec<Option<Content>> = fields
            .iter()
            .zip(&names)
            .map(|((_, path, _), name)| content(overlays, name, path))
            .collect();
        let (count, result) = overlays.set_many(scene, fields);
        let mut changes = Vec::with_capacity(count);
        for (((_, path, value), name), before) in fields.iter().zip(names).zip(before).take(count) {
            self.note_field(&name, path, value, say!("hand.changed_by_hand"));
            changes.push(Change {
                target: Target::Field {
                    entity: name,
                    path: (*path).to_owned(),
                },
                before,
                after: Some(Content::Value(value.clone())),
            });
        }
        self.canvas.invalidate();
        (changes, result)
    }

    fn name_kept(&self, entity: Entity) -> Result<String, String> {
        let scene = self.scenes.scene();
        let scene = scene.ok_or_else(|| say!("hand.no_scene_is_loaded").to_owned())?;
        scene.keeps_by_name(entity)
    }

    /// Lays a value over a field.
    pub(super) fn lay_field(
        &mut self,
        entity: &str,
        path: &str,
        value: &Value,
    ) -> Result<(), String> {
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        let overlays = self.overlays.entry(name).or_default();
        let Some(scene) = self.scenes.scene_mut() else {
            return Err(say!("hand.no_scene_is_loaded").to_owned());
        };
        overlays.lay_again(scene, entity, path, value.clone())?;
        self.note_field(entity, path, value, say!("hand.changed_by_hand"));
        self.canvas.invalidate();
        Ok(())
    }

    /// Gives a field back to the scene's script.
    pub fn reset_field(&mut self, entity: &str, path: &str) {
        self.reset_fields(&[entity.to_owned()], Some(path));
    }

    /// Gives a field of entities back to the scene's script, or without a path all of their fields.
    pub fn reset_fields(&mut self, entities: &[String], path: Option<&str>) {
        let mut changes = self.lifted();
        let is_one = |entity: &String| entities.contains(entity);
        changes.retain(|change| match &change.target {
            Target::Field { entity, path: own } => {
                is_one(entity) && path.is_none_or(|path| own == path)
            }
            _ => false,
        });
        let whose = match entities {
            [one] => one.clone(),
            all => say!("hand.entities", all = all.len()),
        };
        let what = match path {
            Some(path) => say!("hand.of_back_to_the_script", path = path, whose = whose),
            None => say!("hand.back_to_the_script", whose = whose),
        };
        self.lift(what, changes);
    }

    /// Gives everything back to the scene's script.
    pub fn reset_all_fields(&mut self) {
        let mut changes = self.lifted();
        for change in &changes {
            if let Target::Field { entity, path } = &change.target {
                self.lift_field(entity, path);
            }
        }
        changes.extend(self.lift_structure());
        self.undo.seal();
        self.undo
            .note(say!("hand.all_back_to_the_script").to_owned(), changes);
        self.undo.seal();
    }

    fn lift(&mut self, what: String, changes: Vec<Change>) {
        for change in &changes {
            if let Target::Field { entity, path } = &change.target {
                self.lift_field(entity, path);
            }
        }
        self.undo.seal();
        self.undo.note(what, changes);
        self.undo.seal();
    }

    pub(super) fn lift_field(&mut self, entity: &str, path: &str) {
        let script = self.overlays_now().and_then(|overlays| {
            let overlay = overlays.get(entity, path)?;
            overlay.script.clone()
        });
        self.on_overlays(|overlays, scene| {
            overlays.reset(scene, entity, path);
        });
        if let Some(script) = script {
            self.note_field(entity, path, &script, say!("hand.back_to_the_script_value"));
        }
    }

    /// All that was changed by hand, as lines for the end of the scene's script.
    pub fn overlay_lines(&self) -> String {
        let edits = self.overlays_now().into_iter().flat_map(Overlays::edits);
        let edits = edits.map(|(edit, _)| {
            let line = edit.line();
            line.unwrap_or_else(|| say!("hand.scripts_have_no_words_for_it", words = edit.words()))
        });
        let all = self.overlays_now().into_iter().flat_map(Overlays::iter);
        let lines = all.filter_map(|(entity, path, overlay)| line(entity, path, &overlay.value));
        edits.chain(lines).collect::<Vec<_>>().join("\n")
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
            let what = say!(
                "hand.field_of_entity_what",
                path = path,
                entity = entity,
                what = what
            );
            self.history.add(&target, what, Script::Scene, line);
        }
    }

    /// Runs a line as scene script on the scene on screen. `None` where there is no scene.
    pub fn evaluate(&mut self, line: &str) -> Option<Evaluated> {
        let before = self.text_of_scene()?;
        let what = say!("history.console", line = line.trim());
        self.as_moment("console", &what, |this| {
            let evaluated = this.evaluate_now(line);
            // A line without a value has set something that scripts remember.
            let is_silent = |it: &Evaluated| matches!(it.result, Ok(None)) && it.printed.is_empty();
            let works = evaluated.as_ref().is_some_and(|it| it.result.is_ok());
            let silent = evaluated.as_ref().is_some_and(is_silent);
            let changed = silent || works && this.text_of_scene() != Some(before);
            (evaluated, changed)
        })
    }

    /// The scene on screen as its file would have it; `None` where there is none, empty where it has no
    /// words for something.
    fn text_of_scene(&mut self) -> Option<String> {
        let scene = self.scenes.scene_mut()?;
        Some(scene.to_text().unwrap_or_default())
    }

    fn evaluate_now(&mut self, line: &str) -> Option<Evaluated> {
        let scene = self.scenes.scene_mut()?;
        let result = scene.evaluate(line);
        let printed = scene.take_log();
        for line in &printed {
            let text = line.text.clone();
            self.log.add(Level::Script, Some(line.place.clone()), text);
        }
        match &result {
            Ok(_) => {
                let what = say!("hand.typed_into_the_console");
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
