//! What a study asks, and what it found.

use glam::Mat4;
use lightbench_render::View;
use serde::{Deserialize, Serialize};

use crate::report::{Comparison, Parameter};

/// What to measure: every pipeline at every point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Heading of the report.
    pub title: String,
    /// Scenes, as their loader takes them, with the values of their parameters.
    pub scenes: Vec<Choice>,
    /// Pipelines, as their loader takes them, with the values of their parameters.
    pub pipelines: Vec<Choice>,
    /// What is varied; the points are all combinations of their values.
    #[serde(default)]
    pub axes: Vec<Axis>,
    /// Width and height in pixels, where no axis says it.
    pub size: [u32; 2],
    /// The pipeline whose picture the others are compared with, or [`TRACED`].
    pub reference: String,
    /// Samples a pixel of a reference that is traced.
    #[serde(default)]
    pub traced_samples: u32,
    /// Frames drawn first by each pipeline and not measured, at the least.
    pub warmup: u32,
    /// Frames measured of each pipeline in each process.
    pub frames: u32,
    /// Seconds between two frames of the scene.
    pub step: f64,
    /// Frames that the scene moves on before the first one that is drawn.
    #[serde(default)]
    pub start: u32,
    /// Fresh processes that measure each point.
    pub processes: u32,
    /// Seconds for one pipeline at one point, over all processes.
    pub seconds: f64,
    /// A camera in place of the scenes' own ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub view: Option<FixedView>,
    /// Values of pipelines' parameters that were chosen because they are the fastest at a point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tuned: Vec<Tuned>,
    /// Folders outside of the project that scenes and pipelines are read from: `@0/` begins the paths
    /// of those in the first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<std::path::PathBuf>,
}

/// A camera that stands still, whatever the scene does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FixedView {
    /// World to view, column by column.
    pub view: [f32; 16],
    /// Full vertical angle, radians.
    pub fov_y: f32,
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres; none where it is infinitely far.
    pub far: Option<f32>,
}

impl From<View> for FixedView {
    fn from(view: View) -> Self {
        Self {
            view: view.view.to_cols_array(),
            fov_y: view.fov_y,
            near: view.near,
            far: view.far.is_finite().then_some(view.far),
        }
    }
}

impl From<FixedView> for View {
    fn from(fixed: FixedView) -> Self {
        Self {
            view: Mat4::from_cols_array(&fixed.view),
            fov_y: fixed.fov_y,
            near: fixed.near,
            far: fixed.far.unwrap_or(f32::INFINITY),
        }
    }
}

/// The reference that is no pipeline: the path tracer.
pub const TRACED: &str = "traced";

/// A scene or a pipeline with the values that it is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Its name in the report, where one file is measured with different values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// A name or a path.
    pub path: String,
    /// Names of parameters with their values as text.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub settings: Vec<Parameter>,
}

/// Values that a pipeline has at one point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tuned {
    /// The point.
    pub key: String,
    /// The pipeline's name in the report.
    pub pipeline: String,
    /// All of its values.
    pub settings: Vec<Parameter>,
}

/// Something that a study varies.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// What it varies: a parameter of the scenes by its name, a parameter of a pipeline as
    /// `pipeline.parameter`, of all pipelines that have it as `*.parameter`, or [`SIZE`], [`START`]
    /// or [`CAMERA`].
    pub name: String,
    /// Its values as text, in the order in which they are measured.
    pub values: Vec<String>,
}

/// The axis of the picture's size, with values as `640x360`.
pub const SIZE: &str = "size";
/// The axis of the frame at which the scene is drawn first: along a path of the camera, a place.
pub const START: &str = "start";
/// The axis of cameras, by the names of their entities.
pub const CAMERA: &str = "camera";

/// What a study found so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// [`crate::report::SCHEMA`].
    pub schema: u32,
    /// What was asked.
    pub plan: Plan,
    /// The points that at least one process has measured, in the order of the plan.
    pub points: Vec<Point>,
    /// Keys of the points that not all processes have measured, in the order of the plan.
    pub missing: Vec<String>,
}

/// All pipelines at one combination of values, measured on one machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Names the point in all runs of the same plan, as `scene=atrium,lights=64`.
    pub key: String,
    /// The values, the scene first.
    pub coordinates: Vec<Parameter>,
    /// What was measured there.
    pub comparison: Comparison,
}
