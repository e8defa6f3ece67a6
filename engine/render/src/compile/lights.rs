//! GPU pipelines of `lights` passes.

use lightbench_assets::files::Files;

use super::state::State;
use super::{Compiler, LIGHT_VERTEX, PassLayout};
use crate::description::{Lights, PassDesc, PipelineDesc};
use crate::pipeline::{LightPipelines, PassPipelines};
use crate::problem::Problem;

impl Compiler {
    /// Back faces, front faces and the whole screen; which light takes which is decided per frame.
    pub(super) fn lights(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        _lights: &Lights,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let mut build = |cull, depth_compare, vertex_defines: &'static [&'static str]| {
            let state = State {
                own_vertex: false,
                vertex_defines,
                cull,
                depth_compare,
                ..State::new(LIGHT_VERTEX, pass.depth.as_ref())
            };
            self.build(files, desc, pass, pass.shader.as_ref(), layout, &state)
        };
        use wgpu::CompareFunction::{Always, GreaterEqual, LessEqual};
        // Depth is reversed, so "less" is farther. A back face lights what lies in front of it.
        Ok(PassPipelines::Lights(LightPipelines {
            back: build(Some(wgpu::Face::Front), LessEqual, &[])?,
            front: build(Some(wgpu::Face::Back), GreaterEqual, &[])?,
            screen: build(None, Always, &["FULL_SCREEN"])?,
        }))
    }
}
