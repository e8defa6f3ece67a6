//! Drawing light volumes.

use super::raster::Work;
use crate::gpu_pipelines::{DrawPipeline, LightsPipelines};
use crate::statistics::PassStatistics;
use crate::volumes::{Case, Marking, VolumeDraw};

/// Marks that the eight bits of stencil tell apart; 0 is "not marked".
pub(super) const MARKS: u32 = 255;

impl Work<'_> {
    pub(super) fn lights(
        &self,
        pipelines: &LightsPipelines,
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        let lists = &self.recording.frame.light_lists;
        let Some(list) = self.pass.list.and_then(|list| lists.get(list)) else {
            return;
        };
        cost.unplaced_lights = list.unplaced;
        let mut marked = 0;
        for run in &list.draws {
            let Some(array) = pipelines.arrays.get(run.array as usize) else {
                continue;
            };
            let stencil = pipelines.stencil.as_ref();
            match (run.marking, stencil, &array.marked, &array.counted) {
                (Marking::Scheme, Some(stencil), Some(shade), _) => {
                    // Each light has a mark of its own; when all are used up, they are wiped away.
                    if marked > 0 && marked % MARKS == 0 {
                        self.screen(&stencil.wipe, 0, render_pass, cost);
                    }
                    render_pass.set_stencil_reference(1 + marked % MARKS);
                    marked += 1;
                    self.volume(&stencil.mark, run, render_pass, cost);
                    self.volume(shade, run, render_pass, cost);
                }
                (Marking::Count, Some(stencil), _, Some(shade)) => {
                    // Counts begin at zero, and shading leaves them so.
                    if marked > 0 {
                        self.screen(&stencil.wipe, 0, render_pass, cost);
                        marked = 0;
                    }
                    render_pass.set_stencil_reference(0);
                    self.volume(&stencil.count, run, render_pass, cost);
                    self.volume(shade, run, render_pass, cost);
                }
                _ => self.volume(array.of(run.kind.case), run, render_pass, cost),
            }
        }
    }

    /// Draws volumes, or the whole screen for each.
    pub(super) fn volume(
        &self,
        pipeline: &DrawPipeline,
        run: &VolumeDraw,
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        pipeline.set(render_pass);
        if run.kind.case == Case::Screen {
            render_pass.draw(0..3, run.volumes.clone());
            cost.count(1, &run.volumes);
            return;
        }
        let meshes = self.recording.meshes;
        let Some(shape) = meshes.shape(run.kind.shape) else {
            return;
        };
        meshes.bind(render_pass, pipeline.attributes);
        render_pass.draw_indexed(
            shape.indices.clone(),
            shape.base_vertex,
            run.volumes.clone(),
        );
        cost.count(shape.indices.len() / 3, &run.volumes);
    }

    /// Draws one triangle over the whole target, with a stencil reference.
    pub(super) fn screen(
        &self,
        pipeline: &DrawPipeline,
        reference: u32,
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        pipeline.set(render_pass);
        render_pass.set_stencil_reference(reference);
        render_pass.draw(0..3, 0..1);
        cost.count(1, &(0..1));
    }
}
