//! Passes that move and fill: clear, copy, resolve, mips.

use super::raster::{Work, kept, load_color};
use crate::description::{Load, Read, StencilClear};
use crate::gpu_pipelines::DrawPipeline;
use crate::statistics::PassStatistics;

impl Work<'_> {
    /// Fills every slice of every target, and zeros buffers.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        let parts = self.pass.bound.attachments.clears();
        let mut done = 0;
        let mut part = || {
            done += 1;
            self.queries.span(self.index, done - 1, parts)
        };
        for (index, view, depth_slice) in &self.pass.bound.attachments.slices {
            let Some(color) = self.desc.colors.get(*index) else {
                continue;
            };
            let attachment = Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: *depth_slice,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: load_color(color.load),
                    store: wgpu::StoreOp::Store,
                },
            });
            self.empty_pass(encoder, &[attachment], None, part());
        }
        if let Some(depth) = &self.desc.depth {
            let format = self.targets.get(&depth.target);
            let format = format.map(|target| target.texture.format());
            for view in &self.pass.bound.attachments.layers {
                let attachment = wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: match depth.load {
                        Load::Clear([value, ..]) => Some(wgpu::Operations {
                            load: wgpu::LoadOp::Clear(value as f32),
                            store: wgpu::StoreOp::Store,
                        }),
                        Load::Keep => None,
                    },
                    stencil_ops: match depth.stencil.as_ref().map(|stencil| stencil.load) {
                        Some(StencilClear::To(value))
                            if format.is_some_and(|f| f.has_stencil_aspect()) =>
                        {
                            Some(wgpu::Operations {
                                load: wgpu::LoadOp::Clear(u32::from(value)),
                                store: wgpu::StoreOp::Store,
                            })
                        }
                        _ => None,
                    },
                };
                self.empty_pass(encoder, &[], Some(attachment), part());
            }
        }
        for update in &self.desc.updates {
            if let Some(buffer) = self.targets.buffer(&update.target) {
                encoder.clear_buffer(buffer, 0, None);
            }
        }
    }

    /// Copies all of a target or buffer.
    pub(super) fn copy(&self, from: &Read, to: &Read, encoder: &mut wgpu::CommandEncoder) {
        if let (Some(from), Some(to)) = (
            self.targets.buffer(&from.target),
            self.targets.buffer(&to.target),
        ) {
            let bytes = from.size().min(to.size());
            encoder.copy_buffer_to_buffer(from, 0, to, 0, bytes);
            return;
        }
        let (Some(source), Some(target)) =
            (self.targets.get(&from.target), self.targets.get(&to.target))
        else {
            return;
        };
        let place =
            |texture, mip: Option<u32>, layer: Option<u32>, mips: u32| wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: mip.unwrap_or(mips),
                origin: wgpu::Origin3d {
                    x: 0,
                    y: 0,
                    z: layer.unwrap_or(0),
                },
                aspect: wgpu::TextureAspect::All,
            };
        let whole = from.mip.is_none() && to.mip.is_none();
        let levels = source
            .texture
            .mip_level_count()
            .min(target.texture.mip_level_count());
        for level in 0..if whole { levels } else { 1 } {
            let mip = from.mip.unwrap_or(level);
            let (width, height) = source.mip_size(mip);
            let one_layer = from.layer.is_some() || to.layer.is_some();
            encoder.copy_texture_to_texture(
                place(&source.texture, from.mip, from.layer, level),
                place(&target.texture, to.mip, to.layer, level),
                wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: if one_layer {
                        1
                    } else {
                        source.layers_of_mip(mip)
                    },
                },
            );
        }
    }

    /// Takes the mean of the samples, by an empty pass that resolves at its end.
    pub(super) fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some((from, Some(to))) = self.pass.bound.attachments.colors.first() else {
            return;
        };
        let attachment = Some(wgpu::RenderPassColorAttachment {
            view: from,
            depth_slice: None,
            resolve_target: Some(to),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            },
        });
        self.empty_pass(
            encoder,
            &[attachment],
            None,
            self.queries.timestamps(self.index),
        );
    }

    /// Draws each mip level from the one above.
    pub(super) fn mips(
        &self,
        pipeline: &DrawPipeline,
        levels: &[(wgpu::TextureView, wgpu::BindGroup)],
        encoder: &mut wgpu::CommandEncoder,
        cost: &mut PassStatistics,
    ) {
        for (index, level) in levels.iter().enumerate() {
            let timestamps = self.queries.span(self.index, index, levels.len());
            self.level(pipeline, level, timestamps, encoder);
            cost.count(1, &(0..1));
        }
    }

    /// Draws one mip level from the one above.
    pub(super) fn level(
        &self,
        pipeline: &DrawPipeline,
        (view, group): &(wgpu::TextureView, wgpu::BindGroup),
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let mut render_pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&self.desc.name),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: if self.clipped {
                    kept()
                } else {
                    wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    }
                },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pipeline.set(&mut render_pass);
        render_pass.set_bind_group(0, group, &[]);
        if self.clipped {
            render_pass.set_scissor_rect(0, 0, 0, 0);
        }
        render_pass.draw(0..3, 0..1);
    }

    fn empty_pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        colors: &[Option<wgpu::RenderPassColorAttachment<'_>>],
        depth: Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&self.desc.name),
            color_attachments: colors,
            depth_stencil_attachment: depth,
            timestamp_writes: timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
    }
}
