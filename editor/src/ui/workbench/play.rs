//! Play, pause, step and stop. What plays is a copy: stop gives back what there was before.

use std::sync::Arc;

use lightbench::script::SceneSnapshot;
use lightbench::script::overlays::Overlays;

use super::Workbench;
use super::clock::Clock;
use super::typed::Typed;
use crate::ui::messages::say;

/// The scene as it was when time began to run.
#[derive(Debug)]
pub(super) struct Before {
    scene: SceneSnapshot,
    clock: Clock,
    /// What lay on it then.
    overlays: Overlays,
    /// Lines of the console that had changed it by then.
    typed: Vec<Typed>,
}

impl Workbench {
    /// Lets time run, or holds it.
    pub fn play_or_pause(&mut self) {
        let (name, words) = match self.clock.playing {
            true => ("pause", say!("history.pause")),
            false => ("play", say!("history.play")),
        };
        self.as_moment(name, words, |this| {
            this.clock.playing = !this.clock.playing;
            let what = if this.clock.playing {
                say!("play.the_frame_from_which_time_runs")
            } else {
                say!("play.the_frame_at_which_time_was")
            };
            this.did("time", what);
            ((), true)
        });
    }

    /// One step further in time.
    pub fn step(&mut self) {
        self.as_moment("step", say!("history.step"), |this| {
            this.clock.playing = false;
            this.clock.step();
            this.noted_time = Some(say!("play.one_step_further"));
            ((), true)
        });
    }

    /// Back to the beginning of time. The scene goes on from where it is.
    pub fn rewind(&mut self) {
        self.as_moment("rewind", say!("history.rewind"), |this| {
            let before = this.clock.time();
            this.clock.rewind();
            this.did("time", say!("play.the_beginning_of_time"));
            ((), before != 0.0)
        });
    }

    /// Whether there is something to go back to with [`Workbench::stop`].
    pub fn is_in_play(&self) -> bool {
        self.before.is_some()
    }

    /// Gives back the world, what scripts remember and the time as they were when time began to run.
    /// What was changed by hand meanwhile lies over that too.
    pub fn stop(&mut self) {
        if self.before.is_none() {
            self.clock.playing = false;
            return;
        }
        self.as_moment("stop", say!("history.stop"), |this| {
            this.go_back_to_before();
            ((), true)
        });
    }

    fn go_back_to_before(&mut self) {
        self.clock.playing = false;
        let Some(before) = self.before.take() else {
            return;
        };
        let (speed, rate) = (self.clock.speed, self.clock.rate);
        self.clock = before.clock.held();
        (self.clock.speed, self.clock.rate) = (speed, rate);
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        scene.restore(&before.scene);
        self.typed.clone_from(&before.typed);
        if let Some(overlays) = self
            .overlays
            .get_mut(self.scenes.shown().unwrap_or_default())
            && let Some(scene) = self.scenes.scene_mut()
        {
            overlays.taken_back(scene, &before.overlays);
        }
        self.renderer.reset_scene();
        if std::mem::take(&mut self.ran_into_a_problem) {
            self.scenes.set_problems(None);
        }
        self.canvas.invalidate();
        self.did("time", say!("play.the_frame_from_which_time_ran"));
    }

    /// Time begins to run from where the clock stood, unless it does already.
    pub(super) fn begin_play(&mut self, clock: Clock) {
        if self.before.is_some() {
            return;
        }
        self.before = self.scenes.scene().map(|scene| {
            Arc::new(Before {
                scene: scene.snapshot(),
                clock,
                overlays: self.overlays_now().cloned().unwrap_or_default(),
                typed: self.typed.clone(),
            })
        });
    }

    /// The scene was loaded anew while time runs: stop gives back the new one, at the time at which the
    /// old one was.
    pub(super) fn play_goes_on(&mut self) {
        let Some(mut clock) = self.before.take().map(|before| before.clock) else {
            return;
        };
        clock.refresh();
        self.begin_play(clock);
    }
}
