//! What a person did, each as the line of a script that does the same.

use std::collections::VecDeque;

use lightbench::render::View;
use lightbench::script::{Settings, Shot, draw_line};
use lightbench::world::glam::Vec3;

use super::Workbench;
use super::clock::STEP;
use crate::ui::messages::say;

/// The kind of script that a line belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Script {
    /// A scene script, at its end.
    Scene,
    /// An experiment.
    Experiment,
}

impl Script {
    /// Its name in a comment.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scene => say!("history.scene_script"),
            Self::Experiment => say!("history.experiment"),
        }
    }
}

/// One thing that was done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deed {
    /// What it changed. The next deed that changes the same takes its place.
    target: String,
    /// What was done, in words.
    pub what: String,
    /// Where the line belongs.
    pub script: Script,
    /// The line.
    pub line: String,
}

impl Deed {
    /// The line with a comment that says where it belongs and what it does.
    pub fn copied(&self) -> String {
        format!("{} // {}: {}", self.line, self.script.name(), self.what)
    }
}

/// Deeds kept; older ones are dropped.
const CAPACITY: usize = 500;

/// What was done, oldest first.
#[derive(Debug, Default)]
pub struct History {
    deeds: VecDeque<Deed>,
}

impl History {
    /// Adds a deed. One that changes the same as the last takes its place, so that the way of a
    /// slider is one deed.
    pub fn add(&mut self, target: &str, what: impl Into<String>, script: Script, line: String) {
        let deed = Deed {
            target: target.to_owned(),
            what: what.into(),
            script,
            line,
        };
        match self.deeds.back_mut() {
            Some(last) if !target.is_empty() && last.target == target => *last = deed,
            _ => self.deeds.push_back(deed),
        }
        if self.deeds.len() > CAPACITY {
            self.deeds.pop_front();
        }
    }

    /// The deeds, oldest first.
    pub fn deeds(&self) -> impl DoubleEndedIterator<Item = &Deed> + ExactSizeIterator {
        self.deeds.iter()
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.deeds.clear();
    }
}

impl Workbench {
    /// The frame on screen, as an experiment draws it.
    pub fn shot(&self) -> Shot {
        let pipeline = self.pipelines.selected().to_owned();
        let slot = self.pipelines.slot(&pipeline);
        Shot {
            scene: self.scenes.selected().to_owned(),
            scene_settings: self.scenes.settings().cloned().unwrap_or_default(),
            pipeline_settings: slot.map_or_else(Settings::new, |slot| slot.settings.clone()),
            pipeline,
            size: self.drawn_size().unwrap_or((640, 360)),
            frame: (self.clock.time() / STEP).round() as u32,
        }
    }

    /// Takes note of something that scene scripts can't do: the line draws the frame that is on screen
    /// then.
    pub(super) fn did(&mut self, target: &str, what: impl Into<String>) {
        let line = draw_line(&self.shot());
        self.history.add(target, what, Script::Experiment, line);
    }

    /// Takes note of where a person has moved the camera, as soon as it moved.
    pub(super) fn note_camera(&mut self) {
        if self.camera.flat().is_some() {
            // No camera of a script sees without perspective.
            return;
        }
        let moved = self.camera.is_moved();
        let view = moved.then(|| self.camera.view());
        if view == self.noted_view {
            return;
        }
        let first: Option<View> = std::mem::replace(&mut self.noted_view, view);
        let Some(scene) = self.scenes.scene() else {
            return;
        };
        if moved {
            let (eye, pivot) = (self.camera.position(), self.camera.pivot());
            if let Some(line) = scene.camera_line(eye, pivot) {
                let what = say!("history.the_camera_if_the_script_does");
                self.history.add("camera", what, Script::Scene, line);
            }
        } else if let Some(before) = first {
            let home = self.camera.view();
            let ahead = |view: &View| -view.view.inverse().z_axis.truncate();
            // A view that ends where it began was no deed.
            let same = before.view.abs_diff_eq(home.view, 1e-6);
            let target: Vec3 = home.position() + ahead(&home);
            if let Some(line) = scene.camera_line(home.position(), target).filter(|_| !same) {
                let what = say!("history.the_scene_own_camera_again");
                self.history.add("camera", what, Script::Scene, line);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_of_a_slider_is_one_deed() {
        let mut history = History::default();
        for (target, line) in [("a", "1"), ("a", "2"), ("b", "3"), ("", "4"), ("", "5")] {
            history.add(target, "it", Script::Scene, line.to_owned());
        }
        let lines: Vec<&str> = history.deeds().map(|deed| deed.line.as_str()).collect();
        assert_eq!(lines, ["2", "3", "4", "5"]);
        let copied = history.deeds().next().map(Deed::copied);
        assert_eq!(copied.as_deref(), Some("2 // scene script: it"));
        for _ in 0..CAPACITY {
            history.add("", "it", Script::Experiment, String::new());
        }
        assert_eq!(history.deeds().len(), CAPACITY);
        history.clear();
        assert_eq!(history.deeds().len(), 0);
    }
}
