//! Looks into a frame: what each target holds after each pass, what the passes did to a pixel, and
//! which of them made values that are no numbers.

use lightbench_assets::files::Files;
use lightbench_render::inspect::{Aspect, PixelValue, ProbeRequest, Probed};
pub use lightbench_render::inspect::{FirstInvalid, Part};
use lightbench_render::{Pipeline, RenderError, Renderer, TargetImage, View};
use lightbench_script::Scene;

/// Seconds after which a frame counts as hung.
const TIMEOUT: u64 = 60;

/// A frame that can be looked into.
pub struct FrameInspector<'a> {
    renderer: &'a mut Renderer,
    files: &'a Files,
    scene: &'a mut Scene,
    pipeline: &'a mut Pipeline,
    size: (u32, u32),
    frame: u32,
}

impl<'a> FrameInspector<'a> {
    /// Looks into a frame of a scene as it stands. `frame` is its number, for shaders; `files` have
    /// the shaders that read targets.
    pub fn new(
        renderer: &'a mut Renderer,
        files: &'a Files,
        scene: &'a mut Scene,
        pipeline: &'a mut Pipeline,
        size: (u32, u32),
        frame: u32,
    ) -> Self {
        pipeline.keep_all_targets(true);
        Self {
            renderer,
            files,
            scene,
            pipeline,
            size,
            frame,
        }
    }

    /// Draws the whole frame, to see that it can be drawn.
    ///
    /// # Errors
    /// Where it can't.
    pub fn whole(&mut self) -> Result<(), RenderError> {
        self.pipeline.stop_after(None);
        self.draw()
    }

    /// A part of a target, as a pass leaves it.
    ///
    /// # Errors
    /// Where the frame can't be drawn or the target not be read.
    pub fn target(
        &mut self,
        pass: usize,
        target: &str,
        part: Part,
    ) -> Result<TargetImage, RenderError> {
        self.pipeline.stop_after(Some(pass));
        self.draw()?;
        let Part {
            slice,
            sample,
            aspect,
        } = part;
        let samples = self
            .pipeline
            .desc
            .target(target)
            .map_or(1, |desc| desc.samples);
        let read = |sample| {
            self.renderer
                .read_target_any(self.pipeline, self.files, target, slice, sample, aspect)
        };
        if let Some(sample) = sample {
            return read(sample);
        }
        let mut mean = read(0)?;
        for sample in 1..samples {
            let other = read(sample)?;
            for (sum, texel) in mean.texels.iter_mut().zip(&other.texels) {
                (0..4).for_each(|channel| sum[channel] += texel[channel]);
            }
        }
        let share = 1.0 / samples as f32;
        if samples > 1 {
            let values = mean.texels.iter_mut().flatten();
            values.for_each(|value| *value *= share);
        }
        Ok(mean)
    }

    /// What each pass did to a pixel of the output: one entry for each slice and sample of each target
    /// that it wrote, in the order of the passes.
    ///
    /// # Errors
    /// Where the frame can't be drawn.
    pub fn history(&mut self, pixel: (u32, u32)) -> Result<Vec<PixelValue>, RenderError> {
        let request = ProbeRequest {
            pixel: Some(pixel),
            search: false,
        };
        Ok(self.probe(request)?.values)
    }

    /// The first pass that leaves a value in a target that is not a number or infinite.
    ///
    /// # Errors
    /// Where the frame can't be drawn.
    pub fn first_invalid(&mut self) -> Result<Option<FirstInvalid>, RenderError> {
        let request = ProbeRequest {
            pixel: None,
            search: true,
        };
        let Some(place) = self.probe(request)?.invalid.into_iter().next() else {
            return Ok(None);
        };
        let part = Part {
            slice: place.slice,
            sample: place.sample.or(Some(0)),
            aspect: Aspect::Main,
        };
        let image = self.target(place.pass, &place.target, part)?;
        let at = place.first.1 * image.width + place.first.0;
        Ok(Some(FirstInvalid {
            pass: self.pipeline.desc.passes[place.pass].name.clone(),
            value: image.texels.get(at as usize).copied().unwrap_or_default(),
            place,
        }))
    }

    /// Reads between the passes of one whole frame.
    fn probe(&mut self, request: ProbeRequest) -> Result<Probed, RenderError> {
        self.pipeline.stop_after(None);
        // Buffers grow first, where they must.
        self.draw()?;
        self.renderer.finish(TIMEOUT)?;
        self.renderer.inspector().probe(self.files, request);
        self.draw_once()?;
        self.renderer.finish(TIMEOUT)?;
        if let Some(problem) = self.renderer.inspector().take_problem() {
            return Err(RenderError::Shader(problem));
        }
        Ok(self.renderer.inspector().take_probed().unwrap_or_default())
    }

    /// Draws the frame, again where a buffer was too small.
    fn draw(&mut self) -> Result<(), RenderError> {
        self.renderer.set_frame_index(self.frame);
        let view = View::from_world(&self.scene.world).unwrap_or_default();
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        let time = f64::from(self.frame) * crate::capture::STEP;
        self.renderer
            .render_whole(world, assets, self.pipeline, &view, self.size, time)?;
        Ok(())
    }

    fn draw_once(&mut self) -> Result<(), RenderError> {
        self.renderer.set_frame_index(self.frame);
        let view = View::from_world(&self.scene.world).unwrap_or_default();
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        let time = f64::from(self.frame) * crate::capture::STEP;
        self.renderer
            .render(world, assets, self.pipeline, &view, self.size, time)?;
        Ok(())
    }
}

impl Drop for FrameInspector<'_> {
    /// The pipeline draws whole frames again.
    fn drop(&mut self) {
        self.pipeline.stop_after(None);
        self.pipeline.keep_all_targets(false);
    }
}
