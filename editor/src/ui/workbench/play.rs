//! Play, pause, step and stop. What plays is a copy: stop gives back what there was before.

use lightbench::script::SceneSnapshot;
use lightbench::script::overlays::Overlays;

use super::Workbench;
use super::clock::Clock;
use crate::ui::messages::say;

/// The scene as it was when time began to run.
pub(super) struct Before {
    scene: SceneSnapshot,
    clock: Clock,
    /// What lay on it then.
    overlays: Overlays,
}

impl Workbench {
    /// Lets time run, or holds it.
    pub fn play_or_pause(&mut self) {
        self.clock.playing = !self.clock.playing;
        let what = if self.clock.playing {
            say!("play.the_frame_from_which_time_runs")
        } else {
            say!("play.the_frame_at_which_time_was")
        };
        self.did("time", what);
    }

    /// One step further in time.
    pub fn step(&mut self) {
        self.clock.playing = false;
        self.clock.step();
        self.noted_time = Some(say!("play.one_step_further"));
    }

    /// Back to the beginning of time. The scene goes on from where it is.
    pub fn rewind(&mut self) {
        self.clock.rewind();
        self.did("time", say!("play.the_beginning_of_time"));
    }

    /// Whether there is something to go back to with [`Workbench::stop`].
    pub fn is_in_play(&self) -> bool {
        self.before.is_some()
    }

    /// Gives back the world, what scripts remember and the time as they were when time began to run.
    /// What was changed by hand meanwhile lies over that too.
    pub fn stop(&mut self) {
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
        self.before = self.scenes.scene().map(|scene| Before {
            scene: scene.snapshot(),
            clock,
            overlays: self.overlays_now().cloned().unwrap_or_default(),
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
