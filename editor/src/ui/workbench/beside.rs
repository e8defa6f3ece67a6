//! The probed pixel under another pipeline, which is drawn once and not shown.

use lightbench::render::RenderError;
use lightbench::render::inspect::{Attention, PixelValue, ProbeRequest, Probed};
use lightbench::render::{PipelineDesc, queries::Measured};

use super::Workbench;

/// What a pipeline leaves in a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Results {
    /// Light before the last pass, where the pipeline names its target.
    pub hdr: Option<[f32; 4]>,
    /// What is on the screen, from 0 to 1.
    pub output: Option<[f32; 4]>,
}

impl Results {
    /// From what the passes of a pipeline did to a pixel.
    pub fn of(desc: &PipelineDesc, values: &[PixelValue]) -> Self {
        let last = |name: &str| {
            let of_target = |value: &&PixelValue| value.target == name;
            let last = values.iter().rfind(of_target)?;
            // All samples of the last pass that wrote it, as the mean that is shown.
            let same = |value: &&PixelValue| {
                value.target == name && value.pass == last.pass && value.slice == last.slice
            };
            let (mut sum, mut count) = ([0.0; 4], 0.0);
            for value in values.iter().filter(same) {
                let numbers = value.after.to_floats();
                sum.iter_mut()
                    .zip(numbers)
                    .for_each(|(sum, number)| *sum += number);
                count += 1.0;
            }
            Some(sum.map(|sum| sum / count))
        };
        let named = |named: &Option<lightbench::render::description::Named>| {
            named.as_ref().and_then(|named| last(&named.name))
        };
        Self {
            hdr: named(&desc.hdr),
            output: named(&desc.output),
        }
    }
}

/// How far it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Stage {
    /// Nothing is to be done.
    #[default]
    Done,
    /// The pipeline is built and warmed.
    Building,
    /// It was drawn, and what was read is on its way.
    Drawn,
}

/// The same pixel under another pipeline.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// The other pipeline, by its name.
    pub pipeline: Option<String>,
    /// What it leaves in the pixel.
    pub results: Option<Results>,
    /// Why it leaves nothing.
    pub problem: Option<String>,
    /// The pixel and the size of the picture of which that is.
    of: Option<((u32, u32), (u32, u32))>,
    stage: Stage,
    probed: Option<Results>,
    /// Whether its buffers are large enough, where they may not be.
    fits: bool,
    /// Whether what is read next was read in another pipeline's frame.
    reads: bool,
    /// The number of that frame, until it is measured.
    frame: Option<u32>,
}

impl Beside {
    /// Whether a result is on its way.
    pub fn is_waiting(&self) -> bool {
        self.stage != Stage::Done
    }

    /// Whether what is read next was read in another pipeline's frame.
    pub(super) fn reads(&self) -> bool {
        self.reads
    }

    /// Another pipeline or pixel; what is on its way is still to come.
    fn change(&mut self, pipeline: Option<String>) {
        *self = Self {
            pipeline,
            reads: self.reads,
            frame: self.frame,
            ..Self::default()
        };
    }

    fn fail(&mut self, problem: String) {
        self.stage = Stage::Done;
        self.problem = Some(problem);
    }
}

impl Workbench {
    /// Chooses another pipeline for the probed pixel, or none.
    pub fn put_beside(&mut self, pipeline: Option<&str>) {
        self.beside.change(pipeline.map(str::to_owned));
        self.draw_beside();
    }

    /// Draws the probed pixel again with the other pipeline, if there is one.
    pub fn draw_beside(&mut self) {
        let (Some(pixel), Some(size)) = (self.probing.pixel, self.probing.size) else {
            return;
        };
        let Some(name) = self.beside.pipeline.clone() else {
            return;
        };
        self.pipelines.build_beside(&name);
        self.beside.change(Some(name));
        self.beside.of = Some((pixel, size));
        self.beside.stage = Stage::Building;
    }

    /// Goes one step on, once the frame on screen is drawn and the device has room.
    pub(super) fn go_on_beside(&mut self) {
        let is_free = !self.beside.reads && !self.renderer.inspector().is_probing();
        if self.beside.stage != Stage::Building || !is_free {
            return;
        }
        let (Some(name), Some((pixel, size))) = (self.beside.pipeline.clone(), self.beside.of)
        else {
            return;
        };
        let (view, time) = (self.camera.view(), self.clock.time());
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        let (world, assets) = (&mut scene.world, &scene.assets);
        let pipeline = match self.pipelines.beside(&name) {
            Ok(Some(pipeline)) => pipeline,
            // It may have been told to be built anew meanwhile.
            Ok(None) => return self.pipelines.build_beside(&name),
            Err(problem) => return self.beside.fail(problem),
        };
        let warm = self
            .renderer
            .warm_up(world, assets, pipeline, &view, size, time);
        let drawn = match warm {
            Ok(false) => return,
            Err(error) => Err(error),
            Ok(true) => {
                let request = ProbeRequest {
                    pixel: Some(pixel),
                    search: false,
                };
                let index = self.renderer.frame_index();
                let inspector = self.renderer.inspector();
                inspector.probe(&self.files, request);
                inspector.attend(Attention::Pixels);
                // The moment that is on screen, as the pipeline there saw it.
                self.renderer.set_frame_index(index.saturating_sub(1));
                let frame = self.renderer.next_frame();
                let drawn = self
                    .renderer
                    .render(world, assets, pipeline, &view, size, time)
                    .map(|_| ());
                self.renderer.set_frame_index(index);
                self.renderer.inspector().attend(Attention::Whole);
                self.beside.fits = !pipeline.may_outgrow();
                drawn.map(|()| {
                    self.beside.stage = Stage::Drawn;
                    self.beside.reads = true;
                    self.beside.frame = Some(frame);
                })
            }
        };
        match drawn {
            Ok(()) => {}
            Err(RenderError::NotBuilt(variants)) => {
                self.pipelines.need(variants);
                self.pipelines.build_beside(&name);
            }
            Err(RenderError::Gpu(error)) => {
                self.beside.fail(error.to_string());
                self.device_failed(error);
            }
            Err(error) => self.beside.fail(error.to_string()),
        }
    }

    /// Takes in what was read, if it was read in the other pipeline's frame. Says whether it was.
    pub(super) fn take_beside(&mut self, probed: &Probed) -> bool {
        if !std::mem::take(&mut self.beside.reads) {
            return false;
        }
        if self.beside.stage != Stage::Drawn {
            // Somebody wants to know something else by now.
            return true;
        }
        let name = self.beside.pipeline.clone().unwrap_or_default();
        match self.pipelines.beside(&name) {
            Ok(Some(pipeline)) => {
                self.beside.probed = Some(Results::of(&pipeline.desc, &probed.values));
                self.end_beside();
            }
            // Its files changed meanwhile.
            _ => self.beside.stage = Stage::Building,
        }
        true
    }

    /// Takes the measurement of the other pipeline's frame out of those that came back.
    pub(super) fn measured_beside(&mut self, results: &mut Vec<Measured>) {
        let Some(frame) = self.beside.frame else {
            return;
        };
        let own = results.iter().position(|measured| measured.frame == frame);
        let Some(own) = own.map(|own| results.remove(own)) else {
            return;
        };
        self.beside.frame = None;
        if self.beside.stage != Stage::Drawn {
            return;
        }
        let name = self.beside.pipeline.clone().unwrap_or_default();
        if let Ok(Some(pipeline)) = self.pipelines.beside(&name)
            && pipeline.grow(&[own])
        {
            // A buffer was too small, so that what was read is not what the pipeline draws.
            self.beside.stage = Stage::Building;
            self.beside.probed = None;
            return;
        }
        self.beside.fits = true;
        self.end_beside();
    }

    fn end_beside(&mut self) {
        if let Some(results) = self.beside.probed.filter(|_| self.beside.fits) {
            self.beside.stage = Stage::Done;
            self.beside.results = Some(results);
            let name = self.beside.pipeline.clone().unwrap_or_default();
            self.pipelines.release_beside(&name);
        }
    }

    /// What the other pipeline leaves in the pixel that is probed.
    pub fn pixel_beside(&self) -> Option<Results> {
        let probing = &self.probing;
        let now = probing.pixel.zip(probing.size);
        self.beside.results.filter(|_| self.beside.of == now)
    }
}
