//! Series of pictures: each picture of one follows the one before.
//!
//! A pipeline that draws two viewports draws two series. History, the earlier view, `frame_index` and
//! whatever else goes from frame to frame belongs to a series, so that each looks as if it were the
//! only one; the compiled passes and their parameters are shared.

use crate::compiled_pass::{Bound, CompiledPass};
use crate::targets::Targets;

/// The series of all that draws one picture after the other. Others are counted from 1.
pub const FIRST_SERIES: usize = 0;

/// What a pipeline keeps from one picture of a series to the next.
#[derive(Debug, Default)]
pub(crate) struct Continuity {
    pub targets: Option<Targets>,
    /// Of the engine's buffers that are bound.
    pub engine_revision: u64,
    pub history_frames: u32,
    /// What shaders saw as `frame_index`.
    pub last_frame: Option<u32>,
    /// Words that each buffer must have at least, as counters said.
    pub grown: Vec<u64>,
    /// Whether a buffer is smaller than that.
    pub outgrown: bool,
    /// The first of the frames that it drew without another pipeline between.
    pub run_began: u32,
}

impl Continuity {
    /// Nothing was drawn yet.
    pub fn new(buffers: usize) -> Self {
        Self {
            grown: vec![0; buffers],
            ..Self::default()
        }
    }

    /// Gives back the memory of targets and buffers, and with it the history.
    pub fn release(&mut self) {
        self.targets = None;
        self.last_frame = None;
    }
}

/// A series that is not being drawn.
#[derive(Debug)]
pub(crate) struct Resting {
    pub continuity: Continuity,
    /// What each pass binds for it.
    bound: Vec<Bound>,
}

impl Resting {
    /// Nothing was drawn yet.
    pub fn new(buffers: usize, passes: usize) -> Self {
        Self {
            continuity: Continuity::new(buffers),
            bound: std::iter::repeat_with(Bound::default)
                .take(passes)
                .collect(),
        }
    }

    /// Takes the place of the series that is being drawn, which rests here then.
    pub fn swap(&mut self, continuity: &mut Continuity, passes: &mut [CompiledPass]) {
        std::mem::swap(&mut self.continuity, continuity);
        for (resting, pass) in self.bound.iter_mut().zip(passes) {
            std::mem::swap(resting, &mut pass.bound);
        }
    }

    /// As [`Continuity::release`].
    pub fn release(&mut self) {
        self.continuity.release();
        self.bound.fill_with(Bound::default);
    }
}
