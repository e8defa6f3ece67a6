//! The GPU pipeline of a `compute` pass.

use lightbench_assets::files::Files;

use super::cache::PipelineKey;
use super::{Compiler, PassLayout};
use crate::description::PassDesc;
use crate::gpu_pipelines::{ComputePipeline, PassPipelines, Warmth};
use crate::problem::Problem;
use crate::reflection::COMPUTE_ENTRY;

impl Compiler {
    pub(super) fn compute(
        &mut self,
        files: &Files,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let Some(shader) = &pass.shader else {
            return Err(Problem::new(
                pass.at.clone(),
                format!("the pass `{}` has no shader", pass.name),
            ));
        };
        self.load(files, &shader.path, &[], &shader.defines)?;
        let loaded = &self.shaders[&(shader.path.clone(), Vec::new(), shader.defines.clone())];
        let workgroup = loaded.reflection.workgroup_size.unwrap_or([1; 3]);
        let key = PipelineKey {
            vertex: loaded.shader.fingerprint,
            fragment: None,
            state: format!("compute {}", layout.key),
        };
        if let Some(pipeline) = self.built.get_compute(&key) {
            return Ok(PassPipelines::Compute(pipeline));
        }
        let descriptor = wgpu::ComputePipelineDescriptor {
            label: Some(&pass.name),
            layout: Some(&layout.layout),
            module: &loaded.module,
            entry_point: Some(COMPUTE_ENTRY),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        };
        let pipeline = self
            .gpu
            .guarded(|| self.gpu.device.create_compute_pipeline(&descriptor))
            .map_err(|error| {
                Problem::new(
                    shader.at.clone(),
                    format!("the pass `{}` can't be built: {error}", pass.name),
                )
            })?;
        let pipeline = ComputePipeline {
            pipeline,
            workgroup,
            warmth: Warmth::default(),
        };
        self.built.insert_compute(key, &pipeline);
        Ok(PassPipelines::Compute(pipeline))
    }
}
