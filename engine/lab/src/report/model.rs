//! A comparison of pipelines as data: what the JSON file holds.

use serde::{Deserialize, Serialize};

use crate::colormap::ColorMap;
use crate::diff::{DiffOptions, LdrDifference, diff_ldr};
use crate::heatmap::{heat_map, round_scale};
use crate::metrics::{LinearErrors, linear_errors};
use crate::{HdrImage, LabError, LdrImage};

/// Version of the data model. It grows when a field changes its meaning or goes away; a new field
/// that older readers may ignore does not change it.
pub const SCHEMA: u32 = 2;

/// Several pipelines measured on one scene, machine and adapter.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Heading of the report.
    pub title: String,
    /// Name of the scene.
    pub scene: String,
    /// The command that made the report, ready to be typed again.
    pub command_line: String,
    /// When the measurement ended, RFC 3339.
    pub created: String,
    /// Version of Lightbench.
    pub program_version: String,
    /// The computer.
    pub machine: Machine,
    /// The graphics adapter.
    pub adapter: Adapter,
    /// Width and height of the pictures in pixels.
    pub size: [u32; 2],
    /// Frames measured of each pipeline in each process.
    pub frames: u32,
    /// Frames drawn before at the least, and not measured.
    pub warmup_frames: u32,
    /// The processes that measured, in order. Empty in reports of versions that measured in one.
    #[serde(default)]
    pub processes: Vec<ProcessRecord>,
    /// Name of the pipeline that the others are compared with.
    pub reference: String,
    /// Parameters of the whole comparison, such as the scene's.
    pub parameters: Vec<Parameter>,
    /// Seeds of all random numbers.
    pub seeds: Vec<Seed>,
    /// Files that went in, with their hashes.
    pub inputs: Vec<Input>,
    /// The results, in the order in which the pipelines were asked for.
    pub pipelines: Vec<PipelineResult>,
    /// The FLIP value that the heat maps paint with their last colour.
    #[serde(default = "full_scale")]
    pub heat_map_scale: f32,
}

/// The computer that measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor.
    pub cpu: String,
    /// Logical processors that the program could use.
    pub cores: u32,
    /// Main memory in bytes.
    pub memory_bytes: u64,
    /// Operating system with its version.
    pub os: String,
}

/// One process that measured all pipelines in turn.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProcessRecord {
    /// Counted from 0.
    pub index: u32,
    /// When it began to measure, RFC 3339.
    pub started: String,
    /// Seconds that measuring took, without loading and compiling.
    pub seconds: f64,
    /// How many programs wanted a core at a time, over the minute before; absent where the system
    /// does not tell.
    pub load_average: Option<f64>,
    /// Clock of the processor's cores in the mean when it began, in MHz; absent where the system does
    /// not tell.
    pub processor_mhz: Option<f64>,
}

/// The graphics adapter that drew.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Adapter {
    /// Name of the device.
    pub name: String,
    /// Name of the driver.
    pub driver: String,
    /// Version of the driver.
    pub driver_info: String,
    /// Graphics interface, such as Vulkan.
    pub backend: String,
    /// Kind of device, such as "discrete GPU" or "CPU".
    pub kind: String,
    /// Whether a processor imitates a graphics card. Its times are labelled as such everywhere.
    pub software: bool,
}

/// A named setting and its value as text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name of the setting.
    pub name: String,
    /// The value as text.
    pub value: String,
}

/// A named seed of random numbers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Seed {
    /// What draws from it.
    pub name: String,
    /// The seed.
    pub value: u64,
}

/// A file that went into the measurement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// Path, relative to the project.
    pub path: String,
    /// Name of the hash function.
    pub algorithm: String,
    /// Hash of the content as text.
    pub hash: String,
}

/// What one pipeline cost and how its picture differs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PipelineResult {
    /// Name of the pipeline, unique in the comparison.
    pub name: String,
    /// Name for people.
    pub title: String,
    /// What the pipeline does, one or two sentences.
    pub description: String,
    /// Values of its parameters.
    pub parameters: Vec<Parameter>,
    /// Features and limits of the adapter that it needs beyond the default ones.
    pub features_needed: Vec<String>,
    /// CPU time of each measured frame in milliseconds, in order, process after process.
    pub frame_cpu_ms: Vec<f64>,
    /// How many of the frames each process measured, in order. Empty where one process measured all.
    #[serde(default)]
    pub process_frames: Vec<u32>,
    /// Frames that each process drew until the times had settled, in order. 0 where there was no time
    /// for one: then the driver had only made its programs ready.
    #[serde(default)]
    pub settled_after: Vec<u32>,
    /// Seconds that each process took to draw it, warming up included, in order.
    #[serde(default)]
    pub process_seconds: Vec<f64>,
    /// Whether fewer frames than asked for were measured, since the time for a point was up.
    #[serde(default)]
    pub cut: bool,
    /// Time of each measured frame from its first line of code until the device had finished it, in
    /// milliseconds.
    #[serde(default)]
    pub frame_wall_ms: Vec<f64>,
    /// The same of frames whose passes were not timed, in order, process after process. What the
    /// queries themselves cost is the difference.
    #[serde(default)]
    pub unqueried_wall_ms: Vec<f64>,
    /// GPU time of each measured frame in milliseconds, in order; absent where the adapter has no
    /// timestamps.
    pub frame_gpu_ms: Option<Vec<f64>>,
    /// Why GPU times are absent.
    pub gpu_why_not: Option<String>,
    /// The script and the systems of the world in the order in which they run, then what makes a
    /// frame of the world. Empty in reports of versions that did not measure them.
    #[serde(default)]
    pub systems: Vec<SystemResult>,
    /// The passes in the order in which they run.
    pub passes: Vec<PassResult>,
    /// The targets that it declares.
    pub targets: Vec<TargetResult>,
    /// Bytes of memory of all targets and buffers, after targets that share a texture are counted
    /// once.
    pub target_bytes_total: u64,
    /// Bytes that targets would take beyond that if none shared its texture.
    #[serde(default)]
    pub saved_bytes: u64,
    /// What its shaders counted.
    #[serde(default)]
    pub counters: Vec<CounterResult>,
    /// What it says that it can do and what not.
    #[serde(default)]
    pub abilities: Vec<AbilityResult>,
    /// Where the adapter's limits changed it, and how many materials it drew with another reflection
    /// model, in a sentence each.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Its picture against that of the reference, in 8-bit sRGB; absent for the reference.
    pub difference: Option<LdrDifference>,
    /// The same before the tone curve, in linear light.
    pub linear_difference: Option<LinearErrors>,
    /// File of the picture beside the JSON file.
    pub picture_file: Option<String>,
    /// File of the FLIP heat map beside the JSON file.
    pub heat_map_file: Option<String>,
    /// The picture; not part of the JSON.
    #[serde(skip)]
    pub picture: Option<LdrImage>,
    /// FLIP of each pixel, painted with magma from 0 to 1; not part of the JSON.
    #[serde(skip)]
    pub heat_map: Option<LdrImage>,
    /// The picture before the tone curve, in linear light; not part of the JSON.
    #[serde(skip)]
    pub linear: Option<HdrImage>,
    /// Counts a pixel as pictures, such as the lights that each pixel evaluated.
    #[serde(default)]
    pub views: Vec<ViewResult>,
}

/// A count a pixel as a picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ViewResult {
    /// What is counted, as `lights evaluated`. Views of one name are compared with each other.
    pub name: String,
    /// What the colours mean: the map and the count that its last colour stands for.
    pub description: String,
    /// File of the picture beside the JSON file.
    pub file: Option<String>,
    /// The picture; not part of the JSON.
    #[serde(skip)]
    pub picture: Option<LdrImage>,
}

/// A number that shaders counted, as lights on lists.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CounterResult {
    /// Name of the counter, unique in its pipeline.
    pub name: String,
    /// What it counts.
    pub description: String,
    /// Its value after each measured frame.
    pub values: Vec<f64>,
}

/// Something that a pipeline can do, or can't.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AbilityResult {
    /// What it is about, as `transparency`.
    pub name: String,
    /// Whether the pipeline can do it.
    pub supported: bool,
    /// By which means, or why not.
    pub text: String,
}

/// What one system cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SystemResult {
    /// Name of the system, unique in the frame.
    pub name: String,
    /// CPU time of the thread that ran it, in each measured frame, in milliseconds. Work that it
    /// handed to other threads is not in it.
    pub thread_ms: Vec<f64>,
}

/// What one pass cost. Counts are those of one frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PassResult {
    /// Name of the pass, unique in its pipeline.
    pub name: String,
    /// Kind of the pass, such as `geometry` or `compute`.
    pub kind: String,
    /// GPU time in each measured frame in milliseconds; absent where it can't be measured.
    pub gpu_ms: Option<Vec<f64>>,
    /// CPU time for recording the pass in each measured frame in milliseconds.
    pub cpu_ms: Vec<f64>,
    /// Draw calls.
    pub draws: u64,
    /// Instances drawn.
    pub instances: u64,
    /// Triangles drawn.
    pub triangles: u64,
    /// Fragment shader invocations, where the adapter counts them.
    pub fragments: Option<u64>,
    /// Vertex shader invocations, where the adapter counts them.
    #[serde(default)]
    pub vertices: Option<u64>,
    /// Compute dispatches.
    pub dispatches: u64,
    /// Whether it did not run, since nobody uses what it writes.
    #[serde(default)]
    pub dropped: bool,
    /// Bytes read, modelled from the declared formats and sizes.
    pub bytes_read: u64,
    /// Bytes written, modelled from the declared formats and sizes.
    pub bytes_written: u64,
    /// Bytes of stencil tested and written, modelled.
    #[serde(default)]
    pub bytes_stencil: u64,
    /// Bytes of attachments that a tile-based GPU loads before the pass, modelled.
    #[serde(default)]
    pub bytes_loaded: u64,
    /// Bytes of attachments that a tile-based GPU stores after the pass, modelled.
    #[serde(default)]
    pub bytes_stored: u64,
    /// Bytes of fragments beyond one a covered pixel, where the adapter counts fragments.
    #[serde(default)]
    pub bytes_overdraw: Option<u64>,
    /// Why a value is absent.
    pub why_not: Option<String>,
}

/// A target that a pipeline draws to.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TargetResult {
    /// Name of the target.
    pub name: String,
    /// Format of a pixel.
    pub format: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Bytes of memory, all layers and mips.
    pub bytes: u64,
}

/// The scale of reports that do not say it.
fn full_scale() -> f32 {
    1.0
}

impl Comparison {
    /// The result that the others are compared with, if it was measured.
    pub fn reference_result(&self) -> Option<&PipelineResult> {
        self.pipelines.iter().find(|p| p.name == self.reference)
    }

    /// Fills in the differences and heat maps of all pipelines but the reference from their
    /// pictures.
    ///
    /// # Errors
    /// If two pictures differ in size or an option is out of range. Without a picture of the
    /// reference nothing is filled in.
    pub fn compare_pictures(&mut self, options: DiffOptions) -> Result<(), LabError> {
        let Some(reference) = self.reference_result().and_then(|r| r.picture.clone()) else {
            return Ok(());
        };
        let linear_reference = self.reference_result().and_then(|r| r.linear.clone());
        let mut maps = Vec::new();
        for pipeline in self
            .pipelines
            .iter_mut()
            .filter(|p| p.name != self.reference)
        {
            if let Some(picture) = &pipeline.picture {
                let diff = diff_ldr(&reference, picture, options)?;
                maps.push((pipeline.name.clone(), diff.map));
                pipeline.difference = Some(diff.difference);
            }
            if let (Some(reference), Some(test)) = (&linear_reference, &pipeline.linear) {
                pipeline.linear_difference = Some(linear_errors(reference, test)?);
            }
        }
        // One scale for all, so that their colours can be compared.
        let largest = maps
            .iter()
            .flat_map(|(_, map)| &map.values)
            .copied()
            .fold(0.0, f32::max);
        self.heat_map_scale = round_scale(largest);
        for pipeline in &mut self.pipelines {
            if let Some((_, map)) = maps.iter().find(|(name, _)| *name == pipeline.name) {
                pipeline.heat_map = Some(heat_map(map, ColorMap::Magma, self.heat_map_scale));
            }
        }
        Ok(())
    }
}

impl PipelineResult {
    /// The finite GPU times of the frames, if any were measured.
    pub fn gpu_samples(&self) -> Option<&[f64]> {
        self.frame_gpu_ms
            .as_deref()
            .filter(|s| s.iter().any(|v| v.is_finite()))
    }

    /// A series of the measured frames, cut into those of each process.
    pub fn by_process<'a>(&self, series: &'a [f64]) -> Vec<&'a [f64]> {
        if self.process_frames.is_empty() {
            return vec![series];
        }
        let mut rest = series;
        let mut parts = Vec::with_capacity(self.process_frames.len());
        for frames in &self.process_frames {
            let (part, after) = rest.split_at((*frames as usize).min(rest.len()));
            parts.push(part);
            rest = after;
        }
        parts
    }

    /// The name for people, or the plain name where there is none.
    pub fn label(&self) -> &str {
        if self.title.is_empty() {
            &self.name
        } else {
            &self.title
        }
    }
}
