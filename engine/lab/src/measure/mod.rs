//! Measuring pipelines on one scene.
//!
//! All pipelines draw their picture and are warmed up first. Then each moment of the scene is drawn by
//! every pipeline in turn before the scene moves on, so that a machine that grows warm or busy slows all
//! of them alike. Who begins changes from frame to frame, because the first one uploads what moved.

mod allowance;
mod inputs;
mod machine;
mod series;

use std::time::Instant;

use lightbench_assets::{Cancelled, Progress};
use lightbench_render::gpu::GpuError;
use lightbench_render::queries::Measured;
use lightbench_render::{FrameStatistics, Pipeline, Problem, RenderError, Renderer};
use lightbench_script::Scene;

pub use allowance::Allowance;
pub use inputs::Inputs;
pub use machine::{load_average, processor_mhz, resident_bytes};

use crate::capture::{STEP, draw, read_hdr, read_output, view_of};
use crate::report::PipelineResult;
use crate::{HdrImage, LdrImage};
use allowance::Clock;
use series::{Missing, Series};

/// Seconds after which a frame counts as hung.
const TIMEOUT: u64 = 60;
/// How often a frame is drawn before a pipeline's buffers must be large enough.
const MOST_ATTEMPTS: usize = 4;
/// How many frames a warm-up is prolonged by at most.
const MOST_UNTIL_SETTLED: u32 = 6;

/// How to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Frames drawn first by each pipeline and not measured, at the least: that of its picture is one
    /// of them. The scene stands still meanwhile.
    pub warmup: u32,
    /// Whether more of them are drawn until the times have settled.
    pub settle: bool,
    /// Frames measured of each pipeline; the scene moves by `step` between them.
    pub frames: u32,
    /// Seconds that the scene moves on between two frames.
    pub step: f64,
    /// Frames that the scene moves on before the first is drawn.
    pub start: u32,
    /// Whether after every second frame one is drawn whose passes are not timed, so that the cost of
    /// the queries is known.
    pub unqueried: bool,
    /// Whether pictures are taken, in the first frames of the warm-up.
    pub pictures: bool,
    /// Seconds for each pipeline. A frame that would end later is not begun, but one is always
    /// measured. [`measure_within`] takes finer limits.
    pub seconds: f64,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            size: (640, 360),
            warmup: 1,
            settle: false,
            frames: 6,
            step: STEP,
            start: 0,
            unqueried: false,
            pictures: true,
            seconds: f64::INFINITY,
        }
    }
}

/// What came out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurement {
    /// One result a pipeline, in the order given, with its picture of the first frame if they were asked
    /// for.
    pub pipelines: Vec<PipelineResult>,
    /// Frames measured of the pipeline that has the most: fewer than asked for where it was stopped.
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
    let allowances = vec![Allowance::of_one_process(options.seconds); pipelines.len()];
    measure_within(renderer, scene, pipelines, options, &allowances, progress)
}

/// [`measure`] with the time that each pipeline may take, in their order, instead of
/// [`MeasureOptions::seconds`].
///
/// # Errors
/// As [`measure`].
pub fn measure_within(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipelines: &mut [Pipeline],
    options: MeasureOptions,
    allowances: &[Allowance],
    progress: &Progress,
) -> Result<Measurement, MeasureError> {
    let mut bench = Bench::new(renderer, scene, pipelines, options, progress);
    bench.clocks = (0..bench.pipelines.len())
        .map(|index| Clock::new(allowances.get(index).copied().unwrap_or_default()))
        .collect();
    for frame in 1..=options.start {
        progress.begin("moving the scene to its start", 0.0)?;
        bench.step(frame)?;
    }
    let pictures = match options.pictures {
        true => bench.pictures()?,
        false => Pictures::new(),
    };
    bench.warm_up()?;
    bench.measure()?;
    bench.finish(pictures)
}

/// Measuring under way.
struct Bench<'a> {
    renderer: &'a mut Renderer,
    scene: &'a mut Scene,
    pipelines: &'a mut [Pipeline],
    options: MeasureOptions,
    progress: &'a Progress,
    /// Of each pipeline.
    series: Vec<Series>,
    clocks: Vec<Clock>,
    measured: u32,
}

/// A picture as a display shows it, and in linear light where there is such a target.
type Pictures = Vec<(LdrImage, Option<HdrImage>)>;

impl<'a> Bench<'a> {
    fn new(
        renderer: &'a mut Renderer,
        scene: &'a mut Scene,
        pipelines: &'a mut [Pipeline],
        mut options: MeasureOptions,
        progress: &'a Progress,
    ) -> Self {
        options.frames = options.frames.max(1);
        let frames = options.frames as usize;
        Self {
            series: pipelines
                .iter()
                .map(|pipeline| Series::new(pipeline, frames))
                .collect(),
            clocks: Vec::new(),
            renderer,
            scene,
            pipelines,
            options,
            progress,
            measured: 0,
        }
    }

    /// Moves the scene to a frame.
    fn step(&mut self, frame: u32) -> Result<(), MeasureError> {
        let step = self.options.step;
        let moved = self.scene.update(f64::from(frame) * step, step);
        moved.map_err(MeasureError::Script)
    }

    /// The picture of each pipeline at the first moment, which does not depend on how many frames
    /// there is time for.
    fn pictures(&mut self) -> Result<Pictures, MeasureError> {
        let mut pictures = Pictures::new();
        for index in 0..self.pipelines.len() {
            let name = &self.pipelines[index].desc.name;
            self.progress.begin(format!("drawing {name}"), 0.0)?;
            let wall = self.draw(index, 0)?.wall;
            self.clocks[index].add_warming(wall);
            let pipeline = &self.pipelines[index];
            pictures.push((
                read_output(self.renderer, pipeline)?,
                read_hdr(self.renderer, pipeline)?,
            ));
        }
        Ok(pictures)
    }

    fn warm_up(&mut self) -> Result<(), MeasureError> {
        let MeasureOptions { warmup, settle, .. } = self.options;
        if warmup == 0 {
            return Ok(());
        }
        let first = u32::from(self.options.pictures);
        let most = if settle {
            warmup + MOST_UNTIL_SETTLED
        } else {
            warmup
        };
        for round in first..most {
            for index in 0..self.pipelines.len() {
                let clock = &self.clocks[index];
                if !clock.allows_warming(round < warmup) {
                    continue;
                }
                let name = &self.pipelines[index].desc.name;
                let share = self.share(round);
                self.progress.begin(format!("warming up {name}"), share)?;
                let wall = self.draw(index, 0)?.wall;
                self.clocks[index].add_warming(wall);
            }
        }
        for index in 0..self.pipelines.len() {
            if !self.clocks[index].is_warm() && self.clocks[index].allows_first() {
                self.load_programs(index)?;
            }
        }
        tracing::debug!("all pipelines are warm; measuring");
        Ok(())
    }

    /// Where there is no time for a whole frame, at least what the driver does once is done: each GPU
    /// pipeline is drawn with, clipped away.
    fn load_programs(&mut self, index: usize) -> Result<(), MeasureError> {
        let time = f64::from(self.options.start) * self.options.step;
        let started = Instant::now();
        loop {
            let view = view_of(self.scene);
            let (world, assets) = (&mut self.scene.world, &self.scene.assets);
            let pipeline = &mut self.pipelines[index];
            let size = self.options.size;
            let ready = self
                .renderer
                .warm_up(world, assets, pipeline, &view, size, time)?;
            self.renderer.finish(TIMEOUT)?;
            if ready {
                break;
            }
        }
        self.clocks[index].add(started.elapsed().as_secs_f64());
        Ok(())
    }

    fn share(&self, done: u32) -> f32 {
        done as f32 / (self.options.warmup + self.options.frames) as f32
    }

    fn measure(&mut self) -> Result<(), MeasureError> {
        let frames = self.options.frames;
        while self.measured < frames {
            let label = format!("measuring frame {} of {frames}", self.measured + 1);
            let share = self.share(self.options.warmup + self.measured);
            let stopped = self.progress.begin(label, share);
            let first = self.measured == 0;
            let open: Vec<usize> = (0..self.pipelines.len())
                .filter(|index| {
                    let clock = &self.clocks[*index];
                    match first {
                        true => clock.allows_first(),
                        false => clock.allows_another(),
                    }
                })
                .collect();
            if open.is_empty() || !first && stopped.is_err() {
                break;
            }
            if !first {
                self.step(self.options.start + self.measured)?;
            }
            let stepped: Vec<_> = self.scene.system_times().collect();
            for turn in 0..open.len() {
                let index = open[(self.measured as usize + turn) % open.len()];
                let frame = self.draw(index, self.measured)?;
                self.clocks[index].add_frame(frame.wall);
                self.series[index].add(&stepped, &frame);
            }
            if self.options.unqueried && self.measured % 2 == 1 {
                self.draw_unqueried(&open)?;
            }
            self.measured += 1;
        }
        Ok(())
    }

    /// A frame without the queries of each pipeline that has time for it.
    fn draw_unqueried(&mut self, open: &[usize]) -> Result<(), MeasureError> {
        self.renderer.enable_queries(false);
        let mut drawn = Ok(());
        for &index in open {
            if !self.clocks[index].allows_another() {
                continue;
            }
            match self.draw(index, self.measured) {
                Ok(frame) => {
                    self.clocks[index].add_frame(frame.wall);
                    self.series[index].add_unqueried(frame.wall);
                }
                Err(error) => {
                    drawn = Err(error);
                    break;
                }
            }
        }
        self.renderer.enable_queries(true);
        drawn
    }

    /// Draws a frame after the first and waits for the device.
    fn draw(&mut self, index: usize, after: u32) -> Result<Drawn, MeasureError> {
        let frame = self.options.start + after;
        let time = f64::from(frame) * self.options.step;
        let pipeline = &mut self.pipelines[index];
        draw_and_wait(
            self.renderer,
            self.scene,
            pipeline,
            self.options.size,
            (frame, time),
        )
    }

    fn finish(self, pictures: Pictures) -> Result<Measurement, MeasureError> {
        let missing = Missing::of(self.renderer.gpu());
        let mut measurement = Measurement {
            frames: self.measured,
            ..Measurement::default()
        };
        let cut_short = self.measured < self.options.frames && self.progress.is_cancelled();
        let mut pictures = pictures.into_iter();
        for index in 0..self.pipelines.len() {
            let pipeline = &self.pipelines[index];
            let series = &self.series[index];
            let mut result = series.clone().finish(pipeline, &missing);
            result.cut = !cut_short && result.frame_cpu_ms.len() < self.options.frames as usize;
            result.process_frames = vec![result.frame_cpu_ms.len() as u32];
            let clock = &self.clocks[index];
            result.settled_after = vec![clock.warming_frames()];
            result.process_seconds = vec![clock.spent()];
            if let Some((output, linear)) = pictures.next() {
                result.picture = Some(output);
                result.linear = linear;
            }
            measurement.pipelines.push(result);
        }
        Ok(measurement)
    }
}

/// A frame that the device has finished.
struct Drawn {
    statistics: FrameStatistics,
    /// Absent where the device measures nothing.
    queries: Option<Measured>,
    /// Seconds from the first line of code until the device was done.
    wall: f64,
}

fn draw_and_wait(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    size: (u32, u32),
    (frame, time): (u32, f64),
) -> Result<Drawn, MeasureError> {
    // A pipeline whose buffers turn out to be too small draws the frame again.
    for _ in 0..MOST_ATTEMPTS {
        let serial = renderer.next_frame();
        renderer.set_frame_index(frame);
        let started = Instant::now();
        let statistics = draw(renderer, scene, pipeline, size, time)?.clone();
        let queries = renderer.finish(TIMEOUT)?;
        let wall = started.elapsed().as_secs_f64();
        if !pipeline.grow(&queries) {
            return Ok(Drawn {
                statistics,
                queries: queries.into_iter().find(|found| found.frame == serial),
                wall,
            });
        }
    }
    Err(MeasureError::Outgrown(pipeline.desc.name.clone()))
}
