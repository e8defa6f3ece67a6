//! Compute passes.

use super::raster::Work;
use crate::description::Dispatch;
use crate::gpu_pipelines::ComputePipeline;
use crate::statistics::PassStatistics;

impl Work<'_> {
    pub(super) fn compute(
        &self,
        dispatch: &Dispatch,
        pipeline: &ComputePipeline,
        encoder: &mut wgpu::CommandEncoder,
        cost: &mut PassStatistics,
    ) {
        let mut compute_pass = self.begin_compute(pipeline, encoder);
        match dispatch {
            Dispatch::Indirect { buffer, word } => {
                if let Some(buffer) = self.targets.buffer(buffer) {
                    compute_pass.dispatch_workgroups_indirect(buffer, u64::from(*word) * 4);
                    cost.dispatches += 1;
                }
            }
            Dispatch::Threads(_) | Dispatch::Groups(_) => {
                let [x, y, z] = self.pass.bound.workgroups;
                compute_pass.dispatch_workgroups(x, y, z);
                cost.dispatches += 1;
                cost.workgroups = Some(u64::from(x) * u64::from(y) * u64::from(z));
            }
        }
    }

    /// Opens a compute pass with everything bound.
    pub(super) fn begin_compute<'e>(
        &self,
        pipeline: &ComputePipeline,
        encoder: &'e mut wgpu::CommandEncoder,
    ) -> wgpu::ComputePass<'e> {
        let mut compute_pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(&self.desc.name),
            timestamp_writes: self.queries.compute_timestamps(self.index),
        });
        pipeline.set(&mut compute_pass);
        compute_pass.set_bind_group(0, self.recording.scene, &[0]);
        if let Some(group) = &self.pass.bound.target_group {
            compute_pass.set_bind_group(1, group, &[]);
        }
        if let Some(parameters) = &self.pass.parameters {
            compute_pass.set_bind_group(2, &parameters.group, &[]);
        }
        compute_pass
    }
}
