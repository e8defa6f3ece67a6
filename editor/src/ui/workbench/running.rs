//! A step of the scene, and what its scripts ask of the editor.

use lightbench::render::problem::Problems;
use lightbench::script::overlays::Overlays;
use lightbench::script::{PipelineChoice, Scene};

use super::Workbench;
use super::log::Level;

impl Workbench {
    /// Lets the scene's script and systems move things; a mistake stops time and shows.
    pub(super) fn update_scene(&mut self, step: f64) {
        let Some(scene) = self.scenes.scene_mut() else {
            self.clock.refresh();
            return;
        };
        let result = scene.update(self.clock.time(), step);
        self.timings.stepped(scene.system_times());
        let still_moves = scene.moves();
        for line in scene.take_log() {
            self.log.add(Level::Script, Some(line.place), line.text);
        }
        self.follow_pipeline_choice();
        self.on_overlays(Overlays::follow);
        if let Err(problem) = result {
            self.ran_into_a_problem = true;
            self.log.problem(&problem);
            self.scenes.set_problems(Some(Problems(vec![problem])));
            // One behaviour may fail and the others go on.
            self.clock.playing &= still_moves;
        }
        self.canvas.invalidate();
    }

    /// Whether keys over the picture are for the scene's scripts: they hear some, and time runs.
    pub fn scene_wants_keys(&self) -> bool {
        self.clock.playing && self.scenes.scene().is_some_and(Scene::hears_keys)
    }

    /// Swaps to the pipeline that the scene's scripts ask for.
    pub(super) fn follow_pipeline_choice(&mut self) {
        let choice = self
            .scenes
            .scene_mut()
            .and_then(Scene::take_pipeline_choice);
        let Some(PipelineChoice { name, settings }) = choice else {
            return;
        };
        let before = self.pipelines.shown().map(str::to_owned);
        // A script may ask in each step; what is so already is not built again.
        let slot = self.pipelines.slot(&name);
        let is_so = slot.is_some_and(|slot| slot.settings == settings);
        match (is_so, self.pipelines.selected() == name) {
            (true, true) => {}
            (true, false) => self.pipelines.select(&name),
            (false, _) => self.pipelines.select_with(&name, settings),
        }
        self.pipeline_shown(before.as_deref());
    }
}
