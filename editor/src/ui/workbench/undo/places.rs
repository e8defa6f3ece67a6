//! Where the editor stands: the scene, the pipelines of both sides and their values.

use lightbench::script::Settings;

use super::super::Workbench;
use super::super::pipelines::Pipelines;
use super::super::viewing::Arriving;
use super::super::viewports::Viewport;
use super::{Change, Content, Target};
use crate::ui::messages::say;
use crate::viewpoint::Eye;
use crate::viewpoint::moment::Steps;

/// A pipeline with the values that somebody gave to its parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chosen {
    /// Its name.
    pub name: String,
    /// Its values.
    pub settings: Settings,
}

impl Chosen {
    fn of(pipelines: &Pipelines) -> Self {
        let name = pipelines.selected().to_owned();
        let settings = pipelines.slot(&name).map(|slot| slot.settings.clone());
        Self {
            name,
            settings: settings.unwrap_or_default(),
        }
    }

    /// Makes it the pipeline that is chosen.
    pub(in crate::ui::workbench) fn choose(&self, pipelines: &mut Pipelines) {
        if pipelines.selected() != self.name {
            pipelines.select(&self.name);
        }
        let slot = pipelines.slot(&self.name);
        if slot.is_none_or(|slot| slot.settings != self.settings) {
            pipelines.set_all(&self.name, self.settings.clone());
        }
    }
}

/// From where and when a scene was seen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    eye: Eye,
    time: f64,
    playing: bool,
}

/// Where the editor stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The scene.
    pub scene: String,
    /// Values of its parameters.
    pub scene_settings: Settings,
    /// The pipeline.
    pub pipeline: Chosen,
    /// That of B, once something was compared.
    pub other: Option<Chosen>,
    /// Whether two are compared.
    pub compares: bool,
    /// How the scene is seen, where it is loaded on the way back.
    pub(super) seen: Option<Seen>,
}

impl Workbench {
    /// Where the editor stands, with how the scene is seen where that counts.
    pub(super) fn place(&self, seen: bool) -> Place {
        let seen = seen.then(|| Seen {
            eye: self.eye(Viewport::First),
            time: self.clock.time(),
            playing: self.clock.playing,
        });
        Place {
            scene: self.scenes.selected().to_owned(),
            scene_settings: self.scenes.settings().cloned().unwrap_or_default(),
            pipeline: Chosen::of(&self.pipelines),
            other: self
                .comparing
                .side()
                .map(|side| Chosen::of(&side.pipelines)),
            compares: self.comparing.is_on(),
            seen,
        }
    }

    /// Chooses scenes or pipelines as a step. `name` tells it from other steps, which are not merged with
    /// it; `moves` says whether the camera and the time are of the step.
    pub(in crate::ui::workbench) fn as_place<T>(
        &mut self,
        name: &str,
        what: &str,
        moves: bool,
        change: impl FnOnce(&mut Self) -> T,
    ) -> T {
        if self.undo.quiet {
            return change(self);
        }
        let before = self.place(moves);
        if moves {
            self.undo.seal();
        }
        self.undo.quiet = true;
        let result = change(self);
        self.undo.quiet = false;
        let after = self.place(moves);
        let same = Place {
            seen: None,
            ..before.clone()
        } == Place {
            seen: None,
            ..after.clone()
        };
        if same && !(moves && self.is_arriving()) {
            return result;
        }
        let change = Change {
            target: Target::Place(name.to_owned()),
            before: Some(Content::Place(Box::new(before))),
            after: Some(Content::Place(Box::new(after))),
        };
        self.undo.note(what.to_owned(), vec![change]);
        result
    }

    /// Goes to where the editor stood.
    pub(super) fn stand_at(&mut self, place: &Place) {
        let shown = self.pipelines.shown().map(str::to_owned);
        let other = self
            .comparing
            .side()
            .map(|side| Chosen::of(&side.pipelines));
        let swapped = other.as_ref() == Some(&place.pipeline)
            && place.other.as_ref() == Some(&Chosen::of(&self.pipelines));
        if swapped && self.comparing.is_on() && place.compares && other != place.other {
            // Both are warm.
            self.swap_sides();
        }
        if Chosen::of(&self.pipelines) != place.pipeline {
            place.pipeline.choose(&mut self.pipelines);
            self.pipeline_shown(shown.as_deref());
            let name = &place.pipeline.name;
            self.did("pipeline", say!("workbench.the_pipeline", name = name));
        }
        if let Some(other) = &place.other {
            self.choose_other(other);
        }
        self.compare(place.compares);
        self.canvas.invalidate();
        let settings = self.scenes.settings().cloned().unwrap_or_default();
        let same = place.scene == self.scenes.selected() && place.scene_settings == settings;
        let Some(seen) = place.seen.as_ref() else {
            return;
        };
        if same && self.scenes.shown() == Some(&place.scene) && self.is_seen_so(seen) {
            return;
        }
        self.clock.playing = false;
        // Where time runs no moment was chosen: it begins anew.
        let time = if seen.playing { 0.0 } else { seen.time };
        self.arriving = Some(Arriving {
            camera: seen.eye.clone(),
            viewport: Viewport::First,
            steps: Steps::to(time),
            is_there: false,
            then_plays: seen.playing,
        });
        let settings = place.scene_settings.clone();
        self.scenes.select(&place.scene, Some(settings));
        self.scenes.poll();
        self.did("scene", say!("workbench.the_scene", name = place.scene));
    }

    fn is_seen_so(&self, seen: &Seen) -> bool {
        self.eye(Viewport::First) == seen.eye
            && self.clock.playing == seen.playing
            && (seen.playing || self.clock.time() == seen.time)
    }
}
