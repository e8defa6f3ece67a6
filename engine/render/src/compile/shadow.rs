//! GPU pipelines of `shadow` passes.

use lightbench_assets::files::Files;

use super::{Compiler, PassLayout};
use crate::description::{Geometry, PassDesc, PipelineDesc, ShaderDesc, Shadow};
use crate::gpu_pipelines::PassPipelines;
use crate::problem::Problem;

/// What leaves the holes of alpha-tested casters, unless the pass brings a shader of its own.
const SHADOW_SHADER: &str = "shaders/forward/depth_only.wgsl";

impl Compiler {
    /// Those of a depth-only `geometry` pass.
    pub(super) fn shadow(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        shadow: &Shadow,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let geometry = Geometry {
            faces: shadow.faces,
            ..Geometry::default()
        };
        let holes = ShaderDesc {
            path: SHADOW_SHADER.to_owned(),
            at: pass.at.clone(),
            defines: Vec::new(),
        };
        let pass = PassDesc {
            shader: Some(pass.shader.clone().unwrap_or(holes)),
            ..pass.clone()
        };
        let built = self.variants_of(files, desc, &pass, &geometry, layout)?;
        Ok(PassPipelines::Shadow(built))
    }
}
