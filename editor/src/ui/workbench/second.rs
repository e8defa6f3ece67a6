//! The second viewport: another look at the same world, through the same compiled pipeline.
//!
//! Its pictures are a series of their own (`lightbench::render::series`): targets, history and what
//! shaders see as `frame_index` are not those of the first viewport, so that it looks as if it were
//! alone. Nobody looks into its frames. While it is closed nothing of it is on the device.

use std::time::{Duration, Instant};

use lightbench::render::inspect::Attention;
use lightbench::render::queries::Measured;

use super::Workbench;
use super::camera::CameraRig;
use super::canvas::{Canvas, Drawn};
use super::drawing::Picture;
use super::sight::Sight;
use super::timing::Timings;
use super::viewports::Viewport;

/// What the second viewport has of its own.
pub struct Second {
    /// Where it is seen from.
    pub camera: CameraRig,
    /// The camera of the scene through which a person wants to look, by its name.
    pub(super) watched_camera: Option<String>,
    /// Whether it was never opened: then it begins with what the first viewport shows.
    is_new: bool,
    /// What it looks through in the next scene, where that is not what it looks through now.
    coming: Option<Sight>,
    /// Whether all of the scene is to be shown once the size of the viewport is known.
    fits: bool,
    is_open: bool,
    pub(super) canvas: Canvas,
    /// The state of the first canvas that this one knows: changes of the world are told to that.
    known: u64,
    /// The pipelines that went on screen, as far as this viewport knows.
    swaps: u64,
    timings: Timings,
    texture: Option<wgpu::Texture>,
}

impl Default for Second {
    fn default() -> Self {
        Self {
            camera: CameraRig::default(),
            watched_camera: None,
            is_new: true,
            coming: None,
            fits: false,
            is_open: false,
            canvas: Canvas::default(),
            known: 0,
            swaps: 0,
            timings: Timings::default(),
            texture: None,
        }
    }
}

impl Second {
    /// Whether somebody sees it.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Whether it was never opened.
    pub fn is_new(&self) -> bool {
        self.is_new
    }

    /// What it looks through once a scene is there.
    pub fn look_through_later(&mut self, sight: Sight) {
        self.is_new = false;
        self.coming = Some(sight);
    }

    /// Takes in what has changed for both viewports.
    fn catch_up(&mut self, first: &Canvas, swaps: u64) {
        if self.known != first.revision {
            self.known = first.revision;
            self.canvas.invalidate();
        }
        if self.swaps != swaps {
            self.swaps = swaps;
            self.canvas.new_pipeline();
            self.timings.reset();
        }
    }

    /// Forgets its pictures: there is another device, or nobody sees them.
    pub(super) fn forget_pictures(&mut self) {
        self.canvas = Canvas::default();
        self.timings.reset();
        self.texture = None;
    }
}

impl Workbench {
    /// The second viewport can be seen from now on: see [`Workbench::note_seen`].
    pub fn open_second(&mut self) {
        let second = &mut self.second;
        if !std::mem::replace(&mut second.is_open, true) {
            second.known = self.canvas.revision;
            second.swaps = self.pipelines.swaps();
        }
        if std::mem::take(&mut second.is_new) {
            second.camera = self.camera;
            second.watched_camera.clone_from(&self.watched_camera);
        }
    }

    /// The picture for the second viewport, of `size` pixels, drawn anew where something changed.
    /// This opens it. `None` until the first scene and pipeline are ready.
    pub fn draw_second(&mut self, size: (u32, u32), now: Instant) -> Option<Picture> {
        let size = (size.0.max(1), size.1.max(1));
        self.open_second();
        let second = &mut self.second;
        if std::mem::take(&mut second.fits)
            && let Some(flat) = second.camera.flat().copied()
            && let Some(bounds) = self.scene_bounds()
        {
            let aspect = size.0 as f32 / size.1 as f32;
            self.second.camera.flatten(flat.side, bounds, aspect);
        }
        let second = &mut self.second;
        second.catch_up(&self.canvas, self.pipelines.swaps());
        let looks = (second.camera.view(), size);
        let wanted = second
            .canvas
            .wanted(looks, now, self.clock.playing, &self.resolution);
        if !self.first_is_seen {
            // Else the first viewport does this.
            self.go_on(wanted);
        }
        let due = self.second.canvas.is_due(wanted)
            && self.picture_ready()
            && !self.is_held(Viewport::Second, now)
            && !self.comparing.is_waiting();
        if due && self.may_draw(Viewport::Second) {
            self.second.canvas.begin(now);
            self.redraw_second(wanted);
        } else {
            self.second.canvas.waits = due;
        }
        self.second_picture()
    }

    /// The picture of the second viewport as it was last drawn.
    pub fn second_picture(&self) -> Option<Picture> {
        Some(Picture {
            texture: self.second.texture.clone()?,
            scale: self.second.canvas.drawn?.scale,
        })
    }

    /// Whether the second viewport's picture shows the present state of scene, pipeline and camera.
    pub fn second_is_current(&self) -> bool {
        let second = &self.second;
        let knows = second.known == self.canvas.revision && second.swaps == self.pipelines.swaps();
        let sees = |drawn: Drawn| drawn.view == second.camera.view();
        knows && !second.canvas.is_behind() && second.canvas.drawn.is_some_and(sees)
    }

    /// Size in pixels of the second viewport's picture.
    pub fn second_size(&self) -> Option<(u32, u32)> {
        Some(self.second.canvas.drawn?.pixels())
    }

    /// Tells which viewports can be seen. The second one gives back all that it holds where it can't.
    pub fn note_seen(&mut self, first: bool, second: bool) {
        self.first_is_seen = first;
        if !first {
            self.canvas.waits = false;
        }
        if !first && !second {
            // Nobody draws B: the scene must not stand still for it.
            self.comparing.wait_no_more();
        }
        if second || !self.second.is_open {
            return;
        }
        self.second.is_open = false;
        self.second.forget_pictures();
        self.focus = Viewport::First;
        self.pipelines.release_series(Viewport::Second.series());
        self.draw_lines(Viewport::Second, false, false, false);
    }

    fn redraw_second(&mut self, wanted: Drawn) {
        let size = wanted.pixels();
        let time = self.clock.time();
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        let second = &mut self.second;
        if second.canvas.resizes(wanted) {
            second.timings.reset();
            self.pipelines.release_hidden();
        }
        let Some(pipeline) = self.pipelines.shown_pipeline() else {
            return;
        };
        self.last_drawn = Viewport::Second;
        let series = Viewport::Second.series();
        let frame = self.renderer.next_frame();
        self.renderer.inspector().attend(Attention::Nothing);
        let (world, assets) = (&mut scene.world, &scene.assets);
        let result =
            self.renderer
                .render_in(series, world, assets, pipeline, &wanted.view, size, time);
        second.canvas.answered();
        let failed = match result {
            Ok(statistics) => {
                second.timings.submitted(frame, statistics);
                second.canvas.submitted(frame, wanted, statistics);
                let output = pipeline.desc.output.as_ref();
                let target = output.and_then(|output| {
                    let targets = pipeline.targets_of(series)?;
                    targets.get(&output.name)
                });
                second.texture = target.map(|target| target.texture.clone());
                None
            }
            Err(error) => Some(error),
        };
        self.renderer.inspector().attend(Attention::Whole);
        match failed {
            Some(error) => self.not_drawn(Viewport::Second, wanted, error),
            None => self.tell_of_lines(),
        }
    }

    /// Takes the measurements of the second viewport's frames out of those that came back.
    pub(super) fn measured_second(&mut self, results: &mut Vec<Measured>, now: Instant) {
        let mut index = 0;
        while index < results.len() {
            if !self.second.canvas.owns(&results[index]) {
                index += 1;
                continue;
            }
            let own = results.remove(index);
            self.second.timings.measured(&own);
            let series = Viewport::Second.series();
            if let Some(pipeline) = self.pipelines.shown_pipeline()
                && pipeline.grow_in(series, std::slice::from_ref(&own))
            {
                self.second.canvas.invalidate();
            }
            if let Some((scale, ms)) = self.second.canvas.measured(&own) {
                self.guide_resolution(Viewport::Second, scale, ms, now);
            }
        }
    }

    /// When the second viewport has something to draw next.
    pub(super) fn second_due(&self, now: Instant, soonest: Duration) -> Option<Duration> {
        const RESULTS: Duration = Duration::from_millis(20);
        let second = &self.second;
        if !second.is_open || !self.picture_ready() {
            return None;
        }
        let behind = second.known != self.canvas.revision
            || second.swaps != self.pipelines.swaps()
            || second.canvas.is_behind()
            || second.canvas.waits;
        let soon = [
            (behind && second.canvas.problem.is_none()).then_some(soonest),
            second.timings.is_waiting().then_some(RESULTS),
            second.canvas.refining_due(now),
        ];
        soon.into_iter().flatten().min()
    }

    /// Another scene has come: the second viewport shows it from the same side, or from its own
    /// camera.
    pub(super) fn look_at_new_scene(&mut self, distance: Option<f32>) {
        let second = &mut self.second;
        let side = second.camera.flat().map(|flat| Sight::Side(flat.side));
        let sight = second.coming.take().or(side);
        second.watched_camera = None;
        second.camera.reset();
        if let Some(distance) = distance {
            second.camera.suit(distance);
        }
        let is_there = |sight: &Sight| match sight {
            Sight::Camera(name) => self.cameras().contains(name),
            Sight::Perspective | Sight::Side(_) => true,
        };
        if let Some(sight) = sight.filter(is_there) {
            self.look_through_in(Viewport::Second, sight);
            self.second.fits = true;
        }
    }
}
