//! Drawing meshes.

use super::raster::Work;
use crate::compile::DrawPipeline;
use crate::statistics::PassStatistics;

impl Work<'_> {
    pub(super) fn geometry(
        &self,
        variants: &[DrawPipeline],
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        let meshes = self.recording.meshes;
        let lists = &self.recording.frame.lists;
        let Some(list) = self.pass.list.and_then(|list| lists.get(list)) else {
            return;
        };
        let mut bound = None;
        for run in &list.draws {
            let (Some(pipeline), Some(mesh)) =
                (variants.get(run.variant.index()), meshes.range(run.mesh))
            else {
                continue;
            };
            if bound != Some(run.variant) {
                render_pass.set_pipeline(&pipeline.pipeline);
                meshes.bind(render_pass, pipeline.attributes);
                bound = Some(run.variant);
            }
            render_pass.draw_indexed(mesh.indices.clone(), mesh.base_vertex, run.objects.clone());
            cost.count(mesh.indices.len() / 3, &run.objects);
        }
    }
}
