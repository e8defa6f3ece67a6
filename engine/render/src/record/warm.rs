//! Draws once with a GPU pipeline before a picture needs it.
//!
//! Many drivers compile a pipeline when it is first drawn with. That draw is made here ahead of time,
//! with the real formats, state and bindings, and clipped away: no pixel, target or buffer changes.
//! One pipeline at a time, so that what else the device draws waits for one compilation at most.

use super::Recording;
use super::raster::Work;
use crate::compiled_pass::CompiledPass;
use crate::frame::{Frame, MeshDraw};
use crate::gpu_pipelines::{
    ComputePipeline, DrawPipeline, GeometryPipelines, LightsPipelines, PassPipelines,
};
use crate::pipeline::Pipeline;
use crate::queries::Queries;
use crate::scene::MeshPool;
use crate::volumes::{Case, Marking, VolumeDraw};

/// A GPU pipeline that the frame needs and that nobody has drawn with, and the least to do with it.
enum Cold<'a> {
    Draw(&'a DrawPipeline, Triangle),
    Shadow(&'a DrawPipeline, Triangle, u32),
    Compute(&'a ComputePipeline),
    MipLevel(&'a DrawPipeline, &'a (wgpu::TextureView, wgpu::BindGroup)),
}

/// What a clipped draw consists of.
enum Triangle {
    /// The first one of a mesh or a light volume.
    Indexed {
        first_index: u32,
        base_vertex: i32,
        instance: u32,
    },
    /// One of the vertex stage's own making.
    Screen { instance: u32 },
}

/// Whether the frame needs a GPU pipeline that nobody has drawn with.
pub fn is_cold(pipeline: &Pipeline, frame: &Frame, meshes: &MeshPool) -> bool {
    find(pipeline, frame, meshes).is_some()
}

/// Draws with the first such pipeline.
pub fn warm(
    pipeline: &Pipeline,
    recording: &Recording<'_>,
    queries: &Queries,
    encoder: &mut wgpu::CommandEncoder,
) {
    let Some(targets) = pipeline.targets() else {
        return;
    };
    let Some((index, cold)) = find(pipeline, recording.frame, recording.meshes) else {
        return;
    };
    let work = Work {
        desc: &pipeline.desc.passes[index],
        pass: &pipeline.passes[index],
        targets,
        recording,
        queries,
        index,
        clipped: true,
    };
    match cold {
        Cold::Draw(pipeline, triangle) => work.clipped_draw(pipeline, &triangle, encoder),
        Cold::Shadow(pipeline, triangle, view) => {
            work.clipped_shadow(pipeline, &triangle, view, encoder);
        }
        Cold::Compute(pipeline) => work
            .begin_compute(pipeline, encoder)
            .dispatch_workgroups(0, 0, 0),
        Cold::MipLevel(pipeline, level) => work.level(pipeline, level, None, encoder),
    }
}

fn find<'a>(pipeline: &'a Pipeline, frame: &Frame, meshes: &MeshPool) -> Option<(usize, Cold<'a>)> {
    let passes = pipeline.passes.iter().enumerate();
    passes
        .filter(|(index, _)| pipeline.runs(*index))
        .find_map(|(index, pass)| Some((index, cold(pass, frame, meshes)?)))
}

fn cold<'a>(pass: &'a CompiledPass, frame: &Frame, meshes: &MeshPool) -> Option<Cold<'a>> {
    let screen = Triangle::Screen { instance: 0 };
    match pass.pipelines(frame) {
        PassPipelines::None => None,
        PassPipelines::Geometry(pipelines) => geometry(pass, pipelines, frame, meshes),
        PassPipelines::Lights(pipelines) => lights(pass, pipelines, frame, meshes),
        PassPipelines::Shadow(pipelines) => shadow(pass, pipelines, frame, meshes),
        PassPipelines::Fullscreen(pipeline) => draw(pipeline, screen),
        PassPipelines::Compute(pipeline) => {
            pipeline.warmth.is_cold().then_some(Cold::Compute(pipeline))
        }
        PassPipelines::Mips { pipeline, .. } => {
            let level = pass
                .bound
                .levels
                .first()
                .filter(|_| pipeline.warmth.is_cold());
            level.map(|level| Cold::MipLevel(pipeline, level))
        }
    }
}

fn geometry<'a>(
    pass: &CompiledPass,
    pipelines: &'a GeometryPipelines,
    frame: &Frame,
    meshes: &MeshPool,
) -> Option<Cold<'a>> {
    let list = frame.lists.get(pass.list?)?;
    let of_mesh = |run: &MeshDraw| {
        let (pipeline, triangle) = mesh(run, pipelines, meshes)?;
        draw(pipeline, triangle)
    };
    let of_mask = || {
        let mask = pipelines.mask.as_ref()?;
        let mark = list.steps.iter().find_map(|step| step.mark.as_ref())?;
        volume(&mask.back, mark, meshes)
            .or_else(|| volume(&mask.front, mark, meshes))
            .or_else(|| draw(&mask.screen, Triangle::Screen { instance: 0 }))
    };
    list.draws.iter().find_map(of_mesh).or_else(of_mask)
}

fn shadow<'a>(
    pass: &CompiledPass,
    pipelines: &'a GeometryPipelines,
    frame: &Frame,
    meshes: &MeshPool,
) -> Option<Cold<'a>> {
    let list = frame.shadow_lists.get(pass.list?)?;
    list.views.iter().find_map(|view| {
        list.draws[view.draws.clone()].iter().find_map(|run| {
            let (pipeline, triangle) = mesh(run, pipelines, meshes)?;
            let cold = pipeline.warmth.is_cold();
            cold.then_some(Cold::Shadow(pipeline, triangle, view.view))
        })
    })
}

/// The first triangle of a mesh, and what draws it.
fn mesh<'a>(
    run: &MeshDraw,
    pipelines: &'a GeometryPipelines,
    meshes: &MeshPool,
) -> Option<(&'a DrawPipeline, Triangle)> {
    let pipeline = pipelines.variants.get(run.variant.index())?.as_ref()?;
    let mesh = meshes.range(run.mesh)?;
    let instance = run.objects.start;
    let triangle = if pipelines.pull_vertices {
        Triangle::Screen { instance }
    } else {
        Triangle::Indexed {
            first_index: mesh.indices.start,
            base_vertex: mesh.base_vertex,
            instance,
        }
    };
    Some((pipeline, triangle))
}

fn lights<'a>(
    pass: &CompiledPass,
    pipelines: &'a LightsPipelines,
    frame: &Frame,
    meshes: &MeshPool,
) -> Option<Cold<'a>> {
    let list = frame.light_lists.get(pass.list?)?;
    list.draws.iter().find_map(|run| {
        let array = pipelines.arrays.get(run.array as usize)?;
        let (mark, shade) = match (run.marking, &pipelines.stencil) {
            (Marking::Scheme, Some(stencil)) => (&stencil.mark, array.marked.as_ref()),
            (Marking::Count, Some(stencil)) => (&stencil.count, array.counted.as_ref()),
            _ => return volume(array.of(run.kind.case), run, meshes),
        };
        let wipe = pipelines.stencil.as_ref().map(|stencil| &stencil.wipe);
        volume(mark, run, meshes)
            .or_else(|| volume(shade?, run, meshes))
            .or_else(|| draw(wipe?, Triangle::Screen { instance: 0 }))
    })
}

/// One triangle of a volume, or of the screen.
fn volume<'a>(pipeline: &'a DrawPipeline, run: &VolumeDraw, meshes: &MeshPool) -> Option<Cold<'a>> {
    let instance = run.volumes.start;
    if run.kind.case == Case::Screen {
        return draw(pipeline, Triangle::Screen { instance });
    }
    let shape = meshes.shape(run.kind.shape)?;
    let triangle = Triangle::Indexed {
        first_index: shape.indices.start,
        base_vertex: shape.base_vertex,
        instance,
    };
    draw(pipeline, triangle)
}

fn draw(pipeline: &DrawPipeline, triangle: Triangle) -> Option<Cold<'_>> {
    pipeline
        .warmth
        .is_cold()
        .then_some(Cold::Draw(pipeline, triangle))
}

impl Work<'_> {
    fn clipped_draw(
        &self,
        pipeline: &DrawPipeline,
        triangle: &Triangle,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        self.begin(encoder, |render_pass| {
            self.triangle(pipeline, triangle, render_pass);
        });
    }

    fn clipped_shadow(
        &self,
        pipeline: &DrawPipeline,
        triangle: &Triangle,
        view: u32,
        encoder: &mut wgpu::CommandEncoder,
    ) {
        let Some(layer) = self.pass.bound.attachments.layers.first() else {
            return;
        };
        let mut render_pass = self.layer(layer, None, encoder);
        self.bind_groups(self.recording.view_offset(view), &mut render_pass);
        render_pass.set_scissor_rect(0, 0, 0, 0);
        self.triangle(pipeline, triangle, &mut render_pass);
    }

    fn triangle(
        &self,
        pipeline: &DrawPipeline,
        triangle: &Triangle,
        render_pass: &mut wgpu::RenderPass<'_>,
    ) {
        pipeline.set(render_pass);
        match *triangle {
            Triangle::Indexed {
                first_index,
                base_vertex,
                instance,
            } => {
                let indices = first_index..first_index + 3;
                self.recording.meshes.bind(render_pass, pipeline.attributes);
                render_pass.draw_indexed(indices, base_vertex, instance..instance + 1);
            }
            Triangle::Screen { instance } => render_pass.draw(0..3, instance..instance + 1),
        }
    }
}
