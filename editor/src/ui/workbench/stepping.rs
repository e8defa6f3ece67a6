//! The picture as it stands after one pass: a walk through the frame.

use lightbench::render::PipelineDesc;
use lightbench::render::inspect::{Inspection, Viewer, pictures_of};
use lightbench::render::life::writes;

use super::Workbench;

/// Where in the frame the picture stops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The pass, which may be at another place in another pipeline.
    pass: String,
    /// The target that somebody chose of those that the pass writes.
    target: Option<String>,
}

/// What stands in the picture's place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// The number of the pass, from 0.
    pub index: usize,
    /// How many passes there are.
    pub count: usize,
    /// The pass.
    pub pass: String,
    /// Whether the pass is left out of frames, as long as nobody looks.
    pub is_left_out: bool,
    /// The targets that it writes and that can be shown; empty where it writes buffers alone.
    pub targets: Vec<String>,
    /// The target that is shown, and after which pass: an earlier one where this one writes none.
    pub shown: Option<(String, usize)>,
    /// What else it writes: buffers.
    pub buffers: Vec<String>,
}

impl Workbench {
    /// Stops the picture after a pass, by its number; `None` for the whole frame.
    pub fn stop_after(&mut self, pass: Option<usize>) {
        let name = pass.and_then(|pass| {
            let desc = &self.pipelines.shown_pipeline()?.desc;
            Some(desc.passes.get(pass)?.name.clone())
        });
        self.stop = name.map(|pass| Stop { pass, target: None });
        self.follow_stop();
    }

    /// Whether the picture stops after a pass.
    pub fn is_stopped(&self) -> bool {
        self.stop.is_some()
    }

    /// Goes so many passes on, or back. Before the first pass and behind the last comes the whole frame.
    pub fn stop_by(&mut self, by: isize) {
        let stopped = self.stopped();
        let Some(count) = self
            .pipelines
            .shown_pipeline()
            .map(|pipeline| pipeline.desc.passes.len())
        else {
            return;
        };
        // The whole frame is one place more, before the first and behind the last.
        let at = stopped.map_or(0, |stopped| stopped.index + 1) as isize;
        let to = (at + by).rem_euclid(count as isize + 1) as usize;
        self.stop_after(to.checked_sub(1));
    }

    /// Shows another of the targets that the pass writes.
    pub fn stop_at_target(&mut self, target: &str) {
        if let Some(stop) = &mut self.stop {
            stop.target = Some(target.to_owned());
        }
        self.follow_stop();
    }

    /// Where the picture stops.
    pub fn stopped(&mut self) -> Option<Stopped> {
        let stop = self.stop.clone()?;
        let pipeline = self.pipelines.shown_pipeline()?;
        let desc = &pipeline.desc;
        let index = desc.passes.iter().position(|pass| pass.name == stop.pass)?;
        let pass = &desc.passes[index];
        let targets = pictures_of(desc, pass);
        let is_buffer = |name: &&str| desc.target(name).is_none();
        let chosen = stop.target.as_deref();
        Some(Stopped {
            index,
            count: desc.passes.len(),
            pass: stop.pass.clone(),
            is_left_out: !pipeline.lives().needed.get(index).copied().unwrap_or(true),
            shown: shown(desc, index, chosen).map(|(target, pass)| (target.to_owned(), pass)),
            targets: targets.into_iter().map(str::to_owned).collect(),
            buffers: writes(pass).filter(is_buffer).map(str::to_owned).collect(),
        })
    }

    /// The picture of the target that the pass left, once it was drawn.
    pub fn stopped_picture(&mut self) -> Option<wgpu::Texture> {
        self.stop.as_ref()?;
        let inspector = self.renderer.inspector();
        inspector.picture_of(Viewer::Picture).cloned()
    }

    /// Asks for what is to be shown, where that changed: also when another pipeline came.
    pub(super) fn follow_stop(&mut self) {
        let looks = self.renderer.inspector().request_of(Viewer::Picture);
        if self.stop.is_none() && looks.is_none() {
            return;
        }
        let far = self.far_shown();
        let wanted = self.stopped().and_then(|stopped| {
            let desc = &self.pipelines.shown_pipeline()?.desc;
            let (target, pass) = stopped.shown?;
            Inspection::suited(desc, pass, &target, far)
        });
        let has_picture = self.pipelines.shown_pipeline().is_some();
        if self.stop.is_some() && has_picture && self.stopped().is_none() {
            // The pipeline that came has no pass of that name.
            self.stop = None;
        }
        let inspector = self.renderer.inspector();
        if inspector.request_of(Viewer::Picture) != wanted.as_ref() {
            inspector.look_as(Viewer::Picture, &self.files, wanted);
            // The same frame, at the same size.
            self.canvas.repeat();
        }
    }

    /// The distance at which depth is shown brightest, metres.
    pub fn far_shown(&self) -> f32 {
        let distance = self.typical_distance().unwrap_or(5.0);
        (distance * 3.0).clamp(0.1, 1e6)
    }
}

/// The target to show after a pass, and the pass that left it: the chosen one, or the first of those
/// that the pass writes, or of the nearest pass before it that writes any.
fn shown<'a>(
    desc: &'a PipelineDesc,
    index: usize,
    chosen: Option<&str>,
) -> Option<(&'a str, usize)> {
    let passes = desc.passes.iter().enumerate().take(index + 1);
    passes.rev().find_map(|(at, pass)| {
        let targets = pictures_of(desc, pass);
        let chosen = targets.iter().find(|name| Some(**name) == chosen);
        let target = chosen.or(targets.first())?;
        Some((*target, at))
    })
}
