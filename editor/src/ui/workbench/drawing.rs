//! Frames of the viewport: when to draw one, and at which size.

use std::time::{Duration, Instant};

use lightbench::render::{Place, Problem, RenderError};

use super::Workbench;
use super::canvas::Drawn;
use super::viewports::Viewport;

/// Frames that the device may have to do at once. The next one would wait for it, and all widgets
/// with it. A software driver does one at a time.
const IN_FLIGHT: usize = 3;

/// The picture for the viewport.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The pipeline's output, eight bits a channel, sRGB-coded.
    pub texture: wgpu::Texture,
    /// The factor between the viewport's pixels and the picture's.
    pub scale: f32,
}

impl Workbench {
    /// The picture for a viewport of `size` pixels, drawn anew where something changed. `None`
    /// until the first scene and pipeline are ready.
    pub fn draw(&mut self, size: (u32, u32), now: Instant) -> Option<Picture> {
        let size = (size.0.max(1), size.1.max(1));
        let looks = (self.camera.view(), size);
        let playing = self.clock.playing;
        let wanted = self.canvas.wanted(looks, now, playing, &self.resolution);
        self.go_on(wanted);
        let due = self.canvas.is_due(wanted)
            && !self.is_held(Viewport::First, now)
            && !self.comparing.is_waiting();
        if due && self.may_draw(Viewport::First) {
            self.canvas.begin(now);
            self.redraw(wanted);
        } else {
            self.canvas.waits = due;
            if !due && self.has_room() {
                self.go_on_beside();
            }
        }
        let picture = self.picture()?;
        let texture = self.compared_picture(&picture.texture, now);
        Some(Picture {
            texture: texture.unwrap_or(picture.texture),
            ..picture
        })
    }

    /// What the viewport shows, as it was last drawn: the picture of A, or what is made of both.
    pub fn shown_picture(&mut self) -> Option<wgpu::Texture> {
        let picture = self.picture()?.texture;
        let compared = self.compared_picture(&picture, Instant::now());
        Some(compared.unwrap_or(picture))
    }

    /// Draws at full size whatever else is going on; for benchmarks.
    pub fn redraw_now(&mut self, size: (u32, u32)) {
        let view = self.camera.view();
        let scale = 1.0;
        self.redraw(Drawn { view, size, scale });
    }

    /// Goes on with what is to be drawn beside the picture.
    pub(super) fn go_on(&mut self, wanted: Drawn) {
        self.follow_stop();
        self.go_on_with_other();
        self.warm_up(wanted);
    }

    /// Whether a viewport's picture stays until a newer state is there.
    pub(super) fn is_held(&self, viewport: Viewport, now: Instant) -> bool {
        let renews = self.pipelines.is_renewing() || self.scenes.is_renewing();
        renews && self.canvas_of(viewport).is_fresh(now)
    }

    /// Whether the device has room for the picture of a viewport. Where both wait for it they draw in
    /// turn.
    pub(super) fn may_draw(&self, viewport: Viewport) -> bool {
        let yields = self.last_drawn == viewport && self.canvas_of(viewport.other()).waits;
        !yields && self.has_room()
    }

    /// Whether the device could take another frame without letting it wait.
    pub(super) fn has_room(&self) -> bool {
        let most = if self.gpu().summary.software {
            1
        } else {
            IN_FLIGHT
        };
        self.renderer.in_flight() < most
    }

    /// Whether the picture shows the present state of scene, pipeline and camera, and nobody waits for
    /// it to be drawn once more.
    pub fn picture_is_current(&self) -> bool {
        let view = self.camera.view();
        !self.canvas.is_behind() && self.canvas.drawn.is_none_or(|drawn| drawn.view == view)
    }

    /// The factor between the viewport's pixels and those of the picture on screen.
    pub(super) fn drawn_scale(&self) -> Option<f32> {
        Some(self.canvas.drawn?.scale)
    }

    /// When something last moved or changed in the picture.
    pub(super) fn moved_at(&self) -> Option<Instant> {
        self.canvas.moved_at
    }

    /// Whether a scene and a pipeline are there to draw.
    pub fn picture_ready(&self) -> bool {
        self.scenes.shown().is_some() && self.pipelines.shown().is_some()
    }

    /// The picture as it was last drawn.
    pub fn picture(&mut self) -> Option<Picture> {
        let scale = self.canvas.drawn?.scale;
        let pipeline = self.pipelines.shown_pipeline()?;
        let output = pipeline.desc.output.as_ref()?.name.as_str();
        let target = pipeline.targets()?.get(output)?;
        Some(Picture {
            texture: target.texture.clone(),
            scale,
        })
    }

    /// When [`Workbench::tick`] and [`Workbench::draw`] have something to do next, as far as is
    /// known; `None` while nothing goes on.
    pub fn next_due(&self, now: Instant) -> Option<Duration> {
        const PROGRESS: Duration = Duration::from_millis(80);
        const RESULTS: Duration = Duration::from_millis(20);
        const DEVICE: Duration = Duration::from_millis(4);
        let ready = self.picture_ready();
        let first_is_seen = self.first_is_seen;
        let soonest = if self.has_room() {
            Duration::ZERO
        } else {
            DEVICE
        };
        let soon = [
            (ready && self.clock.playing).then_some(soonest),
            (ready && first_is_seen && self.canvas.is_behind() && self.canvas.problem.is_none())
                .then_some(soonest),
            self.second_due(now, soonest),
            (self.timings.is_waiting() || self.probing.is_waiting()).then_some(RESULTS),
            (self.measuring.is_waiting() || self.beside.is_waiting()).then_some(RESULTS),
            self.lighting.is_waiting().then_some(PROGRESS),
            (self.scenes.shown().is_some() && self.pipelines.is_warming())
                .then_some(DEVICE)
                .filter(|_| first_is_seen || self.second.is_open()),
            (self.scenes.is_busy() || self.pipelines.is_busy() || self.library.is_busy())
                .then_some(PROGRESS),
            // Refine the picture once nothing moves any more.
            self.canvas.refining_due(now).filter(|_| first_is_seen),
            self.comparing_due(now),
            self.is_arriving().then_some(DEVICE),
            (self.reporting.progress().is_some() || self.notebook.is_busy()).then_some(PROGRESS),
        ];
        soon.into_iter().flatten().min()
    }

    /// Size in pixels of the picture on screen.
    pub fn drawn_size(&self) -> Option<(u32, u32)> {
        Some(self.canvas.drawn?.pixels())
    }

    /// Goes one step on with a pipeline that is not on screen yet. The picture goes on with the last
    /// good one meanwhile.
    fn warm_up(&mut self, wanted: Drawn) {
        let size = wanted.pixels();
        self.warm_up_other(&wanted.view, size);
        let time = self.clock.time();
        let (Some(scene), Some(pipeline)) = (self.scenes.scene_mut(), self.pipelines.cold()) else {
            return;
        };
        let (world, assets) = (&mut scene.world, &scene.assets);
        let result = self
            .renderer
            .warm_up(world, assets, pipeline, &wanted.view, size, time);
        match result {
            Ok(false) => {}
            Err(RenderError::NotBuilt(variants)) => self.pipelines.need(variants),
            Err(RenderError::Gpu(error)) => self.device_failed(error),
            // What keeps it from drawing is said when it draws.
            Ok(true) | Err(_) => {
                self.pipelines.warmed();
                self.timings.reset();
                self.canvas.new_pipeline();
            }
        }
    }

    fn redraw(&mut self, wanted: Drawn) {
        let index = self.renderer.frame_index();
        self.redraw_first(wanted);
        let size = wanted.pixels();
        self.redraw_other(wanted.view, size, index);
    }

    fn redraw_first(&mut self, wanted: Drawn) {
        let size = wanted.pixels();
        let time = self.clock.time();
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        if self.canvas.resizes(wanted) {
            self.timings.reset();
            self.pipelines.release_hidden();
        }
        let Some(pipeline) = self.pipelines.shown_pipeline() else {
            return;
        };
        self.last_drawn = Viewport::First;
        let frame = self.renderer.next_frame();
        let (world, assets) = (&mut scene.world, &scene.assets);
        let result = self
            .renderer
            .render(world, assets, pipeline, &wanted.view, size, time);
        self.canvas.answered();
        match result {
            Ok(statistics) => {
                self.timings.submitted(frame, statistics);
                self.canvas.submitted(frame, wanted, statistics);
                let passes = self.pipelines.shown_pipeline();
                let passes = passes.map_or(&[][..], |pipeline| &pipeline.desc.passes);
                let names = passes.iter().map(|pass| pass.name.as_str());
                let statistics = &self.canvas.statistics;
                let assets = self.renderer.asset_bytes();
                self.trends
                    .submitted(Instant::now(), statistics, assets, names);
                if let Some(problem) = self.renderer.inspector().take_problem() {
                    self.log.problem(&problem);
                }
                self.tell_of_lines();
            }
            Err(error) => self.not_drawn(Viewport::First, wanted, error),
        }
    }

    /// Says what keeps lines over a picture from being drawn.
    pub(super) fn tell_of_lines(&mut self) {
        if let Some(problem) = self.renderer.overlay().take_problem() {
            self.log.problem(&problem);
        }
    }

    /// A picture was not drawn.
    pub(super) fn not_drawn(&mut self, viewport: Viewport, wanted: Drawn, error: RenderError) {
        match error {
            RenderError::Gpu(error) => self.device_failed(error),
            // The last picture stays until that is built.
            RenderError::NotBuilt(variants) => self.pipelines.need(variants),
            error => {
                let problem = Problem::new(Place::file("viewport"), error.to_string());
                if self.canvas_of(viewport).problem.as_ref() != Some(&problem) {
                    self.log.problem(&problem);
                }
                let canvas = self.canvas_of_mut(viewport);
                canvas.problem = Some(problem);
                canvas.drawn = Some(wanted);
            }
        }
    }
}
