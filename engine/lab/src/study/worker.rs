//! One process of a study: it opens the device once and measures every point that it is given.

use std::collections::HashMap;

use lightbench_assets::cache::Cache;
use lightbench_assets::files::Files;
use lightbench_assets::{Cancelled, Progress};
use lightbench_render::problem::counted;
use lightbench_render::{
    Compiler, Gpu, GpuError, GpuOptions, Pipeline, PipelineDesc, Problems, Renderer, Variants, View,
};
use lightbench_script::{Limits, LogLine, Scene, Settings, load_pipeline, load_scene_within};

use super::model::{Plan, TRACED};
use super::points::{PlanError, Planned};
use super::store::Store;
use super::viewing::{look_through, stand};
use super::views;
use crate::diff::DiffOptions;
use crate::measure::{
    Allowance, Inputs, MeasureError, MeasureOptions, load_average, measure_within, processor_mhz,
};
use crate::reference::output::{ToneCurve, shown};
use crate::report::{
    Adapter, Comparison, Machine, Parameter, PipelineResult, ProcessRecord, SCHEMA, Seed,
};
use crate::tracer::{self, TracedScene};
use crate::{HdrImage, LabError};

/// Why a process measured nothing more.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The plan makes no sense.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A script or a shader has mistakes.
    #[error(transparent)]
    Problems(#[from] Problems),
    /// No device can be opened.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A frame could not be measured.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// A file could not be read or written.
    #[error(transparent)]
    Lab(#[from] LabError),
    /// It was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What a process has to say while it works.
#[derive(Clone, Debug, PartialEq)]
pub enum Remark {
    /// A scene's script printed it, or it is a warning of a model.
    Scene(LogLine),
    /// What had to be changed for a scene to fit the device.
    Warning(String),
    /// A point is measured and written.
    Done(String),
}

/// What a process needs to know.
#[derive(Clone, Debug)]
pub struct Process {
    /// Which one, from 0.
    pub index: u32,
    /// The points to measure, in this order.
    pub points: Vec<Planned>,
    /// The adapter.
    pub gpu: GpuOptions,
    /// Version of the program.
    pub program_version: String,
    /// The command of the whole study, ready to be typed again.
    pub command_line: String,
    /// The time as RFC 3339.
    pub clock: fn() -> String,
}

/// Measures points one after another and writes each when it is complete.
///
/// # Errors
/// What keeps a point from being measured. The points before it are on disk.
pub fn work(
    files: &Files,
    plan: &Plan,
    store: &Store,
    process: &Process,
    progress: &Progress,
    tell: &mut dyn FnMut(Remark),
) -> Result<(), StudyError> {
    let renderer = Renderer::new(Gpu::open(&process.gpu)?);
    let compiler = renderer.compiler();
    let inputs = Inputs::new();
    let mut worker = Worker {
        files: inputs.watch(files),
        inputs,
        plan,
        process,
        renderer,
        compiler,
        compiled: HashMap::new(),
        cache: Cache::default(),
        progress,
    };
    for point in &process.points {
        let allowances = allowances(plan, store, point, process.index)?;
        let comparison = worker.point(point, &allowances, tell)?;
        store.write(point, process.index, comparison)?;
        tell(Remark::Done(point.key.clone()));
    }
    Ok(())
}

/// Pipelines that were compiled, by their place in the plan, their settings and whether they draw all
/// reflection models.
type Compiled = HashMap<(usize, String, bool), Pipeline>;

struct Worker<'a> {
    files: Files,
    inputs: Inputs,
    plan: &'a Plan,
    process: &'a Process,
    renderer: Renderer,
    compiler: Compiler,
    compiled: Compiled,
    cache: Cache,
    progress: &'a Progress,
}

impl Worker<'_> {
    fn point(
        &mut self,
        point: &Planned,
        allowances: &[Allowance],
        tell: &mut dyn FnMut(Remark),
    ) -> Result<Comparison, StudyError> {
        self.progress.begin(format!("loading {}", point.key), 0.0)?;
        let mut scene = self.scene(point)?;
        scene
            .take_log()
            .into_iter()
            .map(Remark::Scene)
            .for_each(&mut *tell);
        let all = scene.has_update() || scene.assets.reflection_models().has_others();
        let mut pipelines = self.pipelines(point, all)?;

        let started = (self.process.clock)();
        let (load, mhz) = (load_average(), processor_mhz());
        let clock = std::time::Instant::now();
        self.renderer.reset_scene();
        let options = MeasureOptions {
            size: point.size,
            warmup: self.plan.warmup,
            settle: true,
            frames: self.plan.frames,
            step: self.plan.step,
            start: point.start,
            unqueried: true,
            // The pictures of the first process are the study's.
            pictures: self.process.index == 0,
            seconds: self.plan.seconds,
        };
        let traced = self.traced(point, &mut scene)?;
        let measured = measure_within(
            &mut self.renderer,
            &mut scene,
            &mut pipelines,
            options,
            allowances,
            self.progress,
        );
        let warnings = self.renderer.take_warnings();
        warnings
            .into_iter()
            .map(Remark::Warning)
            .for_each(&mut *tell);
        scene
            .take_log()
            .into_iter()
            .map(Remark::Scene)
            .for_each(&mut *tell);
        let mut measured = measured?;
        if self.progress.is_cancelled() {
            return Err(Cancelled.into());
        }
        self.keep(point, all, pipelines);
        for (choice, result) in self.plan.pipelines.iter().zip(&mut measured.pipelines) {
            rename(result, choice.label.as_deref());
        }
        let record = ProcessRecord {
            index: self.process.index,
            started,
            seconds: clock.elapsed().as_secs_f64(),
            load_average: load,
            processor_mhz: mhz,
        };
        let mut comparison = self.describe(point, &scene, record);
        comparison.pipelines = measured.pipelines;
        if let Some(reference) = traced {
            add_traced(&mut comparison, reference);
        }
        comparison.compare_pictures(DiffOptions::default())?;
        if self.process.index == 0 {
            self.add_views(point, &mut comparison)?;
        }
        Ok(comparison)
    }

    /// The scene at a point, before its first step.
    fn scene(&self, point: &Planned) -> Result<Scene, StudyError> {
        let limits = Limits::default().in_project(&self.files);
        let limits = limits.map_err(Problems::from)?;
        let path = &self.plan.scenes[point.scene].path;
        let settings = self.plan.scene_settings(point);
        let loaded = load_scene_within(
            &self.files,
            path,
            &settings,
            self.progress,
            &self.cache,
            &limits,
        );
        if self.progress.is_cancelled() {
            return Err(Cancelled.into());
        }
        let mut scene = loaded?;
        if let Some(camera) = &point.camera {
            look_through(&mut scene, camera)?;
        } else if let Some(view) = self.plan.view {
            stand(&mut scene, &view.into())?;
        }
        Ok(scene)
    }

    fn settings(
        &self,
        point: &Planned,
        index: usize,
    ) -> Result<(Settings, PipelineDesc), StudyError> {
        let choice = &self.plan.pipelines[index];
        let plain = load_pipeline(&self.files, &choice.path, &Settings::new())?;
        let name = choice.label.as_deref().unwrap_or(&plain.name);
        let has = |parameter: &str| plain.parameter(parameter).is_some();
        let settings = self.plan.pipeline_settings(point, choice, name, has);
        let desc = load_pipeline(&self.files, &choice.path, &settings)?;
        Ok((settings, desc))
    }

    /// The pipelines, compiled where no earlier point has done so.
    fn pipelines(&mut self, point: &Planned, all: bool) -> Result<Vec<Pipeline>, StudyError> {
        let mut pipelines = Vec::new();
        for index in 0..self.plan.pipelines.len() {
            let (settings, desc) = self.settings(point, index)?;
            let name = &desc.name;
            self.progress.begin(format!("compiling {name}"), 0.0)?;
            let known = self.compiled.remove(&(index, in_words(&settings), all));
            let variants = if all {
                Variants::ALL
            } else {
                Variants::DEFAULT_MODEL
            };
            let pipeline = match known {
                Some(pipeline) => pipeline,
                None => self.compiler.compile_for(&self.files, &desc, variants)?,
            };
            pipelines.push(pipeline);
        }
        Ok(pipelines)
    }

    /// Keeps the pipelines for a later point.
    fn keep(&mut self, point: &Planned, all: bool, pipelines: Vec<Pipeline>) {
        for (index, pipeline) in pipelines.into_iter().enumerate() {
            if let Ok((settings, _)) = self.settings(point, index) {
                let key = (index, in_words(&settings), all);
                self.compiled.insert(key, pipeline);
            }
        }
    }

    /// Counts the lights that each pixel evaluates, at the point's first moment, in pipelines of their
    /// own: counting costs time.
    fn add_views(
        &mut self,
        point: &Planned,
        comparison: &mut Comparison,
    ) -> Result<(), StudyError> {
        let mut scene = self.scene(point)?;
        for frame in 1..=point.start {
            let step = self.plan.step;
            let moved = scene.update(f64::from(frame) * step, step);
            moved.map_err(Problems::from)?;
        }
        self.renderer.reset_scene();
        let others = scene.has_update() || scene.assets.reflection_models().has_others();
        let variants = if others {
            Variants::ALL
        } else {
            Variants::DEFAULT_MODEL
        };
        let mut counts = Vec::new();
        for index in 0..self.plan.pipelines.len() {
            let (settings, desc) = self.settings(point, index)?;
            self.progress
                .begin(format!("counting the lights of {}", desc.name), 1.0)?;
            let settings = settings.with("heat_map", views::COUNTED);
            // A pipeline without heat maps has no such view.
            let path = &self.plan.pipelines[index].path;
            let Ok(desc) = load_pipeline(&self.files, path, &settings) else {
                counts.push(None);
                continue;
            };
            let compiled = self.compiler.compile_for(&self.files, &desc, variants);
            let Ok(mut pipeline) = compiled else {
                counts.push(None);
                continue;
            };
            let counted = views::count(&mut self.renderer, &mut scene, &mut pipeline, point.size);
            counts.push(counted.map_err(MeasureError::from)?);
        }
        // What it says of these frames it has said of those that were measured.
        self.renderer.take_warnings();
        let results = comparison.pipelines.iter_mut().filter(|p| p.name != TRACED);
        for (result, view) in results.zip(views::paint(&counts)) {
            result.views.extend(view);
        }
        Ok(())
    }

    /// The picture of the path tracer, where it is the reference and this process takes pictures.
    fn traced(&self, point: &Planned, scene: &mut Scene) -> Result<Option<HdrImage>, StudyError> {
        if self.plan.reference != TRACED || self.process.index > 0 {
            return Ok(None);
        }
        let step = self.plan.step;
        for frame in 1..=point.start {
            let moved = scene.update(f64::from(frame) * step, step);
            moved.map_err(Problems::from)?;
        }
        scene.refresh();
        let view = View::from_world(&scene.world).unwrap_or_default();
        let traced_scene = TracedScene::new(&scene.world, &scene.assets);
        let options = tracer::Options {
            size: point.size,
            mode: match self.plan.traced_samples {
                0 => tracer::Mode::Direct,
                _ => tracer::Mode::Full,
            },
            samples: self.plan.traced_samples.max(1),
            ..tracer::Options::default()
        };
        self.progress.begin("tracing the reference", 0.0)?;
        let traced = tracer::trace(&traced_scene, &view, &options, self.progress)?;
        if traced.stopped {
            return Err(Cancelled.into());
        }
        Ok(Some(traced.picture))
    }

    /// All of a comparison but its results.
    fn describe(&self, point: &Planned, scene: &Scene, record: ProcessRecord) -> Comparison {
        let parameters: Vec<Parameter> = scene
            .parameters
            .iter()
            .map(|parameter| Parameter {
                name: parameter.name.clone(),
                value: parameter.value.to_string(),
            })
            .collect();
        let seeds = parameters
            .iter()
            .filter(|parameter| parameter.name.contains("seed"))
            .filter_map(|parameter| {
                Some(Seed {
                    name: parameter.name.clone(),
                    value: parameter.value.parse().ok()?,
                })
            });
        let name = self.plan.scenes[point.scene].name();
        Comparison {
            schema: SCHEMA,
            title: format!("{name}: {}", counted(self.plan.pipelines.len(), "pipeline")),
            scene: name,
            command_line: self.process.command_line.clone(),
            created: (self.process.clock)(),
            program_version: self.process.program_version.clone(),
            machine: Machine::this(),
            adapter: Adapter::from(&self.renderer.gpu().summary),
            size: [point.size.0, point.size.1],
            frames: self.plan.frames,
            warmup_frames: self.plan.warmup,
            processes: vec![record],
            reference: self.plan.reference.clone(),
            seeds: seeds.collect(),
            parameters,
            inputs: self.inputs.list(&self.files),
            pipelines: Vec::new(),
            heat_map_scale: 1.0,
        }
    }
}

/// What the processes before this one have left of the time for each pipeline at a point.
fn allowances(
    plan: &Plan,
    store: &Store,
    point: &Planned,
    process: u32,
) -> Result<Vec<Allowance>, LabError> {
    let mut before = Vec::new();
    for earlier in 0..process {
        before.extend(store.read(point, earlier)?);
    }
    let of = |index: usize| {
        let results = before.iter().filter_map(|part| {
            let drawn = part.comparison.pipelines.iter();
            drawn.filter(|p| p.name != TRACED).nth(index)
        });
        let (mut spent, mut frames) = (Vec::new(), Vec::new());
        for result in results {
            spent.extend(&result.process_seconds);
            frames.extend(result.frame_wall_ms.iter().map(|ms| ms / 1e3));
        }
        Allowance::after(plan.seconds, &spent, &frames, plan.processes - process)
    };
    Ok((0..plan.pipelines.len()).map(of).collect())
}

/// Puts a traced picture first, shown as the first pipeline shows its own.
fn add_traced(comparison: &mut Comparison, traced: HdrImage) {
    let first = comparison.pipelines.first();
    let parameters = first.map_or(&[][..], |p| &p.parameters);
    let value = |name: &str| {
        let found = parameters.iter().find(|p| p.name == name);
        found.map(|p| p.value.as_str())
    };
    let exposure = value("exposure").and_then(|text| text.parse().ok());
    let curve: Option<ToneCurve> = value("tone_curve").and_then(|text| text.parse().ok());
    let picture = shown(&traced, exposure.unwrap_or(0.0), curve.unwrap_or_default());
    let reference = PipelineResult {
        name: TRACED.to_owned(),
        title: "Path tracer".to_owned(),
        picture: Some(picture),
        linear: Some(traced),
        ..PipelineResult::default()
    };
    comparison.pipelines.insert(0, reference);
}

/// Gives a result the label that the plan has for it.
fn rename(result: &mut PipelineResult, label: Option<&str>) {
    let Some(label) = label else { return };
    result.title = format!("{} ({label})", result.label());
    label.clone_into(&mut result.name);
}

fn in_words(settings: &Settings) -> String {
    let words: Vec<String> = settings.iter().map(|(n, v)| format!("{n}={v}")).collect();
    words.join("\n")
}
