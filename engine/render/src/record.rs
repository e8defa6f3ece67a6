//! Runs a pipeline: one render pass for each pass of the description.

use std::time::Instant;

use crate::compile::DrawPipeline;
use crate::description::{Load, PassDesc};
use crate::frame::Frame;
use crate::inspect::Inspector;
use crate::pipeline::{CompiledPass, PassPipelines, Pipeline};
use crate::queries::Queries;
use crate::scene::MeshPool;
use crate::statistics::{PassStatistics, traffic};
use crate::targets::Targets;
use crate::volumes::Case;

/// Everything that passes draw from.
pub struct Recording<'a> {
    /// The frame.
    pub frame: &'a Frame,
    /// Meshes and shapes.
    pub meshes: &'a MeshPool,
    /// Group 0.
    pub scene: &'a wgpu::BindGroup,
}

/// Records all passes and fills one entry of `statistics` for each.
pub fn record(
    pipeline: &Pipeline,
    recording: &Recording<'_>,
    encoder: &mut wgpu::CommandEncoder,
    queries: &Queries,
    inspector: &mut Inspector,
    statistics: &mut Vec<PassStatistics>,
) {
    statistics.clear();
    let Some(targets) = pipeline.targets() else {
        return;
    };
    for (index, (desc, pass)) in pipeline
        .desc
        .passes
        .iter()
        .zip(&pipeline.passes)
        .enumerate()
    {
        let started = Instant::now();
        let mut cost = PassStatistics {
            traffic: traffic(desc, targets, recording.frame.light_coverage),
            ..Default::default()
        };
        begin(desc, targets, index, queries, encoder, |render_pass| {
            draw(pass, recording, render_pass, &mut cost);
        });
        cost.cpu_ms = started.elapsed().as_secs_f64() * 1e3;
        statistics.push(cost);
        inspector.after_pass(index, targets, &recording.frame.data, encoder);
    }
}

/// Opens a render pass with the pass's attachments, counted and timed, for `draw`.
fn begin(
    desc: &PassDesc,
    targets: &Targets,
    index: usize,
    queries: &Queries,
    encoder: &mut wgpu::CommandEncoder,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    // Attachments fit in an array, so that recording a pass allocates nothing.
    let mut colors = [const { None }; MAX_COLORS];
    for (slot, color) in colors.iter_mut().zip(&desc.colors) {
        let load = match color.load {
            Load::Keep => wgpu::LoadOp::Load,
            Load::Clear([r, g, b, a]) => wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
        };
        *slot = targets
            .get(&color.target)
            .map(|target| wgpu::RenderPassColorAttachment {
                view: &target.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load,
                    store: wgpu::StoreOp::Store,
                },
            });
    }
    let depth = desc.depth.as_ref().and_then(|depth| {
        let load = match depth.load {
            Load::Keep => wgpu::LoadOp::Load,
            Load::Clear([depth, ..]) => wgpu::LoadOp::Clear(depth as f32),
        };
        Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.get(&depth.target)?.view,
            // No operations means read-only, which lets shaders sample the same depth.
            depth_ops: depth.write.then_some(wgpu::Operations {
                load,
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        })
    });
    let mut render_pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(&desc.name),
        color_attachments: &colors[..desc.colors.len().min(MAX_COLORS)],
        depth_stencil_attachment: depth,
        timestamp_writes: queries.timestamps(index),
        occlusion_query_set: None,
        multiview_mask: None,
    });
    queries.begin_statistics(index, &mut render_pass);
    draw(&mut render_pass);
    queries.end_statistics(&mut render_pass);
}

/// Colour targets that a pass may have: WebGPU's limit.
pub const MAX_COLORS: usize = 8;

fn draw(
    pass: &CompiledPass,
    recording: &Recording<'_>,
    render_pass: &mut wgpu::RenderPass<'_>,
    cost: &mut PassStatistics,
) {
    render_pass.set_bind_group(0, recording.scene, &[]);
    if let Some(group) = &pass.target_group {
        render_pass.set_bind_group(1, group, &[]);
    }
    if let Some(parameters) = &pass.parameters {
        render_pass.set_bind_group(2, &parameters.group, &[]);
    }
    match &pass.pipelines {
        PassPipelines::Geometry(variants) => geometry(variants, recording, render_pass, cost),
        PassPipelines::Lights(pipelines) => {
            for run in &recording.frame.volume_draws {
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
                    let shape = recording.meshes.shape(run.kind.shape);
                    recording.meshes.bind(render_pass, pipeline.attributes);
                    render_pass.draw_indexed(
                        shape.indices.clone(),
                        shape.base_vertex,
                        run.volumes.clone(),
                    );
                    cost.count(shape.indices.len() / 3, &run.volumes);
                }
            }
        }
        PassPipelines::Fullscreen(pipeline) => {
            render_pass.set_pipeline(pipeline);
            render_pass.draw(0..3, 0..1);
            cost.count(1, &(0..1));
        }
    }
}

fn geometry(
    variants: &[DrawPipeline],
    recording: &Recording<'_>,
    render_pass: &mut wgpu::RenderPass<'_>,
    cost: &mut PassStatistics,
) {
    let mut bound = None;
    for run in &recording.frame.mesh_draws {
        let (Some(pipeline), Some(mesh)) = (
            variants.get(run.variant.index()),
            recording.meshes.range(run.mesh),
        ) else {
            continue;
        };
        if bound != Some(run.variant) {
            render_pass.set_pipeline(&pipeline.pipeline);
            recording.meshes.bind(render_pass, pipeline.attributes);
            bound = Some(run.variant);
        }
        render_pass.draw_indexed(mesh.indices.clone(), mesh.base_vertex, run.objects.clone());
        cost.count(mesh.indices.len() / 3, &run.objects);
    }
}

impl PassStatistics {
    /// Counts one draw call.
    fn count(&mut self, triangles: usize, instances: &std::ops::Range<u32>) {
        let instances = instances.end - instances.start;
        self.draws += 1;
        self.instances += instances;
        self.triangles += triangles as u64 * u64::from(instances);
    }
}
