//! Looks into a frame: a target as it is after a chosen pass, what each pass does to a pixel, and
//! where values are that are no numbers.
//!
//! All of it happens on the GPU between the passes of one frame, and what is to be read comes back
//! some frames later, so that nothing waits. The shaders are in `shaders/inspect/`.

mod combine;
mod look;
mod probe;
mod read;
mod show;
mod texels;
mod written;

use lightbench_assets::files::Files;

use crate::description::PassDesc;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::problem::Problem;
use crate::targets::Targets;

pub use combine::{Combination, Combiner};
pub use look::{FirstInvalid, Part, Shown, Unknown, find_pass, last_writer};
pub use probe::{Invalid, PixelValue, ProbeRequest, Probed, TexelValue};
pub use read::read_any;
pub use show::{Channels, ColorMap, Inspection};
pub use texels::{Aspect, part_in_words};

use probe::Prober;
use show::Shower;

/// The folder of the shaders that look into frames.
pub const INSPECT_SHADERS: &str = "shaders/inspect/";

/// The GPU side of looking into frames.
pub struct Inspector {
    shower: Shower,
    prober: Prober,
    files: Option<Files>,
    problem: Option<Problem>,
    /// Whether it looks at no frame for now.
    resting: bool,
}

impl Inspector {
    /// Looks at nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            shower: Shower::new(gpu),
            prober: Prober::new(gpu),
            files: None,
            problem: None,
            resting: false,
        }
    }

    /// Chooses the target that the next frames show; `None` for nothing. Its shaders come from
    /// `files`.
    pub fn look(&mut self, files: &Files, request: Option<Inspection>) {
        self.files = Some(files.clone());
        self.shower.look(request);
    }

    /// Chooses what is read in the next frame; one frame at a time.
    pub fn probe(&mut self, files: &Files, request: ProbeRequest) {
        self.files = Some(files.clone());
        self.prober.ask(request);
    }

    /// Looks at no frame until it is told to go on; what it was asked for waits. Who draws with two
    /// pipelines in turn looks into the frames of one.
    pub fn rest(&mut self, resting: bool) {
        self.resting = resting;
    }

    /// Reads the shaders again where they are needed next.
    pub fn forget_shaders(&mut self) {
        self.shower.forget_shaders();
        self.prober.forget_shaders();
    }

    /// What is looked at.
    pub fn request(&self) -> Option<&Inspection> {
        self.shower.request()
    }

    /// The picture of the last frame that had the target and the pass. Eight bits a channel,
    /// sRGB-coded, of the size of the mip level.
    pub fn picture(&self) -> Option<&wgpu::Texture> {
        self.shower.picture()
    }

    /// What was read, once it has come back. The device must be polled for it.
    pub fn take_probed(&mut self) -> Option<Probed> {
        self.prober.take()
    }

    /// Whether something is to be read that has not come back.
    pub fn is_probing(&self) -> bool {
        self.prober.is_busy()
    }

    /// A mistake in one of the shaders, once.
    pub fn take_problem(&mut self) -> Option<Problem> {
        self.problem.take()
    }

    /// Whether it looks at a target after this pass, which then must run.
    pub fn wants(&self, pass: usize) -> bool {
        !self.resting && self.request().is_some_and(|request| request.pass == pass)
    }

    /// Called before each pass that runs.
    pub fn before_pass(&mut self, at: &Between<'_>, encoder: &mut wgpu::CommandEncoder) {
        self.during(|this, files| this.prober.before_pass(at, files, encoder));
    }

    /// Called after each pass that ran.
    pub fn after_pass(&mut self, at: &Between<'_>, encoder: &mut wgpu::CommandEncoder) {
        self.during(|this, files| {
            this.prober.after_pass(at, files, encoder)?;
            this.shower.after_pass(at, files, encoder)
        });
    }

    /// Called after the last pass, before the frame is submitted.
    pub fn end_frame(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if !self.resting {
            self.prober.end_frame(encoder);
        }
    }

    /// Called after the frame was submitted.
    pub fn submitted(&mut self) {
        if !self.resting {
            self.prober.submitted();
        }
    }

    fn during(&mut self, look: impl FnOnce(&mut Self, &Files) -> Result<(), Problem>) {
        let Some(files) = self.files.take_if(|_| !self.resting) else {
            return;
        };
        if let Err(problem) = look(self, &files) {
            // What can't be shown is not asked for again.
            self.shower.look(None);
            self.prober.give_up();
            self.problem = Some(problem);
        }
        self.files = Some(files);
    }
}

/// A place between two passes.
#[derive(Clone, Copy)]
pub struct Between<'a> {
    /// The index of the pass.
    pub index: usize,
    /// The pass.
    pub pass: &'a PassDesc,
    /// Which of the frame's lists it draws.
    pub list: Option<usize>,
    /// The targets.
    pub targets: &'a Targets,
    /// The frame.
    pub frame: &'a Frame,
}
