//! Drawing light volumes.

use super::raster::Work;
use crate::pipeline::LightPipelines;
use crate::statistics::PassStatistics;
use crate::volumes::Case;

impl Work<'_> {
    pub(super) fn lights(
        &self,
        pipelines: &LightPipelines,
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        let meshes = self.recording.meshes;
        let lists = &self.recording.frame.light_lists;
        let Some(list) = self.pass.list.and_then(|list| lists.get(list)) else {
            return;
        };
        for run in &list.draws {
            let pipeline = match run.kind.case {
                Case::Back => &pipelines.back,
                Case::Front => &pipelines.front,
                Case::Screen => &pipelines.screen,
            };
            render_pass.set_pipeline(&pipeline.pipeline);
            if run.kind.case == Case::Screen {
                render_pass.draw(0..3, run.volumes.clone());
                cost.count(1, &run.volumes);
            } else {
                let shape = meshes.shape(run.kind.shape);
                meshes.bind(render_pass, pipeline.attributes);
                render_pass.draw_indexed(
                    shape.indices.clone(),
                    shape.base_vertex,
                    run.volumes.clone(),
                );
                cost.count(shape.indices.len() / 3, &run.volumes);
            }
        }
    }
}
