//! What an experiment needs and this crate can't do: loading, drawing, and reading what was drawn.
//!
//! The crate that has a renderer implements [`Laboratory`]; the functions of the scripts check their
//! arguments and call it.

use std::fmt;

use lightbench_render::inspect::{FirstInvalid, Part, PixelValue, Shown};
use lightbench_render::{PipelineDesc, Problems, RenderError, TargetImage};

use crate::settings::Settings;

/// One frame: a scene at a moment, through a pipeline, at a size.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// A scene's name or path.
    pub scene: String,
    /// Values of its parameters.
    pub scene_settings: Settings,
    /// A pipeline's name or path.
    pub pipeline: String,
    /// Values of its parameters.
    pub pipeline_settings: Settings,
    /// Width and height in pixels, both at least 1.
    pub size: (u32, u32),
    /// Which frame, from 0; the scene takes 60 steps a second.
    pub frame: u32,
}

/// A measurement: a scene that several pipelines draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// A scene's name or path.
    pub scene: String,
    /// Values of its parameters.
    pub scene_settings: Settings,
    /// Names or paths of pipelines, with values of their parameters.
    pub pipelines: Vec<(String, Settings)>,
    /// Width and height in pixels, both at least 1.
    pub size: (u32, u32),
    /// Frames that each pipeline draws first, unmeasured.
    pub warmup: u32,
    /// Frames that are measured of each pipeline.
    pub frames: u32,
}

/// A time in milliseconds: the median of frames and the interval that holds it with 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeSpan {
    /// The median.
    pub median: f64,
    /// Where the interval begins; the shortest time where there are too few frames for one.
    pub low: f64,
    /// Where it ends; the longest time where there are too few frames for one.
    pub high: f64,
}

/// What a frame of one pipeline cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// GPU time; absent where the adapter has no timestamps.
    pub gpu: Option<TimeSpan>,
    /// CPU time for extraction and recording.
    pub cpu: TimeSpan,
    /// Draw calls.
    pub draws: u64,
    /// Triangles drawn.
    pub triangles: u64,
    /// Bytes read and written, by the model of `bytes`.
    pub bytes: u64,
    /// Bytes of memory of all targets and buffers.
    pub memory: u64,
    /// What its shaders counted in the last frame.
    pub counters: Vec<(String, f64)>,
}

/// A study: pipelines at all combinations of some values, measured by fresh processes.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyTask {
    /// Heading of the report.
    pub title: String,
    /// Names or paths of scenes, with values of their parameters.
    pub scenes: Vec<(String, Settings)>,
    /// Names or paths of pipelines, with values of their parameters.
    pub pipelines: Vec<(String, Settings)>,
    /// What is varied, with its values as text: a parameter of the scenes, of a pipeline as
    /// `pipeline.parameter`, of all as `*.parameter`, or `size`, `start` or `camera`.
    pub sweep: Vec<(String, Vec<String>)>,
    /// Width and height in pixels, both at least 1.
    pub size: (u32, u32),
    /// The pipeline that the others are compared with, or `traced`; the first without it.
    pub reference: Option<String>,
    /// Samples a pixel of a traced reference; 0 for what pipelines draw.
    pub samples: u32,
    /// Frames that each pipeline draws first, unmeasured.
    pub warmup: u32,
    /// Frames that each process measures of each pipeline.
    pub frames: u32,
    /// The frame at which the scene is drawn first.
    pub start: u32,
    /// Seconds between two measured frames of the scene.
    pub step: Option<f64>,
    /// How many processes measure.
    pub processes: u32,
    /// The most seconds for a pipeline at a point.
    pub seconds: f64,
    /// The folder of the report, below the project's folder `out/`.
    pub out: String,
}

/// What a study found of one pipeline at one point.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyRow {
    /// The scene and the values of what is varied, by name.
    pub point: Vec<(String, String)>,
    /// The pipeline.
    pub pipeline: String,
    /// What it cost.
    pub cost: Cost,
    /// Mean FLIP against the reference; absent for the reference itself.
    pub flip: Option<f64>,
    /// Against the reference: `faster`, `slower`, `same`, or `undecided` where the intervals do not
    /// support any of these.
    pub verdict: &'static str,
}

/// Curves over one parameter, to be drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// What goes to the right.
    pub x: String,
    /// What goes up.
    pub y: String,
    /// Whether each factor of ten has the same length, to the right and up.
    pub logarithmic: [bool; 2],
    /// The curves, each with points in the order in which they are joined.
    pub curves: Vec<ChartCurve>,
}

/// One curve of a [`Chart`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartCurve {
    /// Its name.
    pub name: String,
    /// Its points.
    pub points: Vec<[f64; 2]>,
    /// For each point where its value may lie too, from and to; empty where that is not known.
    pub intervals: Vec<[f64; 2]>,
}

/// Draws frames and looks into them.
///
/// A shot says all that a frame depends on, so the same one always gives the same values, whatever
/// was asked before. What is made for one call may be kept for the next.
pub trait Laboratory: Send {
    /// Draws a frame, to see that it can be drawn, and gives the pipeline as it was built.
    ///
    /// # Errors
    /// A scene or a pipeline with mistakes, values that they refuse, or a frame that can't be drawn.
    fn draw(&mut self, shot: &Shot) -> Result<PipelineDesc, LaboratoryError>;

    /// A part of a target, as a pass leaves it; passes are counted from 0.
    ///
    /// # Errors
    /// As [`Laboratory::draw`], and a part that the target does not have.
    fn target(
        &mut self,
        shot: &Shot,
        pass: usize,
        target: &str,
        part: Part,
    ) -> Result<TargetImage, LaboratoryError>;

    /// What each pass did to a pixel, in the order of the passes.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn pixel(&mut self, shot: &Shot, pixel: (u32, u32))
    -> Result<Vec<PixelValue>, LaboratoryError>;

    /// The first pass that leaves a value that is no number, or infinite.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn first_invalid(&mut self, shot: &Shot) -> Result<Option<FirstInvalid>, LaboratoryError>;

    /// What frames of a scene cost in some pipelines, which are drawn in turn, so that what slows the
    /// machine slows all of them alike. One result a pipeline, in their order.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn measure(&mut self, task: &Task) -> Result<Vec<Cost>, LaboratoryError>;

    /// Measures a study, or goes on with it where some of it is measured already, and writes its report.
    ///
    /// # Errors
    /// As [`Laboratory::draw`], a folder that can't be written, or no program to start processes of.
    fn study(&mut self, task: &StudyTask) -> Result<Vec<StudyRow>, LaboratoryError>;

    /// How far an image is from a reference, each number with the name of its metric.
    ///
    /// # Errors
    /// Images of different sizes, or of formats that hold no picture.
    fn compare(
        &self,
        reference: &TargetImage,
        image: &TargetImage,
    ) -> Result<Vec<(&'static str, f64)>, LaboratoryError>;

    /// The bytes of a plot of curves, as SVG.
    fn plot(&self, chart: &Chart) -> Vec<u8>;

    /// What the scene's scripts have plotted under a name until this frame, oldest first. Empty where
    /// they plotted nothing.
    ///
    /// # Errors
    /// As [`Laboratory::draw`].
    fn values(&mut self, shot: &Shot, name: &str) -> Result<Vec<f64>, LaboratoryError>;

    /// The bytes of a picture file: of an EXR where the path ends so, else of a PNG.
    ///
    /// # Errors
    /// A target without texels.
    fn encode(
        &self,
        path: &str,
        image: &TargetImage,
        shown: Shown,
    ) -> Result<Vec<u8>, LaboratoryError>;
}

/// Why a laboratory could not do what it was asked.
#[derive(Debug)]
pub enum LaboratoryError {
    /// Mistakes in a scene, a pipeline, a shader, or in the values for them.
    Files(Problems),
    /// The frame can't be drawn, or not be read.
    Render(RenderError),
    /// Anything else, in words.
    Other(String),
}

impl fmt::Display for LaboratoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Files(problems) => problems.fmt(f),
            Self::Render(error) => error.fmt(f),
            Self::Other(words) => f.write_str(words),
        }
    }
}

impl std::error::Error for LaboratoryError {}

impl From<Problems> for LaboratoryError {
    fn from(problems: Problems) -> Self {
        Self::Files(problems)
    }
}

impl From<RenderError> for LaboratoryError {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}
