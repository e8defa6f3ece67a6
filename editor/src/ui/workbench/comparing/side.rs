//! The pipelines of B, and what their frames cost.

use lightbench::assets::files::Files;
use lightbench::render::queries::Measured;
use lightbench::render::{Compiler, FrameStatistics, Problem};

use crate::ui::workbench::Wake;
use crate::ui::workbench::pipelines::Pipelines;
use crate::ui::workbench::timing::Timings;

/// One side of the comparison.
pub struct Side {
    /// Visited pipelines.
    pub pipelines: Pipelines,
    /// What its frames cost.
    pub timings: Timings,
    /// The cost of the last one.
    pub statistics: FrameStatistics,
    /// Why the last one was not drawn.
    pub(super) problem: Option<Problem>,
    /// The size of its picture.
    pub(super) size: Option<(u32, u32)>,
}

impl Side {
    /// Nothing is built yet.
    pub(super) fn new(compiler: Compiler, files: Files, wake: Wake) -> Self {
        Self {
            pipelines: Pipelines::new(compiler, files, wake),
            timings: Timings::default(),
            statistics: FrameStatistics::default(),
            problem: None,
            size: None,
        }
    }

    pub(super) fn select(&mut self, name: &str) {
        let before = self.pipelines.shown().map(str::to_owned);
        self.pipelines.select(name);
        if self.pipelines.shown() != before.as_deref() {
            self.timings.reset();
        }
    }

    /// Gives back the memory of its pictures.
    pub(super) fn rest(&mut self) {
        self.timings.reset();
        self.size = None;
        self.problem = None;
        if let Some(pipeline) = self.pipelines.shown_pipeline() {
            pipeline.release_targets();
        }
        self.pipelines.release_hidden();
    }

    /// Takes in what was measured of its frames. Returns whether a buffer was too small.
    pub(super) fn measured(&mut self, results: &[Measured]) -> bool {
        for measured in results {
            self.timings.measured(measured);
        }
        let pipeline = self.pipelines.shown_pipeline();
        pipeline.is_some_and(|pipeline| pipeline.grow(results))
    }

    /// Its picture, where one was drawn.
    pub(super) fn picture(&mut self) -> Option<wgpu::Texture> {
        self.size?;
        let pipeline = self.pipelines.shown_pipeline()?;
        let output = pipeline.desc.output.as_ref()?.name.as_str();
        Some(pipeline.targets()?.get(output)?.texture.clone())
    }
}
