//! Passes that go through the rasteriser: attachments, bindings, and who draws.

use super::{MAX_COLORS, Recording};
use crate::compiled_pass::CompiledPass;
use crate::description::{LightStencil, Load, PassDesc, PassKind, StencilClear};
use crate::gpu_pipelines::PassPipelines;
use crate::queries::Queries;
use crate::statistics::PassStatistics;
use crate::targets::Targets;

/// One pass that is being recorded.
pub(super) struct Work<'a> {
    pub desc: &'a PassDesc,
    pub pass: &'a CompiledPass,
    pub targets: &'a Targets,
    pub recording: &'a Recording<'a>,
    pub queries: &'a Queries,
    pub index: usize,
    /// Nothing is drawn and nothing changes: see [`super::warm`].
    pub clipped: bool,
}

/// An attachment keeps what it holds.
pub(super) fn kept<V>() -> wgpu::Operations<V> {
    wgpu::Operations {
        load: wgpu::LoadOp::Load,
        store: wgpu::StoreOp::Store,
    }
}

impl Work<'_> {
    /// One render pass with the declared attachments.
    pub fn raster(
        &self,
        pipelines: &PassPipelines,
        encoder: &mut wgpu::CommandEncoder,
        cost: &mut PassStatistics,
    ) {
        self.begin(encoder, |render_pass| match pipelines {
            PassPipelines::Geometry(pipelines) => self.geometry(pipelines, render_pass, cost),
            PassPipelines::Lights(pipelines) => self.lights(pipelines, render_pass, cost),
            PassPipelines::Fullscreen(pipeline) => {
                pipeline.set(render_pass);
                render_pass.draw(0..3, 0..1);
                cost.count(1, &(0..1));
            }
            PassPipelines::Shadow(_)
            | PassPipelines::Compute(_)
            | PassPipelines::Mips { .. }
            | PassPipelines::None => {}
        });
    }

    /// Opens a render pass with the pass's attachments, counted and timed, for `draw`.
    pub(super) fn begin(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let views = &self.pass.bound.attachments;
        // Attachments fit in an array, so that recording a pass allocates nothing.
        let mut colors = [const { None }; MAX_COLORS];
        let declared = self.desc.colors.iter().zip(&views.colors);
        for ((slot, (color, (view, resolve))), depth_slice) in
            colors.iter_mut().zip(declared).zip(&views.depth_slices)
        {
            *slot = Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: *depth_slice,
                resolve_target: resolve.as_ref().filter(|_| !self.clipped),
                ops: if self.clipped {
                    kept()
                } else {
                    wgpu::Operations {
                        load: load_color(color.load),
                        store: store(color.store),
                    }
                },
            });
        }
        let mut render_pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(&self.desc.name),
            color_attachments: &colors[..self.desc.colors.len().min(MAX_COLORS)],
            depth_stencil_attachment: self.depth_attachment(),
            timestamp_writes: self.queries.timestamps(self.index),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        self.queries.begin_statistics(self.index, &mut render_pass);
        self.bind(&mut render_pass);
        if self.clipped {
            render_pass.set_scissor_rect(0, 0, 0, 0);
        }
        draw(&mut render_pass);
        self.queries.end_statistics(self.index, &mut render_pass);
    }

    /// Width and height of what the pass draws to.
    pub(super) fn attachment_size(&self) -> (u32, u32) {
        let colors = self.desc.colors.iter();
        let mut named = colors
            .map(|color| (&color.target, color.slice.mip))
            .chain(self.desc.depth.iter().map(|d| (&d.target, d.slice.mip)));
        named
            .next()
            .and_then(|(name, mip)| Some(self.targets.get(name)?.mip_size(mip)))
            .unwrap_or((1, 1))
    }

    fn depth_attachment(&self) -> Option<wgpu::RenderPassDepthStencilAttachment<'_>> {
        let depth = self.desc.depth.as_ref()?;
        let load = match depth.load {
            Load::Keep => wgpu::LoadOp::Load,
            Load::Clear([depth, ..]) => wgpu::LoadOp::Clear(depth as f32),
        };
        let (load, store) = if self.clipped {
            (wgpu::LoadOp::Load, wgpu::StoreOp::Store)
        } else {
            (load, store(depth.store))
        };
        let format = self.targets.get(&depth.target)?.texture.format();
        // No operations means read-only, which lets shaders sample the same depth.
        Some(wgpu::RenderPassDepthStencilAttachment {
            view: self.pass.bound.attachments.depth.as_ref()?,
            depth_ops: depth.write.then_some(wgpu::Operations { load, store }),
            stencil_ops: self
                .stencil_operations()
                .filter(|_| format.has_stencil_aspect())
                .map(|operations| if self.clipped { kept() } else { operations }),
        })
    }

    /// How stencil begins and ends, or none where the pass only tests it.
    fn stencil_operations(&self) -> Option<wgpu::Operations<u32>> {
        let own_marks = match &self.desc.kind {
            PassKind::Lights(lights) => lights.stencil != LightStencil::Off,
            PassKind::Geometry(geometry) => geometry.repeat.is_some_and(|repeat| repeat.stencil),
            _ => false,
        };
        if own_marks {
            return Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0),
                store: wgpu::StoreOp::Discard,
            });
        }
        let stencil = self.desc.depth.as_ref()?.stencil.as_ref()?;
        let load = match stencil.load {
            StencilClear::Keep => wgpu::LoadOp::Load,
            StencilClear::To(value) => wgpu::LoadOp::Clear(u32::from(value)),
        };
        stencil.writes().then_some(wgpu::Operations {
            load,
            store: wgpu::StoreOp::Store,
        })
    }

    /// Sets the groups. `view` is the offset of the view that shaders see as `frame`.
    pub(super) fn bind_groups(&self, view: u32, render_pass: &mut wgpu::RenderPass<'_>) {
        render_pass.set_bind_group(0, self.recording.scene, &[view]);
        if let Some(group) = &self.pass.bound.target_group {
            render_pass.set_bind_group(1, group, &[]);
        }
        if let Some(parameters) = &self.pass.parameters {
            render_pass.set_bind_group(2, &parameters.group, &[]);
        }
    }

    /// Sets the groups and the constants that all draws of the pass share.
    fn bind(&self, render_pass: &mut wgpu::RenderPass<'_>) {
        self.bind_groups(0, render_pass);
        let [r, g, b, a] = self.desc.blend_constant;
        render_pass.set_blend_constant(wgpu::Color { r, g, b, a });
        let stencil = self.desc.depth.as_ref().and_then(|d| d.stencil.as_ref());
        if let Some(stencil) = stencil {
            render_pass.set_stencil_reference(u32::from(stencil.reference));
        }
    }
}

pub(super) fn load_color(load: Load) -> wgpu::LoadOp<wgpu::Color> {
    match load {
        Load::Keep => wgpu::LoadOp::Load,
        Load::Clear([r, g, b, a]) => wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
    }
}

pub(super) fn store(store: bool) -> wgpu::StoreOp {
    if store {
        wgpu::StoreOp::Store
    } else {
        wgpu::StoreOp::Discard
    }
}

impl PassStatistics {
    /// Counts one draw call.
    pub(super) fn count(&mut self, triangles: usize, instances: &std::ops::Range<u32>) {
        let instances = instances.end - instances.start;
        self.draws += 1;
        self.instances += instances;
        self.triangles += triangles as u64 * u64::from(instances);
    }
}
