//! A scene takes the place of another, or of itself before its file changed.

use super::Workbench;
use super::scenes::Loaded;
use super::timing::Timings;

impl Workbench {
    /// Takes in a scene that was loaded.
    pub(super) fn take_scene(&mut self) {
        match self.scenes.poll() {
            None => {}
            Some(Loaded::Failed(problems)) => {
                self.arriving = None;
                self.log_problems(&problems);
            }
            Some(Loaded::Scene { again }) => self.new_scene(again),
        }
    }

    fn new_scene(&mut self, again: bool) {
        // A view begins at the beginning.
        let again = again && !self.is_arriving();
        self.renderer.reset_scene();
        self.comparing.wait_no_more();
        self.timings = Timings::default();
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        self.timings.stepped(scene.system_times());
        let animated = scene.moves();
        self.ran_into_a_problem = false;
        if let Some(overlays) = self.overlays.get_mut(&name) {
            overlays.lay_on(scene);
        }
        // What lines did was done to the scene before.
        (self.typed, self.saved_lines) = Default::default();
        if again {
            // Who works on a file has chosen what to look through.
            scene.take_pipeline_choice();

            self.clock.refresh();
            self.play_goes_on();
        } else {
            self.before = None;
            // Its camera is another one, which nobody moved.
            self.noted_view = None;
            self.watched_camera = None;
            self.undo.scene_is(&name);
            self.forget_views();
            self.clock.rewind();
            self.clock.playing = animated;
            self.camera.reset();
            self.follow_camera();
            let distance = self.typical_distance();
            if let Some(distance) = distance {
                self.camera.suit(distance);
            }
            self.look_at_new_scene(distance);
            if self.is_arriving() {
                self.begin_arrival();
            } else {
                self.follow_pipeline_choice();
            }
        }
        if !self.is_arriving() {
            self.run_again(None);
        }
        self.canvas.invalidate();
    }
}
