//! The measurements of one pipeline, frame by frame.

use lightbench_render::Pipeline;
use lightbench_render::gpu::Gpu;
use lightbench_world::SystemTime;

use super::Drawn;
use crate::report::{
    AbilityResult, CounterResult, Parameter, PassResult, PipelineResult, SystemResult, TargetResult,
};

/// What the adapter can't measure, in words for the report.
#[derive(Clone, Debug)]
pub(super) struct Missing {
    gpu_time: Option<String>,
    fragments: Option<String>,
}

impl Missing {
    pub(super) fn of(gpu: &Gpu) -> Self {
        let name = &gpu.summary.name;
        let lacks = |what: &str| format!("{name}: {what}");
        Self {
            gpu_time: (!gpu.has_timestamps())
                .then(|| lacks("no timestamp queries, so the GPU time is unknown")),
            fragments: (!gpu.has_pipeline_statistics())
                .then(|| lacks("no pipeline statistics, so fragments are not counted")),
        }
    }
}

/// Collects frames of one pipeline.
#[derive(Clone)]
pub(super) struct Series {
    result: PipelineResult,
    /// GPU time of each frame and of its passes; NaN where a frame's queries were lost.
    frames: Vec<f64>,
    passes: Vec<Vec<f64>>,
    /// How many of the counters the GPU counts; the others count lights without a place.
    counters: usize,
    /// The passes that spread lights over arrays, in the order of those counters.
    spreading: Vec<usize>,
}

impl Series {
    pub(super) fn new(pipeline: &Pipeline, frames: usize) -> Self {
        let desc = &pipeline.desc;
        let passes = desc.passes.iter().map(|pass| PassResult {
            name: pass.name.clone(),
            kind: pass.kind.name().to_owned(),
            cpu_ms: Vec::with_capacity(frames),
            ..PassResult::default()
        });
        let parameters = desc.parameters.iter().map(|parameter| Parameter {
            name: parameter.name.clone(),
            value: parameter.value.to_string(),
        });
        let abilities = desc.abilities.iter().map(|ability| AbilityResult {
            name: ability.name.clone(),
            supported: ability.supported,
            text: ability.text.clone(),
        });
        let counters = desc.counters.iter().map(|counter| CounterResult {
            name: counter.name.clone(),
            description: counter.description.clone(),
            values: Vec::with_capacity(frames),
        });
        let unplaced = desc.passes.iter().filter_map(|pass| {
            Some(CounterResult {
                name: format!("unplaced_lights of {}", pass.name),
                description: pass.unplaced_in_words()?,
                values: Vec::with_capacity(frames),
            })
        });
        Self {
            result: PipelineResult {
                name: desc.name.clone(),
                title: desc.title.clone(),
                description: desc.description.clone(),
                parameters: parameters.collect(),
                features_needed: desc.features_needed(),
                notes: pipeline.notes.clone(),
                abilities: abilities.collect(),
                counters: counters.chain(unplaced).collect(),
                passes: passes.collect(),
                frame_cpu_ms: Vec::with_capacity(frames),
                ..PipelineResult::default()
            },
            frames: Vec::with_capacity(frames),
            passes: vec![Vec::with_capacity(frames); desc.passes.len()],
            counters: desc.counters.len(),
            spreading: (0..desc.passes.len())
                .filter(|index| desc.passes[*index].unplaced_in_words().is_some())
                .collect(),
        }
    }

    /// Says once that lights shine beyond their clip volumes.
    fn note_unconfined(&mut self, lights: u32) {
        let notes = &mut self.result.notes;
        let about = "shine beyond their clip volumes";
        if lights > 0 && !notes.iter().any(|note| note.contains(about)) {
            notes.push(format!(
                "{lights} lights {about}: this pipeline can't confine them"
            ));
        }
    }

    /// Adds a frame. `stepped` is what the systems took to reach its moment.
    pub(super) fn add(&mut self, stepped: &[SystemTime], frame: &Drawn) {
        let statistics = &frame.statistics;
        let measured = frame.queries.as_ref();
        self.result.frame_wall_ms.push(frame.wall * 1e3);
        for time in stepped.iter().chain(&statistics.systems) {
            self.add_system(time);
        }
        if statistics.replaced_models.total() > 0 {
            let note = statistics.replaced_models.to_string();
            if !self.result.notes.contains(&note) {
                self.result.notes.push(note);
            }
        }
        self.note_unconfined(statistics.unconfined_lights);
        let cpu = statistics.extract_ms + statistics.record_ms;
        self.result.frame_cpu_ms.push(cpu);
        let total = measured.and_then(|measured| measured.total_ms);
        self.frames.push(total.unwrap_or(f64::NAN));
        let counts = measured.map_or(&[][..], |measured| &measured.counters);
        let (counted, unplaced) = self.result.counters.split_at_mut(self.counters);
        for (counter, value) in counted.iter_mut().zip(counts) {
            counter.values.push(f64::from(*value));
        }
        for (counter, pass) in unplaced.iter_mut().zip(&self.spreading) {
            let cost = &statistics.passes[*pass];
            counter.values.push(f64::from(cost.unplaced_lights));
        }
        let passes = self.result.passes.iter_mut().zip(&mut self.passes);
        for (index, ((pass, times), cost)) in passes.zip(&statistics.passes).enumerate() {
            let time = measured.and_then(|measured| measured.gpu_ms.get(index));
            times.push(time.copied().unwrap_or(f64::NAN));
            pass.cpu_ms.push(cost.cpu_ms);
            pass.draws = u64::from(cost.draws);
            pass.instances = u64::from(cost.instances);
            pass.triangles = cost.triangles;
            pass.dispatches = u64::from(cost.dispatches);
            pass.dropped = cost.dropped;
            pass.bytes_read = cost.traffic.read;
            pass.bytes_written = cost.traffic.written;
            pass.bytes_stencil = cost.traffic.stencil;
            pass.bytes_loaded = cost.traffic.loaded;
            pass.bytes_stored = cost.traffic.stored;
            if let Some(measured) = measured {
                pass.fragments = measured.fragments.get(index).copied();
                let fragments = pass.fragments.filter(|_| cost.traffic.pixels > 0);
                pass.bytes_overdraw = fragments.map(|count| cost.traffic.overdraw(count));
                pass.vertices = measured.vertices.get(index).copied();
            }
        }
    }

    /// Adds a frame without queries, which took so many seconds.
    pub(super) fn add_unqueried(&mut self, wall: f64) {
        self.result.unqueried_wall_ms.push(wall * 1e3);
    }

    fn add_system(&mut self, time: &SystemTime) {
        let systems = &mut self.result.systems;
        let at = systems.iter().position(|known| known.name == time.name);
        let at = at.unwrap_or_else(|| {
            systems.push(SystemResult {
                name: time.name.to_owned(),
                ..SystemResult::default()
            });
            systems.len() - 1
        });
        systems[at].thread_ms.push(time.thread_ms());
    }

    /// The frames as a result, without its picture.
    pub(super) fn finish(self, pipeline: &Pipeline, missing: &Missing) -> PipelineResult {
        let mut result = self.result;
        let timed = missing.gpu_time.is_none();
        result.frame_gpu_ms = timed.then_some(self.frames);
        result.gpu_why_not.clone_from(&missing.gpu_time);
        for (pass, times) in result.passes.iter_mut().zip(self.passes) {
            pass.gpu_ms = timed.then_some(times);
            let reasons = [&missing.gpu_time, &missing.fragments];
            let reasons: Vec<&str> = reasons.into_iter().flatten().map(String::as_str).collect();
            pass.why_not = (!reasons.is_empty()).then(|| reasons.join("; "));
        }
        let memory = pipeline.target_memory();
        let targets = pipeline.targets();
        result.target_bytes_total = targets.map_or(0, |targets| targets.bytes());
        result.saved_bytes = targets.map_or(0, |targets| targets.saved_bytes);
        result.targets = memory
            .into_iter()
            .map(|target| TargetResult {
                name: target.name,
                format: target.format.name(),
                size: [target.size.0, target.size.1],
                samples: target.samples,
                bytes: target.bytes,
            })
            .collect();
        result
    }
}
