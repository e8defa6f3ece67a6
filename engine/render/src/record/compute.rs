//! Compute passes.

use super::raster::Work;
use crate::description::Dispatch;
use crate::statistics::PassStatistics;

impl Work<'_> {
    pub(super) fn compute(
        &self,
        dispatch: &Dispatch,
        pipeline: &wgpu::ComputePipeline,
        encoder: &mut wgpu::CommandEncoder,
        cost: &mut PassStatistics,
    ) {
        let mut compute_pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(&self.desc.name),
            timestamp_writes: self.queries.compute_timestamps(self.index),
        });
        compute_pass.set_pipeline(pipeline);
        compute_pass.set_bind_group(0, self.recording.scene, &[0]);
        if let Some(group) = &self.pass.target_group {
            compute_pass.set_bind_group(1, group, &[]);
        }
        if let Some(parameters) = &self.pass.parameters {
            compute_pass.set_bind_group(2, &parameters.group, &[]);
        }
        match dispatch {
            Dispatch::Indirect { buffer, word } => {
                if let Some(buffer) = self.targets.buffer(buffer) {
                    compute_pass.dispatch_workgroups_indirect(buffer, u64::from(*word) * 4);
                    cost.dispatches += 1;
                }
            }
            Dispatch::Threads(_) | Dispatch::Groups(_) => {
                let [x, y, z] = self.pass.workgroups;
                compute_pass.dispatch_workgroups(x, y, z);
                cost.dispatches += 1;
                cost.workgroups = Some(u64::from(x) * u64::from(y) * u64::from(z));
            }
        }
    }
}
