//! Runs a pipeline: each pass of the description, in its order.

mod compute;
mod geometry;
mod lights;
mod raster;
mod shadow;
mod transfer;
mod warm;

use std::time::Instant;

use crate::compiled_pass::CompiledPass;
use crate::description::{Geometry, PassDesc, PassKind};
use crate::frame::{Frame, Step};
use crate::gpu_pipelines::PassPipelines;
use crate::inspect::{Between, Inspector};
use crate::pipeline::Pipeline;
use crate::queries::{Measure, Queries};
use crate::scene::MeshPool;
use crate::statistics::PassStatistics;
use crate::traffic::traffic;

pub use warm::{is_cold, warm};

/// Colour targets that a pass may have: WebGPU's limit.
pub const MAX_COLORS: usize = 8;

/// Everything that passes draw from.
pub struct Recording<'a> {
    /// The frame.
    pub frame: &'a Frame,
    /// Meshes and shapes.
    pub meshes: &'a MeshPool,
    /// Group 0.
    pub scene: &'a wgpu::BindGroup,
    /// Bytes between the views of the frame's uniform buffer.
    pub view_bytes: u32,
}

impl Recording<'_> {
    /// The offset of a shadow view in group 0; the camera's is 0.
    fn view_offset(&self, view: u32) -> u32 {
        (view + 1) * self.view_bytes
    }
}

/// What can be measured of each pass of a pipeline, in order.
pub fn measures<'a>(
    pipeline: &'a Pipeline,
    frame: &'a Frame,
    inspector: &'a Inspector,
) -> impl Iterator<Item = Measure> + 'a {
    let passes = pipeline.desc.passes.iter().zip(&pipeline.passes);
    passes.enumerate().map(|(index, (desc, pass))| {
        let runs = pipeline.runs(index) || inspector.wants(index);
        match &desc.kind {
            _ if !runs => Measure::Nothing,
            PassKind::Copy { .. } | PassKind::History { .. } => Measure::Nothing,
            PassKind::Clear if pass.bound.attachments.clears() == 0 => Measure::Nothing,
            PassKind::Shadow(_) => match views(pass, frame) {
                0 => Measure::Nothing,
                _ => Measure::Time,
            },
            PassKind::Mips { .. } if pass.bound.levels.is_empty() => Measure::Nothing,
            PassKind::Mips { .. } => Measure::Time,
            kind if kind.rasterises() => Measure::TimeAndInvocations,
            _ => Measure::Time,
        }
    })
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
    let passes = pipeline.desc.passes.iter().zip(&pipeline.passes);
    for (index, (desc, pass)) in passes.enumerate() {
        if !pipeline.runs(index) && !inspector.wants(index) {
            statistics.push(PassStatistics {
                dropped: true,
                ..Default::default()
            });
            continue;
        }
        let between = Between {
            index,
            pass: desc,
            list: pass.list,
            targets,
            frame: recording.frame,
        };
        inspector.before_pass(&between, encoder);
        let started = Instant::now();
        let mut cost = PassStatistics {
            traffic: traffic(desc, targets, coverage(desc, pass, recording.frame)),
            ..Default::default()
        };
        let work = raster::Work {
            desc,
            pass,
            targets,
            recording,
            queries,
            index,
            clipped: false,
        };
        match (&desc.kind, pass.pipelines(recording.frame)) {
            (PassKind::Compute(dispatch), PassPipelines::Compute(pipeline)) => {
                work.compute(dispatch, pipeline, encoder, &mut cost);
            }
            (PassKind::Mips { .. }, PassPipelines::Mips { pipeline, .. }) => {
                work.mips(pipeline, &pass.bound.levels, encoder, &mut cost);
            }
            (PassKind::Shadow(_), PassPipelines::Shadow(pipelines)) => {
                work.shadow(pipelines, encoder, &mut cost);
            }
            (PassKind::Clear, _) => work.clear(encoder),
            (PassKind::Copy { from, to } | PassKind::History { from, to }, _) => {
                work.copy(from, to, encoder);
            }
            (PassKind::Resolve { .. }, _) => work.resolve(encoder),
            (_, pipelines) => work.raster(pipelines, encoder, &mut cost),
        }
        cost.cpu_ms = started.elapsed().as_secs_f64() * 1e3;
        statistics.push(cost);
        inspector.after_pass(&between, encoder);
    }
}

/// How often a pass covers what it draws to: for a `lights` pass the sum over its lights of the share
/// of the picture that each covers, for a `geometry` pass that is repeated the sum over its groups of
/// lights, for a `shadow` pass the number of its views, else 1.
fn coverage(desc: &PassDesc, pass: &CompiledPass, frame: &Frame) -> f64 {
    match desc.kind {
        PassKind::Lights(_) => pass
            .list
            .and_then(|list| frame.light_lists.get(list))
            .map_or(0.0, |list| list.coverage),
        PassKind::Geometry(Geometry {
            repeat: Some(_), ..
        }) => pass
            .list
            .and_then(|list| frame.lists.get(list))
            .map_or(0.0, |list| list.steps.iter().map(Step::coverage).sum()),
        PassKind::Shadow(_) => views(pass, frame) as f64,
        _ => 1.0,
    }
}

/// The views that a `shadow` pass draws.
fn views(pass: &CompiledPass, frame: &Frame) -> usize {
    let list = pass.list.and_then(|list| frame.shadow_lists.get(list));
    let layers = pass.bound.attachments.layers.len();
    list.map_or(0, |list| list.views.len().min(layers))
}
