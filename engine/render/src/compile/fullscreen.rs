//! The GPU pipeline of a `fullscreen` pass.

use lightbench_assets::files::Files;

use super::state::State;
use super::{Compiler, FULLSCREEN_VERTEX, PassLayout};
use crate::description::{PassDesc, PipelineDesc};
use crate::gpu_pipelines::PassPipelines;
use crate::problem::Problem;

impl Compiler {
    pub(super) fn fullscreen(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let state = State::new(FULLSCREEN_VERTEX, pass.depth.as_ref());
        let built = self.build(files, desc, pass, pass.shader.as_ref(), layout, &state)?;
        Ok(PassPipelines::Fullscreen(built))
    }
}
