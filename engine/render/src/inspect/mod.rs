//! Looks into a frame: a target as it is after a chosen pass and how its values spread, what each pass
//! does to a pixel, and where values are that are no numbers.
//!
//! All of it happens on the GPU between the passes of one frame, and what is to be read comes back
//! some frames later, so that nothing waits. The shaders are in `shaders/inspect/`.

mod combine;
mod look;
mod measure;
mod probe;
mod read;
mod screen;
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
pub use look::{FirstInvalid, Part, Shown, Unknown, find_pass, last_writer, pictures_of};
pub use measure::{BINS, ChannelMeasure, Measured};
pub use probe::{Invalid, PixelValue, ProbeRequest, Probed, TexelValue};
pub use read::read_any;
pub use show::{Channels, ColorMap, Inspection};
pub use texels::{Aspect, part_in_words};

use measure::Measurer;
use probe::Prober;
use show::Shower;

/// The folder of the shaders that look into frames.
pub const INSPECT_SHADERS: &str = "shaders/inspect/";

/// Who looks at a target. Each looks at one, and keeps the pass after which it does alive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Viewer {
    /// A panel beside the picture.
    Panel,
    /// What stands in the picture's place.
    Picture,
}

/// The GPU side of looking into frames.
pub struct Inspector {
    showers: [Shower; 2],
    measurer: Measurer,
    prober: Prober,
    files: Option<Files>,
    problem: Option<Problem>,
    attention: Attention,
}

impl Inspector {
    /// Looks at nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            showers: [Shower::new(gpu), Shower::new(gpu)],
            measurer: Measurer::new(gpu),
            prober: Prober::new(gpu),
            files: None,
            problem: None,
            attention: Attention::default(),
        }
    }

    /// Chooses the target that the next frames show in the panel; `None` for nothing. Its shaders
    /// come from `files`.
    pub fn look(&mut self, files: &Files, request: Option<Inspection>) {
        self.look_as(Viewer::Panel, files, request);
    }

    /// The same for one of those who look.
    pub fn look_as(&mut self, viewer: Viewer, files: &Files, request: Option<Inspection>) {
        self.files = Some(files.clone());
        self.showers[viewer as usize].look(request);
    }

    /// Chooses what is measured in the next frame: least and greatest values of a part of a target,
    /// and how they spread between the two ends of the range. One frame at a time.
    pub fn measure(&mut self, files: &Files, request: Inspection) {
        self.files = Some(files.clone());
        self.measurer.ask(request);
    }

    /// What was measured, once it has come back. The device must be polled for it.
    pub fn take_measured(&mut self) -> Option<Measured> {
        self.measurer.take()
    }

    /// Whether something is to be measured that has not come back.
    pub fn is_measuring(&self) -> bool {
        self.measurer.is_busy()
    }

    /// Chooses what is read in the next frame; one frame at a time.
    pub fn probe(&mut self, files: &Files, request: ProbeRequest) {
        self.files = Some(files.clone());
        self.prober.ask(request);
    }

    /// Reads the shaders again where they are needed next.
    pub fn forget_shaders(&mut self) {
        for shower in &mut self.showers {
            shower.forget_shaders();
        }
        self.measurer.forget_shaders();
        self.prober.forget_shaders();
    }

    /// What the panel looks at.
    pub fn request(&self) -> Option<&Inspection> {
        self.request_of(Viewer::Panel)
    }

    /// What one of those who look looks at.
    pub fn request_of(&self, viewer: Viewer) -> Option<&Inspection> {
        self.showers[viewer as usize].request()
    }

    /// The panel's picture of the last frame that had the target and the pass. Eight bits a channel,
    /// sRGB-coded, of the size of the mip level.
    pub fn picture(&self) -> Option<&wgpu::Texture> {
        self.picture_of(Viewer::Panel)
    }

    /// The same for one of those who look.
    pub fn picture_of(&self, viewer: Viewer) -> Option<&wgpu::Texture> {
        self.showers[viewer as usize].picture()
    }

    /// How the next frames are looked into. Who draws with two pipelines in turn looks into the frames of
    /// one; what was asked for waits meanwhile.
    pub fn attend(&mut self, attention: Attention) {
        self.attention = attention;
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
        if self.attention != Attention::Whole {
            return false;
        }
        let mut requests = self.showers.iter().filter_map(Shower::request);
        requests.any(|request| request.pass == pass) || self.measurer.wants(pass)
    }

    /// Called before each pass that runs.
    pub fn before_pass(&mut self, at: &Between<'_>, encoder: &mut wgpu::CommandEncoder) {
        self.during(|this, files| this.prober.before_pass(at, files, encoder));
    }

    /// Called after each pass that ran.
    pub fn after_pass(&mut self, at: &Between<'_>, encoder: &mut wgpu::CommandEncoder) {
        self.during(|this, files| {
            this.prober.after_pass(at, files, encoder)?;
            if this.attention != Attention::Whole {
                return Ok(());
            }
            this.measurer.after_pass(at, files, encoder)?;
            let mut showers = this.showers.iter_mut();
            showers.try_for_each(|shower| shower.after_pass(at, files, encoder))
        });
    }

    /// Called after the last pass, before the frame is submitted.
    pub fn end_frame(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if self.attention != Attention::Nothing {
            self.prober.end_frame(encoder);
            self.measurer.end_frame(encoder);
        }
    }

    /// Called after the frame was submitted.
    pub fn submitted(&mut self) {
        if self.attention != Attention::Nothing {
            self.prober.submitted();
            self.measurer.submitted();
        }
    }

    fn during(&mut self, look: impl FnOnce(&mut Self, &Files) -> Result<(), Problem>) {
        let blind = self.attention == Attention::Nothing;
        let Some(files) = self.files.take_if(|_| !blind) else {
            return;
        };
        if let Err(problem) = look(self, &files) {
            // What can't be shown is not asked for again.
            self.showers.iter_mut().for_each(|shower| shower.look(None));
            self.measurer.give_up();
            self.prober.give_up();
            self.problem = Some(problem);
        }
        self.files = Some(files);
    }
}

/// How much of a frame is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Attention {
    /// All that was asked for.
    #[default]
    Whole,
    /// Pixels that are read, and nothing that is shown or measured: the frame is another pipeline's
    /// than the one that is looked into.
    Pixels,
    /// Nothing.
    Nothing,
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
