//! Looks into a frame: what each target holds after each pass.
//!
//! The frame is drawn again and again, each time up to one pass more, and targets are read back. That
//! is slow and exact; the editor's panels show targets without reading them.

use lightbench_render::description::Slice;
use lightbench_render::{Pipeline, RenderError, Renderer, TargetImage, View, life};
use lightbench_script::Scene;

/// A frame that can be looked into.
pub struct FrameInspector<'a> {
    renderer: &'a mut Renderer,
    scene: &'a mut Scene,
    pipeline: &'a mut Pipeline,
    size: (u32, u32),
    frame: u32,
}

/// The value of a target at a pixel after a pass that wrote the target.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelValue {
    /// The pass.
    pub pass: String,
    /// The target.
    pub target: String,
    /// Before the pass, as the target's format decodes; zeros where nothing was.
    pub before: [f32; 4],
    /// After it.
    pub after: [f32; 4],
    /// Channels that the format has.
    pub channels: u32,
}

/// The first value that is no number.
#[derive(Clone, Debug, PartialEq)]
pub struct Invalid {
    /// The pass that wrote it.
    pub pass: String,
    /// The target.
    pub target: String,
    /// The first texel of it, from the upper left corner.
    pub texel: (u32, u32),
    /// The texel.
    pub value: [f32; 4],
    /// How many texels of the target hold one.
    pub texels: usize,
}

impl<'a> FrameInspector<'a> {
    /// Looks into a frame of a scene as it stands. `frame` is its number, for shaders.
    pub fn new(
        renderer: &'a mut Renderer,
        scene: &'a mut Scene,
        pipeline: &'a mut Pipeline,
        size: (u32, u32),
        frame: u32,
    ) -> Self {
        pipeline.keep_all_targets(true);
        Self {
            renderer,
            scene,
            pipeline,
            size,
            frame,
        }
    }

    /// One mip level of one layer of a target, as a pass leaves it.
    ///
    /// # Errors
    /// Where the frame can't be drawn or the target not be read.
    pub fn target(
        &mut self,
        pass: usize,
        target: &str,
        slice: Slice,
    ) -> Result<TargetImage, RenderError> {
        self.draw(pass)?;
        self.renderer
            .read_target_slice(self.pipeline, target, slice)
    }

    /// What each pass did to a pixel of the output: one entry for each target that it wrote, in the
    /// order of the passes. In targets of another size it is the texel at the same place. Targets
    /// that can't be read, since they have several samples, are left out.
    ///
    /// # Errors
    /// Where the frame can't be drawn.
    pub fn history(&mut self, (x, y): (u32, u32)) -> Result<Vec<PixelValue>, RenderError> {
        let mut history: Vec<PixelValue> = Vec::new();
        for pass in 0..self.pipeline.desc.passes.len() {
            self.draw(pass)?;
            for target in self.written(pass) {
                let Ok(image) = self.renderer.read_target(self.pipeline, &target) else {
                    continue;
                };
                let scaled = |at: u32, length: u32, of: u32| {
                    (u64::from(at) * u64::from(length) / u64::from(of.max(1))) as usize
                };
                let column = scaled(x, image.width, self.size.0);
                let row = scaled(y, image.height, self.size.1);
                let at = row * image.width as usize + column;
                let after = image.texels.get(at).copied().unwrap_or_default();
                let before = history.iter().rev().find(|value| value.target == target);
                history.push(PixelValue {
                    pass: self.pipeline.desc.passes[pass].name.clone(),
                    before: before.map_or([0.0; 4], |value| value.after),
                    target,
                    after,
                    channels: image.channels,
                });
            }
        }
        Ok(history)
    }

    /// The first pass that leaves a value in a target that is not a number or infinite. It looks at
    /// the first mip level and layer, and not at targets with several samples.
    ///
    /// # Errors
    /// Where the frame can't be drawn.
    pub fn first_invalid(&mut self) -> Result<Option<Invalid>, RenderError> {
        let invalid = |texel: &[f32; 4]| texel.iter().any(|value| !value.is_finite());
        for pass in 0..self.pipeline.desc.passes.len() {
            self.draw(pass)?;
            for target in self.written(pass) {
                let Ok(image) = self.renderer.read_target(self.pipeline, &target) else {
                    continue;
                };
                let Some(at) = image.texels.iter().position(invalid) else {
                    continue;
                };
                let width = image.width.max(1);
                return Ok(Some(Invalid {
                    pass: self.pipeline.desc.passes[pass].name.clone(),
                    texel: (at as u32 % width, at as u32 / width),
                    value: image.texels[at],
                    texels: image.texels.iter().filter(|texel| invalid(texel)).count(),
                    target,
                }));
            }
        }
        Ok(None)
    }

    /// Draws the frame up to a pass.
    fn draw(&mut self, pass: usize) -> Result<(), RenderError> {
        self.pipeline.stop_after(Some(pass));
        self.renderer.set_frame_index(self.frame);
        let view = View::from_world(&self.scene.world).unwrap_or_default();
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        let time = f64::from(self.frame) * crate::capture::STEP;
        self.renderer
            .render_whole(world, assets, self.pipeline, &view, self.size, time)?;
        Ok(())
    }

    /// The targets that a pass writes, each once.
    fn written(&self, pass: usize) -> Vec<String> {
        let desc = &self.pipeline.desc;
        let mut names: Vec<String> = Vec::new();
        for name in life::writes(&desc.passes[pass]) {
            if desc.target(name).is_some() && !names.iter().any(|known| known == name) {
                names.push(name.to_owned());
            }
        }
        names
    }
}

impl Drop for FrameInspector<'_> {
    /// The pipeline draws whole frames again.
    fn drop(&mut self) {
        self.pipeline.stop_after(None);
        self.pipeline.keep_all_targets(false);
    }
}
