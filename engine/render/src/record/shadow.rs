//! Drawing what lights see: one render pass a layer.

use super::raster::{Work, kept, store};
use crate::description::Load;
use crate::gpu_pipelines::GeometryPipelines;
use crate::statistics::PassStatistics;

impl Work<'_> {
    pub(super) fn shadow(
        &self,
        pipelines: &GeometryPipelines,
        encoder: &mut wgpu::CommandEncoder,
        cost: &mut PassStatistics,
    ) {
        let lists = &self.recording.frame.shadow_lists;
        let Some(list) = self.pass.list.and_then(|list| lists.get(list)) else {
            return;
        };
        cost.unplaced_lights = list.unplaced;
        let layers = &self.pass.bound.attachments.layers;
        let views = list.views.len().min(layers.len());
        for (part, (view, layer)) in list.views.iter().zip(layers).enumerate() {
            let timestamps = self.queries.span(self.index, part, views);
            let mut render_pass = self.layer(layer, timestamps, encoder);
            let offset = self.recording.view_offset(view.view);
            self.bind_groups(offset, &mut render_pass);
            let draws = &list.draws[view.draws.clone()];
            self.draws(pipelines, draws, &mut render_pass, cost);
        }
    }

    /// Opens a render pass on one layer of the depth target.
    pub(super) fn layer<'e>(
        &self,
        layer: &wgpu::TextureView,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        encoder: &'e mut wgpu::CommandEncoder,
    ) -> wgpu::RenderPass<'e> {
        let depth = self.desc.depth.as_ref();
        let load = match depth.map(|depth| depth.load) {
            Some(Load::Clear([value, ..])) => wgpu::LoadOp::Clear(value as f32),
            _ => wgpu::LoadOp::Load,
        };
        let operations = if self.clipped {
            kept()
        } else {
            wgpu::Operations {
                load,
                store: store(depth.is_none_or(|depth| depth.store)),
            }
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&self.desc.name),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: layer,
                depth_ops: Some(operations),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }
}
