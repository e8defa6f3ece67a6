//! Measuring pipelines on one scene.
//!
//! All pipelines are compiled and warmed up first. Then each moment of the scene is drawn by every
//! pipeline in turn before the scene moves on, so that a machine that grows warm or busy slows all
//! of them alike. Who begins changes from frame to frame, because the first one uploads what moved.

mod inputs;
mod machine;
mod series;

use std::collections::BTreeMap;

use lightbench_assets::{Cancelled, Progress};
use lightbench_render::gpu::GpuError;
use lightbench_render::queries::Measured;
use lightbench_render::{FrameStatistics, Pipeline, Problem, RenderError, Renderer};
use lightbench_script::Scene;

pub use inputs::Inputs;
pub use machine::{load_average, resident_bytes};

use crate::HdrImage;
use crate::capture::{STEP, draw, read_hdr, read_output};
use crate::report::PipelineResult;
use series::{Missing, Series};

/// Seconds after which a frame counts as hung.
const TIMEOUT: u64 = 60;
/// How often a frame is drawn before a pipeline's buffers must be large enough.
const MOST_ATTEMPTS: usize = 4;

/// How to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasureOptions {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Frames drawn first by each pipeline and not measured. The scene stands still meanwhile.
    pub warmup: u32,
    /// Frames measured of each pipeline; the scene moves by [`STEP`] between them.
    pub frames: u32,
}

/// What came out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurement {
    /// One result a pipeline, in the order given, each with its picture of the last frame.
    pub pipelines: Vec<PipelineResult>,
    /// The same pictures in linear light, by the pipeline's name, where it names such a target.
    pub linear: BTreeMap<String, HdrImage>,
    /// Frames measured of each pipeline: fewer than asked for where it was stopped.
    pub frames: u32,
}

/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// A frame could not be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The scene's script failed while the scene moved.
    #[error("{0}")]
    Script(Problem),
    /// The buffers of a pipeline were too small however much they grew.
    #[error("the pipeline `{0}` needs more room for its lists with every frame that it draws")]
    Outgrown(String),
    /// It was stopped before each pipeline had drawn one frame.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Measures pipelines on a scene that has not moved yet.
///
/// Each frame is waited for before the next begins, so that GPU times of different pipelines don't
/// overlap. When `progress` is cancelled, what is complete by then is the result.
///
/// # Errors
/// When the size or the scene is beyond the device, the device or the scene's script failed, or it
/// was stopped before the first frame was complete.
pub fn measure(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipelines: &mut [Pipeline],
    options: MeasureOptions,
    progress: &Progress,
) -> Result<Measurement, MeasureError> {
    let frames = options.frames.max(1);
    let share = |done: u32| done as f32 / (options.warmup + frames) as f32;
    for done in 0..options.warmup {
        for pipeline in &mut *pipelines {
            let label = format!("warming up {}", pipeline.desc.name);
            progress.begin(label, share(done))?;
            draw_and_wait(renderer, scene, pipeline, options.size, 0)?;
        }
    }

    let mut series: Vec<Series> = pipelines
        .iter()
        .map(|pipeline| Series::new(pipeline, frames as usize))
        .collect();
    tracing::debug!(frames, "all pipelines are warm; measuring");
    let mut measured = 0;
    while measured < frames {
        let label = format!("measuring frame {} of {frames}", measured + 1);
        let stopped = progress.begin(label, share(options.warmup + measured));
        if measured > 0 {
            if stopped.is_err() {
                break;
            }
            let time = f64::from(measured) * STEP;
            scene.update(time, STEP).map_err(MeasureError::Script)?;
        }
        let stepped: Vec<_> = scene.system_times().collect();
        for turn in 0..pipelines.len() {
            let index = (measured as usize + turn) % pipelines.len();
            let frame = draw_and_wait(
                renderer,
                scene,
                &mut pipelines[index],
                options.size,
                measured,
            )?;
            series[index].add(&stepped, &frame.statistics, frame.queries.as_ref());
        }
        measured += 1;
    }

    let missing = Missing::of(renderer.gpu());
    let mut measurement = Measurement {
        frames: measured,
        ..Measurement::default()
    };
    for (pipeline, series) in pipelines.iter_mut().zip(series) {
        // Once more, for the picture: the scene still stands at the last moment that was measured.
        draw_and_wait(renderer, scene, pipeline, options.size, measured - 1)?;
        let mut result = series.finish(pipeline, &missing);
        result.picture = Some(read_output(renderer, pipeline)?);
        if let Some(hdr) = read_hdr(renderer, pipeline)? {
            measurement.linear.insert(result.name.clone(), hdr);
        }
        measurement.pipelines.push(result);
    }
    Ok(measurement)
}

/// A frame that the device has finished.
struct Drawn {
    statistics: FrameStatistics,
    /// Absent where the device measures nothing.
    queries: Option<Measured>,
}

fn draw_and_wait(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    size: (u32, u32),
    frame: u32,
) -> Result<Drawn, MeasureError> {
    // A pipeline whose buffers turn out to be too small draws the frame again.
    for _ in 0..MOST_ATTEMPTS {
        let serial = renderer.next_frame();
        renderer.set_frame_index(frame);
        let statistics = draw(renderer, scene, pipeline, size, f64::from(frame) * STEP)?.clone();
        let queries = renderer.finish(TIMEOUT)?;
        if !pipeline.grow(&queries) {
            return Ok(Drawn {
                statistics,
                queries: queries.into_iter().find(|found| found.frame == serial),
            });
        }
    }
    Err(MeasureError::Outgrown(pipeline.desc.name.clone()))
}
