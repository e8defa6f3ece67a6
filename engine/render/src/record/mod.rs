//! Runs a pipeline: each pass of the description, in its order.

mod compute;
mod geometry;
mod lights;
mod raster;
mod transfer;

use std::time::Instant;

use crate::description::PassKind;
use crate::frame::Frame;
use crate::inspect::Inspector;
use crate::pipeline::{PassPipelines, Pipeline};
use crate::queries::{Measure, Queries};
use crate::scene::MeshPool;
use crate::statistics::{PassStatistics, traffic};

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
    /// Whether the scene has reflection models beside the default one.
    pub other_models: bool,
}

/// What can be measured of each pass of a pipeline, in order.
pub fn measures<'a>(
    pipeline: &'a Pipeline,
    inspector: &'a Inspector,
) -> impl Iterator<Item = Measure> + 'a {
    let passes = pipeline.desc.passes.iter().zip(&pipeline.passes);
    passes.enumerate().map(|(index, (desc, pass))| {
        let runs = pipeline.runs(index) || inspector.wants(index);
        match &desc.kind {
            _ if !runs => Measure::Nothing,
            PassKind::Copy { .. } | PassKind::History { .. } => Measure::Nothing,
            PassKind::Clear if pass.attachments.clears() == 0 => Measure::Nothing,
            PassKind::Mips { .. } => match &pass.pipelines {
                PassPipelines::Mips { levels, .. } if !levels.is_empty() => Measure::Time,
                _ => Measure::Nothing,
            },
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
        let started = Instant::now();
        let mut cost = PassStatistics {
            traffic: traffic(desc, targets, coverage(desc, pass.list, recording.frame)),
            ..Default::default()
        };
        let work = raster::Work {
            desc,
            pass,
            targets,
            recording,
            queries,
            index,
        };
        match (&desc.kind, pass.pipelines(recording.other_models)) {
            (PassKind::Compute(dispatch), PassPipelines::Compute { pipeline, .. }) => {
                work.compute(dispatch, pipeline, encoder, &mut cost);
            }
            (
                PassKind::Mips { .. },
                PassPipelines::Mips {
                    pipeline, levels, ..
                },
            ) => {
                work.mips(pipeline, levels, encoder, &mut cost);
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
        inspector.after_pass(index, targets, &recording.frame.data, encoder);
    }
}

/// Share of the picture that the lights of a `lights` pass cover, summed over the lights.
fn coverage(desc: &crate::description::PassDesc, list: Option<usize>, frame: &Frame) -> f64 {
    match desc.kind {
        PassKind::Lights(_) => list
            .and_then(|list| frame.light_lists.get(list))
            .map_or(0.0, |list| list.coverage),
        _ => 1.0,
    }
}
