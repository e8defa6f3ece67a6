//! Frames of the viewport: when to draw one, and at which size.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use lightbench::render::queries::Measured;
use lightbench::render::{FrameStatistics, Place, Problem, RenderError, View};

use super::Workbench;
use super::resolution::Resolution;

/// How long nothing must move before the picture is drawn at full size.
const REST: Duration = Duration::from_millis(250);

/// How long a picture stays at most while a newer state of its pipeline is built or of its scene
/// loaded: the cores of a software driver are better spent on that.
const HOLD: Duration = Duration::from_millis(250);

/// Frames that the device may have to do at once. The next one would wait for it, and all widgets
/// with it. A software driver does one at a time.
const IN_FLIGHT: usize = 3;

/// Frames whose time includes the driver's compiler, and says nothing about the next.
const WARM_UP: u32 = 2;

/// What the picture on screen was made from.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drawn {
    view: View,
    size: (u32, u32),
    scale: f32,
}

/// The state of the viewport's picture.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    drawn: Option<Drawn>,
    /// Something other than view and size changed since.
    stale: bool,
    /// The same picture is wanted once more, at the same size: somebody looks into it.
    again: bool,
    moved_at: Option<Instant>,
    drawn_at: Option<Instant>,
    /// Submitted frames and their scales.
    scales: VecDeque<(u32, f32)>,
    warm_up: u32,
    pub(super) problem: Option<Problem>,
    pub(super) statistics: FrameStatistics,
}

impl Canvas {
    /// The picture no longer shows the present state.
    pub(super) fn invalidate(&mut self) {
        self.stale = true;
    }

    /// Draws once more what is on screen.
    pub(super) fn repeat(&mut self) {
        self.again = true;
    }

    /// As [`Canvas::invalidate`], and the next frames compile shaders.
    pub(super) fn new_pipeline(&mut self) {
        self.stale = true;
        self.warm_up = WARM_UP;
    }

    /// The scale and time of a measured frame, where it may guide the resolution.
    pub(super) fn measured(&mut self, measured: &Measured) -> Option<(f32, f64)> {
        let at = self
            .scales
            .iter()
            .position(|(frame, _)| *frame == measured.frame)?;
        let scale = self.scales[at].1;
        self.scales.drain(..=at);
        if self.warm_up > 0 {
            self.warm_up -= 1;
            return None;
        }
        Some((scale, measured.total_ms?))
    }
}

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
        let view = self.camera.view();
        let before = self.canvas.drawn;
        // What changes counts as moving: a slow adapter shows it small at once, and in full as soon
        // as nothing follows.
        let changed = before.is_some_and(|drawn| drawn.view != view || self.canvas.stale);
        if self.clock.playing || changed {
            self.canvas.moved_at = Some(now);
        }
        let moving = self.canvas.moved_at.is_some_and(|at| now - at < REST);
        let scale = match before {
            Some(drawn) if self.canvas.again => drawn.scale,
            _ => self.resolution.scale(moving),
        };
        let wanted = Drawn { view, size, scale };
        self.follow_stop();
        self.go_on_with_other();
        self.warm_up(wanted);
        let held = self.canvas.drawn_at.is_some_and(|at| now - at < HOLD);
        let held = held && (self.pipelines.is_renewing() || self.scenes.is_renewing());
        if (self.canvas.stale || self.canvas.again || before != Some(wanted))
            && !held
            && !self.comparing.is_waiting()
            && self.has_room()
        {
            self.canvas.drawn_at = Some(now);
            self.redraw(wanted);
        } else if self.has_room() {
            self.go_on_beside();
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
        let waits = self.canvas.stale || self.canvas.again;
        !waits && self.canvas.drawn.is_none_or(|drawn| drawn.view == view)
    }

    /// Width and height of the viewport in pixels.
    pub(super) fn viewport_size(&self) -> Option<(u32, u32)> {
        Some(self.canvas.drawn?.size)
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
        let soonest = if self.has_room() {
            Duration::ZERO
        } else {
            DEVICE
        };
        let soon = [
            (ready && self.clock.playing).then_some(soonest),
            (ready && (self.canvas.stale || self.canvas.again) && self.canvas.problem.is_none())
                .then_some(soonest),
            (self.timings.is_waiting() || self.probing.is_waiting()).then_some(RESULTS),
            (self.measuring.is_waiting() || self.beside.is_waiting()).then_some(RESULTS),
            self.lighting.is_waiting().then_some(PROGRESS),
            (self.scenes.shown().is_some() && self.pipelines.is_warming()).then_some(DEVICE),
            (self.scenes.is_busy() || self.pipelines.is_busy() || self.library.is_busy())
                .then_some(PROGRESS),
            // Refine the picture once nothing moves any more.
            self.canvas
                .drawn
                .filter(|drawn| drawn.scale < 1.0)
                .and_then(|_| {
                    let at = self.canvas.moved_at?;
                    Some((at + REST).saturating_duration_since(now))
                }),
            self.comparing_due(now),
            self.is_arriving().then_some(DEVICE),
            (self.reporting.progress().is_some() || self.notebook.is_busy()).then_some(PROGRESS),
        ];
        soon.into_iter().flatten().min()
    }

    /// Size in pixels of the picture on screen.
    pub fn drawn_size(&self) -> Option<(u32, u32)> {
        let drawn = self.canvas.drawn?;
        Some(Resolution::apply(drawn.size, drawn.scale))
    }

    /// Goes one step on with a pipeline that is not on screen yet. The picture goes on with the last
    /// good one meanwhile.
    fn warm_up(&mut self, wanted: Drawn) {
        let size = Resolution::apply(wanted.size, wanted.scale);
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
        let size = Resolution::apply(wanted.size, wanted.scale);
        self.redraw_other(wanted.view, size, index);
    }

    fn redraw_first(&mut self, wanted: Drawn) {
        let size = Resolution::apply(wanted.size, wanted.scale);
        let time = self.clock.time();
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        let resized = self
            .canvas
            .drawn
            .is_none_or(|drawn| Resolution::apply(drawn.size, drawn.scale) != size);
        if resized {
            self.timings.reset();
            self.pipelines.release_hidden();
        }
        let Some(pipeline) = self.pipelines.shown_pipeline() else {
            return;
        };
        let frame = self.renderer.next_frame();
        let (world, assets) = (&mut scene.world, &scene.assets);
        let result = self
            .renderer
            .render(world, assets, pipeline, &wanted.view, size, time);
        self.canvas.stale = false;
        self.canvas.again = false;
        match result {
            Ok(statistics) => {
                self.timings.submitted(frame, statistics);
                self.canvas.statistics.clone_from(statistics);
                self.canvas.scales.push_back((frame, wanted.scale));
                if self.canvas.scales.len() > 16 {
                    self.canvas.scales.pop_front();
                }
                self.canvas.drawn = Some(wanted);
                self.canvas.problem = None;
                let passes = self.pipelines.shown_pipeline();
                let passes = passes.map_or(&[][..], |pipeline| &pipeline.desc.passes);
                let names = passes.iter().map(|pass| pass.name.as_str());
                let statistics = &self.canvas.statistics;
                let assets = self.renderer.asset_bytes();
                self.trends
                    .submitted(Instant::now(), statistics, assets, names);
                let looked = self.renderer.inspector().take_problem();
                let lined = self.renderer.overlay().take_problem();
                for problem in looked.iter().chain(&lined) {
                    self.log.problem(problem);
                }
            }
            Err(RenderError::Gpu(error)) => self.device_failed(error),
            // The last picture stays until that is built.
            Err(RenderError::NotBuilt(variants)) => self.pipelines.need(variants),
            Err(error) => {
                let problem = Problem::new(Place::file("viewport"), error.to_string());
                if self.canvas.problem.as_ref() != Some(&problem) {
                    self.log.problem(&problem);
                }
                self.canvas.problem = Some(problem);
                self.canvas.drawn = Some(wanted);
            }
        }
    }
}
