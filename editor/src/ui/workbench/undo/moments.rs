//! The scene as it stands at a moment, to go back to.

use std::collections::VecDeque;
use std::sync::{Arc, Weak};

use lightbench::script::SceneSnapshot;
use lightbench::script::overlays::Overlays;

use super::super::Workbench;
use super::super::clock::Clock;
use super::super::play::Before;
use super::super::typed::Typed;
use super::{Change, Content, Target};
use crate::ui::messages::say;

/// Scenes that are kept as they stood; of older steps only the clock goes back.
const MOST: usize = 64;

/// Entities of all of these together: it bounds the memory that they take.
const MOST_ENTITIES: usize = 500_000;

/// A scene as it stood.
#[derive(Debug)]
pub(super) struct Stood {
    scene: SceneSnapshot,
    /// What lay on it then.
    overlays: Overlays,
    /// Lines of the console that had changed it by then.
    typed: Vec<Typed>,
    /// What Stop gave back then.
    before: Option<Arc<Before>>,
    /// Of which load it is.
    load: u64,
    entities: usize,
}

/// A moment of a scene.
#[derive(Clone, Debug)]
pub struct Moment {
    clock: Clock,
    stood: Weak<Stood>,
}

impl PartialEq for Moment {
    fn eq(&self, other: &Self) -> bool {
        self.clock == other.clock && self.stood.ptr_eq(&other.stood)
    }
}

/// Scenes that are kept as they stood, oldest first.
#[derive(Debug, Default)]
pub(super) struct Moments(VecDeque<Arc<Stood>>);

impl Moments {
    fn keep(&mut self, stood: Stood) -> Weak<Stood> {
        let stood = Arc::new(stood);
        let weak = Arc::downgrade(&stood);
        self.0.push_back(stood);
        let entities =
            |all: &VecDeque<Arc<Stood>>| all.iter().map(|one| one.entities).sum::<usize>();
        while self.0.len() > 1 && (self.0.len() > MOST || entities(&self.0) > MOST_ENTITIES) {
            self.0.pop_front();
        }
        weak
    }
}

impl Workbench {
    /// Keeps the scene as it stands.
    pub(super) fn keep_moment(&mut self) -> Option<Moment> {
        let load = self.scenes.swaps();
        let scene = self.scenes.scene()?;
        let stood = Stood {
            scene: scene.snapshot(),
            entities: scene.world.entities().count(),
            overlays: self.overlays_now().cloned().unwrap_or_default(),
            typed: self.typed.clone(),
            before: self.before.clone(),
            load,
        };
        let stood = self.undo.moments.keep(stood);
        let clock = self.clock;
        Some(Moment { clock, stood })
    }

    /// Changes the scene or its time as a step that goes back to how the scene stands now.
    pub(in crate::ui::workbench) fn as_moment<T>(
        &mut self,
        name: &'static str,
        what: &str,
        change: impl FnOnce(&mut Self) -> (T, bool),
    ) -> T {
        let before = match self.undo.quiet {
            true => None,
            false => self.keep_moment(),
        };
        // A key that is held steps on and on; all else is a step of its own.
        let one = name != "step";
        if one {
            self.undo.seal();
        }
        let (result, changed) = change(self);
        if let Some(before) = before.filter(|_| changed) {
            let change = Change {
                target: Target::Moment(name),
                before: Some(Content::Moment(before)),
                after: None,
            };
            self.undo.note(what.to_owned(), vec![change]);
            self.undo.goes_on &= !one;
        }
        result
    }

    /// Makes the scene what it was at a moment, where it is that of the same load.
    pub(super) fn go_to_moment(&mut self, moment: &Moment) {
        let (speed, rate) = (self.clock.speed, self.clock.rate);
        let playing = moment.clock.playing;
        self.clock = moment.clock.held();
        (self.clock.speed, self.clock.rate) = (speed, rate);
        self.clock.playing = playing;
        let load = self.scenes.swaps();
        let Some(stood) = moment.stood.upgrade().filter(|stood| stood.load == load) else {
            self.log.info(say!("history.clock_alone"));
            return;
        };
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        scene.restore(&stood.scene);
        if let Some(overlays) = self.overlays.get_mut(&name)
            && let Some(scene) = self.scenes.scene_mut()
        {
            overlays.taken_back(scene, &stood.overlays);
        }
        self.before.clone_from(&stood.before);
        self.typed.clone_from(&stood.typed);
        if std::mem::take(&mut self.ran_into_a_problem) {
            self.scenes.set_problems(None);
        }
        self.renderer.reset_scene();
        if let Some(scene) = self.scenes.scene() {
            self.selection.names_changed(scene);
        }
        self.canvas.invalidate();
    }
}
