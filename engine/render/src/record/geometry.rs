//! Drawing meshes.

use super::lights::MARKS;
use super::raster::Work;
use crate::frame::{MeshDraw, Step};
use crate::gpu_pipelines::{GeometryPipelines, MaskPipelines};
use crate::statistics::PassStatistics;
use crate::volumes::{Case, VolumeDraw};

impl Work<'_> {
    pub(super) fn geometry(
        &self,
        pipelines: &GeometryPipelines,
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        let lists = &self.recording.frame.lists;
        let Some(list) = self.pass.list.and_then(|list| lists.get(list)) else {
            return;
        };
        let mut marked = 0;
        for step in &list.steps {
            if !self.limit(step, render_pass) {
                continue;
            }
            if let (Some(mask), Some(volume)) = (&pipelines.mask, &step.mark) {
                if marked > 0 && marked % MARKS == 0 {
                    self.screen(&mask.screen, 0, render_pass, cost);
                }
                self.mark(mask, volume, 1 + marked % MARKS, render_pass, cost);
                marked += 1;
            }
            let draws = &list.draws[step.draws.clone()];
            self.draws(pipelines, draws, render_pass, cost);
        }
    }

    pub(super) fn draws(
        &self,
        pipelines: &GeometryPipelines,
        draws: &[MeshDraw],
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        let meshes = self.recording.meshes;
        let mut bound = None;
        for run in draws {
            let (Some(Some(pipeline)), Some(mesh)) = (
                pipelines.variants.get(run.variant.index()),
                meshes.range(run.mesh),
            ) else {
                continue;
            };
            if bound != Some(run.variant) {
                pipeline.set(render_pass);
                meshes.bind(render_pass, pipeline.attributes);
                bound = Some(run.variant);
            }
            if pipelines.pull_vertices {
                render_pass.draw(0..mesh.indices.len() as u32, run.objects.clone());
            } else {
                let indices = mesh.indices.clone();
                render_pass.draw_indexed(indices, mesh.base_vertex, run.objects.clone());
            }
            cost.count(mesh.indices.len() / 3, &run.objects);
        }
    }

    /// Limits a step to its rectangle; false where nothing is left of it.
    fn limit(&self, step: &Step, render_pass: &mut wgpu::RenderPass<'_>) -> bool {
        let Some([left, top, right, bottom]) = step.scissor else {
            return true;
        };
        let (width, height) = self.attachment_size();
        let low = |share: f32, length: u32| ((share * length as f32).floor() as u32).min(length);
        let high = |share: f32, length: u32| ((share * length as f32).ceil() as u32).min(length);
        let (x, y) = (low(left, width), low(top, height));
        let (end_x, end_y) = (high(right, width), high(bottom, height));
        if end_x <= x || end_y <= y {
            return false;
        }
        render_pass.set_scissor_rect(x, y, end_x - x, end_y - y);
        true
    }

    /// Marks the pixels whose surface lies inside a light's volume.
    fn mark(
        &self,
        mask: &MaskPipelines,
        volume: &VolumeDraw,
        reference: u32,
        render_pass: &mut wgpu::RenderPass<'_>,
        cost: &mut PassStatistics,
    ) {
        // Where the far plane may cut the back faces, all pixels are marked.
        if volume.kind.case != Case::Back {
            self.screen(&mask.screen, reference, render_pass, cost);
            return;
        }
        render_pass.set_stencil_reference(reference);
        self.volume(&mask.back, volume, render_pass, cost);
        self.volume(&mask.front, volume, render_pass, cost);
    }
}
