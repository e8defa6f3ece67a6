//! The state of a viewport's picture: what it was made from, and whether it must be made anew.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use lightbench::render::queries::Measured;
use lightbench::render::{FrameStatistics, Problem, View};

use super::resolution::Resolution;

/// How long nothing must move before the picture is drawn at full size.
const REST: Duration = Duration::from_millis(250);

/// How long a picture stays at most while a newer state of its pipeline is built or of its scene
/// loaded: the cores of a software driver are better spent on that.
const HOLD: Duration = Duration::from_millis(250);

/// Frames whose time includes the driver's compiler, and says nothing about the next.
const WARM_UP: u32 = 2;

/// Frames whose times may still be on their way.
const IN_FLIGHT: usize = 16;

/// What the picture on screen was made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Drawn {
    pub view: View,
    /// The viewport's pixels.
    pub size: (u32, u32),
    pub scale: f32,
}

impl Drawn {
    /// Size in pixels of the picture.
    pub fn pixels(&self) -> (u32, u32) {
        Resolution::apply(self.size, self.scale)
    }
}

/// The state of a viewport's picture.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    /// The viewport's pixels, once it was seen.
    pub size: Option<(u32, u32)>,
    pub drawn: Option<Drawn>,
    /// Something other than view and size changed since.
    stale: bool,
    /// The same picture is wanted once more, at the same size: somebody looks into it.
    again: bool,
    /// How often something other than view and size has changed.
    pub revision: u64,
    /// Whether it was to be drawn in the last frame of the window, and the device had no room.
    pub waits: bool,
    pub moved_at: Option<Instant>,
    drawn_at: Option<Instant>,
    /// Submitted frames and their scales.
    scales: VecDeque<(u32, f32)>,
    /// The scale and the milliseconds of the last measured frame.
    cost: Option<(f32, f64)>,
    warm_up: u32,
    /// Pictures that were drawn.
    pub frames: u64,
    pub problem: Option<Problem>,
    pub statistics: FrameStatistics,
}

impl Canvas {
    /// The picture no longer shows the present state.
    pub fn invalidate(&mut self) {
        self.stale = true;
        self.revision += 1;
    }

    /// Draws once more what is on screen.
    pub fn repeat(&mut self) {
        self.again = true;
    }

    /// As [`Canvas::invalidate`], and the next frames compile shaders.
    pub fn new_pipeline(&mut self) {
        self.invalidate();
        self.warm_up = WARM_UP;
    }

    /// Whether something other than view and size changed, or somebody looks into the picture.
    pub fn is_behind(&self) -> bool {
        self.stale || self.again
    }

    /// What is to be drawn in a viewport of `size` pixels.
    pub fn wanted(
        &mut self,
        (view, size): (View, (u32, u32)),
        now: Instant,
        playing: bool,
        resolution: &Resolution,
    ) -> Drawn {
        self.size = Some(size);
        // What changes counts as moving: a slow adapter shows it small at once, and in full as soon
        // as nothing follows.
        let changed = |drawn: Drawn| drawn.view != view || self.stale;
        if playing || self.drawn.is_some_and(changed) {
            self.moved_at = Some(now);
        }
        let scale = match self.drawn {
            Some(drawn) if self.again => drawn.scale,
            _ => resolution.scale(self.is_moving(now)),
        };
        Drawn { view, size, scale }
    }

    /// Whether something in the picture moved of late.
    pub fn is_moving(&self, now: Instant) -> bool {
        self.moved_at.is_some_and(|at| now - at < REST)
    }

    /// Whether the picture on screen is another one.
    pub fn is_due(&self, wanted: Drawn) -> bool {
        self.is_behind() || self.drawn != Some(wanted)
    }

    /// Whether the picture is so new that it can wait for a newer state that is being made.
    pub fn is_fresh(&self, now: Instant) -> bool {
        self.drawn_at.is_some_and(|at| now - at < HOLD)
    }

    /// Whether a picture of that size takes other textures than the last one.
    pub fn resizes(&self, wanted: Drawn) -> bool {
        self.drawn
            .is_none_or(|drawn| drawn.pixels() != wanted.pixels())
    }

    /// A picture is about to be drawn.
    pub fn begin(&mut self, now: Instant) {
        self.drawn_at = Some(now);
        self.waits = false;
    }

    /// What was to be drawn was given to the device, or can't be.
    pub fn answered(&mut self) {
        self.stale = false;
        self.again = false;
    }

    /// The picture was given to the device, as the frame of that number.
    pub fn submitted(&mut self, frame: u32, drawn: Drawn, statistics: &FrameStatistics) {
        self.frames += 1;
        self.statistics.clone_from(statistics);
        self.scales.push_back((frame, drawn.scale));
        if self.scales.len() > IN_FLIGHT {
            self.scales.pop_front();
        }
        self.drawn = Some(drawn);
        self.problem = None;
    }

    /// Whether a measured frame is one of this canvas.
    pub fn owns(&self, measured: &Measured) -> bool {
        self.scales
            .iter()
            .any(|(frame, _)| *frame == measured.frame)
    }

    /// The scale and time of a measured frame, where it may guide the resolution.
    pub fn measured(&mut self, measured: &Measured) -> Option<(f32, f64)> {
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
        self.cost = Some((scale, measured.total_ms?));
        self.cost
    }

    /// The milliseconds that a frame of that scale takes, as far as the last one tells.
    pub fn cost_at(&self, scale: f32) -> Option<f64> {
        let (known, ms) = self.cost?;
        Some(ms * f64::from((scale / known).powi(2)))
    }

    /// When a picture that was drawn smaller can be drawn in full.
    pub fn refining_due(&self, now: Instant) -> Option<Duration> {
        self.drawn.filter(|drawn| drawn.scale < 1.0)?;
        Some((self.moved_at? + REST).saturating_duration_since(now))
    }
}
