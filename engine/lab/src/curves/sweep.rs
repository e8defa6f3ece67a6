//! Measures pipelines at each value of a parameter.

use lightbench_assets::files::Files;
use lightbench_assets::{Cancelled, Progress};
use lightbench_render::{Compiler, Pipeline, Problems, Renderer, Variants};
use lightbench_script::{Scene, Settings, load_pipeline, load_scene};

use super::losses::first_loss;
use super::{Curve, End, Point};
use crate::capture::{CaptureError, CaptureOptions, capture};
use crate::measure::{MeasureError, MeasureOptions, Measurement, measure};
use crate::report::PipelineResult;
use crate::statistics::Summary;

/// How often a limit that turns out too large while the scene moves is lowered.
const MOST_STEPS_BACK: u32 = 8;

/// What to measure.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The scene, as its loader takes it.
    pub scene: String,
    /// Values of its other parameters.
    pub settings: Settings,
    /// The parameter of the scene that takes the values.
    pub parameter: String,
    /// The values in ascending order.
    pub values: Vec<u32>,
    /// Pipelines, as their loader takes them, with their values.
    pub pipelines: Vec<(String, Settings)>,
    /// How each point is measured.
    pub options: MeasureOptions,
    /// A pipeline whose frame takes longer than so many seconds is not measured at larger values.
    pub patience: f64,
}

/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// A script or a shader has mistakes.
    #[error(transparent)]
    Problems(#[from] Problems),
    /// A frame could not be measured.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// A frame could not be drawn for its counts.
    #[error(transparent)]
    Capture(#[from] CaptureError),
    /// It was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The curves, and what the parameter means.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Swept {
    /// One a pipeline.
    pub curves: Vec<Curve>,
    /// The scene's words about the parameter.
    pub about: String,
}

/// Measures every pipeline at every value, at each value in turn with the others.
///
/// Where a pipeline reports a loss, its curve ends: the largest value without one is sought, and
/// measured. Lights and fragments are counted with the heat maps, in frames of their own.
///
/// # Errors
/// When something can't be loaded, compiled or drawn, or `progress` was cancelled.
pub fn sweep(
    renderer: &mut Renderer,
    files: &Files,
    sweep: &Sweep,
    progress: &Progress,
) -> Result<Swept, SweepError> {
    let mut compiler = renderer.compiler();
    let mut subjects = Vec::new();
    for (path, settings) in &sweep.pipelines {
        subjects.push(Subject::new(&mut compiler, files, path, settings)?);
    }
    let mut bench = Bench {
        renderer,
        files,
        sweep,
        progress,
        about: String::new(),
    };
    let mut before = 0;
    for &value in &sweep.values {
        let mut open: Vec<&mut Subject> = subjects.iter_mut().filter(|s| s.is_open()).collect();
        if open.is_empty() {
            break;
        }
        let mut scene = bench.scene(value)?;
        let mut pipelines: Vec<Pipeline> = Vec::new();
        open.iter_mut()
            .for_each(|subject| pipelines.extend(subject.pipeline.take()));
        let measured = bench.measure(&mut scene, &mut pipelines, sweep.options);
        for (subject, pipeline) in open.iter_mut().zip(pipelines) {
            subject.pipeline = Some(pipeline);
        }
        for (subject, result) in open.into_iter().zip(measured?.pipelines) {
            if first_loss(&result.counters).is_some() {
                bench.find_limit(subject, before, value, &result)?;
            } else {
                bench.add(subject, &mut scene, value, &result)?;
            }
        }
        before = value;
    }
    Ok(Swept {
        curves: subjects.into_iter().map(|subject| subject.curve).collect(),
        about: bench.about,
    })
}

/// A pipeline, with the heat maps that count its work.
struct Subject {
    curve: Curve,
    /// Absent while it is measured together with others.
    pipeline: Option<Pipeline>,
    /// `lights_evaluated`, `lights_reaching` and `overdraw`; absent where it can't count.
    counting: [Option<Pipeline>; 3],
}

impl Subject {
    fn new(
        compiler: &mut Compiler,
        files: &Files,
        path: &str,
        settings: &Settings,
    ) -> Result<Self, Problems> {
        let desc = load_pipeline(files, path, settings)?;
        let curve = Curve {
            pipeline: desc.name.clone(),
            title: desc.title.clone(),
            ..Curve::default()
        };
        let pipeline = compiler.compile_for(files, &desc, Variants::ALL)?;
        let maps = ["lights_evaluated", "lights_reaching", "overdraw"];
        let counting = maps.map(|map| {
            let settings = settings.clone().with("heat_map", map);
            let desc = load_pipeline(files, path, &settings).ok()?;
            compiler.compile_for(files, &desc, Variants::ALL).ok()
        });
        Ok(Self {
            curve,
            pipeline: Some(pipeline),
            counting,
        })
    }

    fn is_open(&self) -> bool {
        self.curve.end.is_none()
    }
}

struct Bench<'a> {
    renderer: &'a mut Renderer,
    files: &'a Files,
    sweep: &'a Sweep,
    progress: &'a Progress,
    about: String,
}

impl Bench<'_> {
    /// The scene at a value, before its first step.
    fn scene(&mut self, value: u32) -> Result<Scene, SweepError> {
        let name = &self.sweep.parameter;
        let settings = self
            .sweep
            .settings
            .clone()
            .with(name.as_str(), f64::from(value));
        let scene = load_scene(self.files, &self.sweep.scene, &settings, self.progress)?;
        let parameter = scene.parameters.iter().find(|known| known.name == *name);
        self.about = parameter.map_or_else(String::new, |known| known.description.clone());
        self.renderer.reset_scene();
        Ok(scene)
    }

    fn measure(
        &mut self,
        scene: &mut Scene,
        pipelines: &mut [Pipeline],
        options: MeasureOptions,
    ) -> Result<Measurement, MeasureError> {
        measure(self.renderer, scene, pipelines, options, self.progress)
    }

    /// One pipeline at one value.
    fn measure_alone(
        &mut self,
        subject: &mut Subject,
        value: u32,
        options: MeasureOptions,
    ) -> Result<(Scene, PipelineResult), SweepError> {
        let mut scene = self.scene(value)?;
        let pipelines = subject.pipeline.as_mut_slice();
        let measured = self.measure(&mut scene, pipelines, options)?;
        let result = measured.pipelines.into_iter().next().unwrap_or_default();
        Ok((scene, result))
    }

    /// Adds a point to a curve.
    fn add(
        &mut self,
        subject: &mut Subject,
        scene: &mut Scene,
        value: u32,
        result: &PipelineResult,
    ) -> Result<(), SweepError> {
        let mut counts = [None; 3];
        for (count, pipeline) in counts.iter_mut().zip(&mut subject.counting) {
            if let Some(pipeline) = pipeline {
                *count = self.mean(scene, pipeline)?;
            }
        }
        let [lights_evaluated, lights_reaching, overdraw] = counts;
        let pixels = f64::from(self.sweep.options.size.0) * f64::from(self.sweep.options.size.1);
        let passes = || result.passes.iter();
        let counted = passes().any(|pass| pass.fragments.is_some());
        let fragments: u64 = passes().filter_map(|pass| pass.fragments).sum();
        let gpu = result.gpu_samples().and_then(Summary::of);
        subject.curve.points.push(Point {
            at: value,
            gpu,
            cpu: Summary::of(&result.frame_cpu_ms),
            lights_evaluated,
            lights_reaching,
            overdraw,
            fragments: counted.then_some(fragments as f64 / pixels),
            draws: passes().map(|pass| pass.draws).sum(),
        });
        let seconds = gpu.map_or(0.0, |gpu| gpu.median * 1e-3);
        if seconds > self.sweep.patience && Some(&value) != self.sweep.values.last() {
            subject.curve.end = Some(End::Slow {
                last: value,
                seconds,
            });
        }
        Ok(())
    }

    /// The mean of a heat map's counts, in the scene as it stands.
    fn mean(
        &mut self,
        scene: &mut Scene,
        pipeline: &mut Pipeline,
    ) -> Result<Option<f64>, SweepError> {
        let options = CaptureOptions {
            size: self.sweep.options.size,
            frame: 0,
        };
        let progress = Progress::new();
        let drawn = capture(self.renderer, scene, pipeline, options, &progress)?;
        self.progress.report(self.progress.fraction())?;
        Ok(drawn.hdr.map(|counts| {
            let sum: f64 = counts.pixels.iter().map(|pixel| f64::from(pixel[0])).sum();
            sum / counts.pixels.len().max(1) as f64
        }))
    }

    /// Ends a curve that lost something at `beyond` and nothing at `last`: halves the distance until
    /// the two are neighbours, and measures there.
    fn find_limit(
        &mut self,
        subject: &mut Subject,
        mut last: u32,
        mut beyond: u32,
        result: &PipelineResult,
    ) -> Result<(), SweepError> {
        let known = last;
        let (mut counter, mut about, mut count) = loss(result).unwrap_or_default();
        let glance = MeasureOptions {
            frames: 1,
            warmup: 0,
            ..self.sweep.options
        };
        while beyond - last > 1 {
            let middle = last + (beyond - last) / 2;
            let (_, result) = self.measure_alone(subject, middle, glance)?;
            match loss(&result) {
                Some(found) => {
                    beyond = middle;
                    (counter, about, count) = found;
                }
                None => last = middle,
            }
        }
        // While the scene moves it may lose something after all.
        for _ in 0..MOST_STEPS_BACK {
            if last <= known {
                break;
            }
            let (mut scene, result) = self.measure_alone(subject, last, self.sweep.options)?;
            let Some(found) = loss(&result) else {
                self.add(subject, &mut scene, last, &result)?;
                break;
            };
            beyond = last;
            (counter, about, count) = found;
            last = known.max(last - (last / 20).max(1));
        }
        // What was measured last is where the curve ends.
        let last = subject.curve.points.last().map_or(0, |point| point.at);
        subject.curve.end = Some(End::Limit {
            last,
            beyond,
            counter,
            about,
            count,
        });
        Ok(())
    }
}

/// The counter that reports a loss, what it counts, and the largest number that it reports.
fn loss(result: &PipelineResult) -> Option<(String, String, f64)> {
    let (counter, most) = first_loss(&result.counters)?;
    Some((counter.name.clone(), counter.description.clone(), most))
}
