//! What somebody did, as the line of a script that does the same.
//!
//! Lines of scene scripts are those that a scene's own file may have at its end. What no scene script
//! can say, as which pipeline draws and when, is a line of an experiment.

use lightbench_world::glam::Vec3;
use lightbench_world::{Behaviour, Camera, Entity, Name, Value};

use crate::experiment::Shot;
use crate::scene::Scene;
use crate::scene::overlays::{spell_point, spell_single};
use crate::settings::{SettingValue, Settings};
use crate::spelling::{spell_number, spell_text};

/// The line of an experiment that draws a frame, as in
/// `let frame = draw("atrium", "deferred_shading", #{ size: [640, 360], frame: 3 });`.
#[must_use]
pub fn draw_line(shot: &Shot) -> String {
    let (width, height) = shot.size;
    let mut options = vec![format!("size: [{width}, {height}]")];
    if shot.frame > 0 {
        options.push(format!("frame: {}", shot.frame));
    }
    for (name, settings) in [
        ("scene", &shot.scene_settings),
        ("pipeline", &shot.pipeline_settings),
    ] {
        if !settings.is_empty() {
            options.push(format!("{name}: {}", map(settings)));
        }
    }
    format!(
        "let frame = draw({}, {}, #{{ {} }});",
        spell_text(&shot.scene),
        spell_text(&shot.pipeline),
        options.join(", ")
    )
}

/// Values of parameters as a script writes them.
fn map(settings: &Settings) -> String {
    let entry = |(name, value): (&str, &SettingValue)| {
        let plain = name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let name = if plain {
            name.to_owned()
        } else {
            spell_text(name)
        };
        let value = match value {
            SettingValue::Text(text) => spell_text(text),
            SettingValue::Switch(on) => on.to_string(),
            // Whole numbers without a point, as people write them.
            SettingValue::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => {
                format!("{number:.0}")
            }
            SettingValue::Number(number) => spell_number(*number),
        };
        format!("{name}: {value}")
    };
    let entries: Vec<String> = settings.iter().map(entry).collect();
    format!("#{{ {} }}", entries.join(", "))
}

impl Scene {
    /// The line of a scene script that puts the scene's camera at a point and turns it to another one,
    /// both in the world. `None` where the scene has no camera.
    #[must_use]
    pub fn camera_line(&self, eye: Vec3, target: Vec3) -> Option<String> {
        let camera = self.camera()?;
        // In the world, whatever moves its parent.
        let detach = match self.world.parent(camera) {
            Some(_) => ".detach()",
            None => "",
        };
        let (eye, target) = (spell_point(eye), spell_point(target));
        if self.default_camera == Some(camera) {
            // The script makes none yet.
            let Camera { near, far, .. } = self.world.get(camera)?;
            let (near, far) = (spell_single(near), spell_single(far));
            return Some(format!(
                "camera(\"camera\").at({eye}).look_at({target}).near({near}).far({far});"
            ));
        }
        let camera = self.spelled(camera);
        Some(format!("{camera}{detach}.at({eye}).look_at({target});"))
    }

    /// How a script finds a camera.
    fn spelled(&self, camera: Entity) -> String {
        match self.world.get::<Name>(camera) {
            Some(name) if self.world.find(&name.text) == Some(camera) => {
                format!("entity({})", spell_text(&name.text))
            }
            _ => "entities().with(\"camera.active\", true)[0]".to_owned(),
        }
    }

    /// The line of a scene script that gives an entity the behaviour that it has, with the values that
    /// its parameters have. `None` where it has none, or can't be found by its name.
    #[must_use]
    pub fn behaviour_line(&self, entity: Entity) -> Option<String> {
        let behaviour: Behaviour = self.world.get(entity)?;
        let name: Name = self.world.get(entity)?;
        if self.world.find(&name.text) != Some(entity) {
            return None;
        }
        let mut values = Settings::new();
        for (name, value) in &behaviour.parameters.0 {
            match value {
                Value::Bool(on) => values.set(name, *on),
                Value::Int(whole) => values.set(name, *whole as f64),
                Value::Float(number) => values.set(name, f64::from(*number)),
                Value::Text(text) => values.set(name, text.clone()),
                _ => return None,
            }
        }
        Some(format!(
            "entity({}).behave({}, {});",
            spell_text(&name.text),
            spell_text(&behaviour.script),
            map(&values)
        ))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::sync::{Arc, Mutex};

    use lightbench_assets::Progress;
    use lightbench_render::inspect::{FirstInvalid, Part, PixelValue, Shown};
    use lightbench_render::{PipelineDesc, TargetImage, View};

    use super::*;
    use crate::testing::project;
    use crate::{
        Chart, Cost, Laboratory, LaboratoryError, StudyRow, StudyTask, Task, load_scene,
        run_experiment,
    };

    /// Notes what it is asked to draw, and draws nothing.
    struct Notes(Arc<Mutex<Vec<Shot>>>);

    impl Laboratory for Notes {
        fn draw(&mut self, shot: &Shot) -> Result<PipelineDesc, LaboratoryError> {
            self.0.lock().unwrap().push(shot.clone());
            Ok(PipelineDesc::default())
        }

        fn target(
            &mut self,
            _: &Shot,
            _: usize,
            _: &str,
            _: Part,
        ) -> Result<TargetImage, LaboratoryError> {
            Err(LaboratoryError::Other(String::new()))
        }

        fn pixel(&mut self, _: &Shot, _: (u32, u32)) -> Result<Vec<PixelValue>, LaboratoryError> {
            Ok(Vec::new())
        }

        fn first_invalid(&mut self, _: &Shot) -> Result<Option<FirstInvalid>, LaboratoryError> {
            Ok(None)
        }

        fn values(&mut self, _: &Shot, _: &str) -> Result<Vec<f64>, LaboratoryError> {
            Ok(Vec::new())
        }

        fn study(&mut self, _: &StudyTask) -> Result<Vec<StudyRow>, LaboratoryError> {
            Err(LaboratoryError::Other("no studies".into()))
        }

        fn measure(&mut self, _: &Task) -> Result<Vec<Cost>, LaboratoryError> {
            Ok(Vec::new())
        }

        fn compare(
            &self,
            _: &TargetImage,
            _: &TargetImage,
        ) -> Result<Vec<(&'static str, f64)>, LaboratoryError> {
            Ok(Vec::new())
        }

        fn plot(&self, _: &Chart) -> Vec<u8> {
            Vec::new()
        }

        fn encode(&self, _: &str, _: &TargetImage, _: Shown) -> Result<Vec<u8>, LaboratoryError> {
            Ok(Vec::new())
        }
    }

    #[test]
    fn the_line_of_an_experiment_draws_the_same_shot() {
        let settings = Settings::new()
            .with("lights", 64.0)
            .with("speed", 0.1)
            .with("on", true)
            .with("a name", "a \"text\"");
        for (scene_settings, pipeline_settings, frame) in [
            (Settings::new(), Settings::new(), 0),
            (settings.clone(), Settings::new(), 7),
            (Settings::new(), settings, 1),
        ] {
            let shot = Shot {
                scene: "cornell_box".to_owned(),
                scene_settings,
                pipeline: "scripts/pipelines/deferred_shading.rhai".to_owned(),
                pipeline_settings,
                size: (683, 359),
                frame,
            };
            let line = draw_line(&shot);
            let (_folder, files) = project(&[("scripts/experiments/test.rhai", &line)]);
            let drawn: Arc<Mutex<Vec<Shot>>> = Arc::default();
            let laboratory = Notes(Arc::clone(&drawn));
            let (none, progress) = (Settings::new(), Progress::new());
            run_experiment(
                &files,
                "test",
                &none,
                Box::new(laboratory),
                |_| {},
                &progress,
            )
            .unwrap();
            let drawn = drawn.lock().unwrap();
            // A map has no order.
            let sorted = |settings: &Settings| {
                let mut all: Vec<String> =
                    settings.iter().map(|(n, v)| format!("{n} {v:?}")).collect();
                all.sort();
                all
            };
            assert_eq!(
                sorted(&drawn[0].scene_settings),
                sorted(&shot.scene_settings)
            );
            assert_eq!(
                sorted(&drawn[0].pipeline_settings),
                sorted(&shot.pipeline_settings)
            );
            let plain = |shot: &Shot| {
                (
                    shot.scene.clone(),
                    shot.pipeline.clone(),
                    shot.size,
                    shot.frame,
                )
            };
            assert_eq!(plain(&drawn[0]), plain(&shot), "{line}");
        }
    }

    #[test]
    fn the_line_of_the_camera_gives_the_same_view() {
        let scene = |script: &str| {
            let (_folder, files) = project(&[("scripts/scenes/test.rhai", script)]);
            load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap()
        };
        let (eye, target) = (Vec3::new(1.1, 2.2, 3.3), Vec3::new(-4.0, 0.5, 1.0e-3));
        for script in [
            "spawn(\"ball\").mesh(sphere(1));",
            "camera(\"eye\").at(0, 0, 9).fov(40);",
            "camera().at(0, 0, 9).active(false); camera().fov(30);",
            "camera(\"eye\").parent(spawn().at(5, 5, 5).turn(20, 30, 40));",
        ] {
            let line = scene(script).camera_line(eye, target).unwrap();
            let moved = scene(&format!("{script}\n{line}"));
            let view = View::from_world(&moved.world).unwrap();
            let expected = View::look_at(eye, target, view.fov_y, view.near, view.far);
            assert!(view.view.abs_diff_eq(expected.view, 1e-5), "{line}");
            let before = View::from_world(&scene(script).world).unwrap();
            let lens = |view: &View| (view.fov_y, view.near, view.far);
            assert_eq!(lens(&view), lens(&before), "{line}");
        }
    }

    #[test]
    fn the_line_of_a_behaviour_gives_the_same_one() {
        let scene = |line: &str| {
            let script = format!("spawn(\"globe\").behave(\"spin\", #{{ speed: 20 }}); {line}");
            let (_folder, files) = project(&[
                ("scripts/scenes/test.rhai", &script),
                (
                    "scripts/behaviours/spin.rhai",
                    "const S = param(\"speed\", 1.5, 0, 90); const A = param(\"axis\", [\"x\", \"y\"]);",
                ),
            ]);
            load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap()
        };
        let mut set = scene("");
        let globe = set.world.find("globe").unwrap();
        set.set_behaviour(globe, "speed", &33.3.into()).unwrap();
        set.update(0.0, 0.0).unwrap();
        set.set_behaviour(globe, "axis", &"y".into()).unwrap();
        set.update(0.0, 0.0).unwrap();
        let line = set.behaviour_line(globe).unwrap();
        let mut written = scene(&line);
        written.update(0.0, 0.0).unwrap();
        let values = |scene: &Scene| {
            let parameters = scene.behaviours()[0].parameters.clone();
            let values = parameters.into_iter().map(|p| (p.name, p.value));
            values.collect::<Vec<_>>()
        };
        assert_eq!(values(&written), values(&set), "{line}");
    }
}
