//! The Rhai interface: scenes, pipelines and experiments.
//!
//! - [`load_pipeline`] evaluates a file of `scripts/pipelines/` into a
//!   [`PipelineDesc`](lightbench_render::PipelineDesc).
//! - [`load_scene`] runs a file of `scripts/scenes/` into a [`Scene`], whose script may move it.
//! - [`run_experiment`] runs a file of `scripts/experiments/`, which looks into frames through a
//!   [`Laboratory`].
//! - [`CheckScript`] has the checks of a lesson, which look into what a student handed in and tell an
//!   [`Examiner`] what they found.
//!
//! Scripts are not trusted. They reach no file outside of the project, and [`Limits`] bound their
//! time, their memory and the size of everything they make. Every mistake is a
//! [`Problem`](lightbench_render::Problem) with its file, line and column, in words that name no
//! type of the program.
#![warn(missing_docs)]

pub mod abilities;
mod api;
mod arguments;
mod color;
mod compile;
mod division;
mod easing;
mod errors;
mod experiment;
mod host;
#[cfg(test)]
mod hostile_tests;
mod limits;
mod lines;
mod log;
mod math;
mod matrix;
mod memory;
#[cfg(test)]
mod message_tests;
mod names;
mod noise;
mod parameters;
mod pipeline;
mod random;
pub mod reference;
mod resolver;
mod scene;
mod settings;
mod sources;
mod spelling;
mod syntax;
#[cfg(test)]
mod testing;

pub use experiment::{
    Bound, Chart, ChartCurve, CheckFault, CheckScript, Cost, Data, EXPERIMENTS, Evidence, Examiner,
    Expected, Given, Laboratory, LaboratoryError, Shot, StudyRow, StudyTask, Task, TimeSpan, Told,
    check_names, experiment_names, run_experiment,
};
pub use limits::{GivenLimits, Limits};
pub use lines::draw_line;
pub use log::LogLine;
pub use memory::CountingAllocator;
pub use names::{Entry, Names};
pub use parameters::{SceneParameter, SceneParameterKind};
pub use pipeline::{PIPELINES, PipelineEntry, list_pipelines, load_pipeline, load_pipeline_within};
pub use scene::{
    BEHAVIOURS, BehaviourInfo, KeptState, PipelineChoice, Ray, SCENE_EXTENSION, SCENES, Scene,
    SceneEntry, SceneEvent, SceneSnapshot, console, list_scenes, load_scene, load_scene_again,
    load_scene_within, overlays, plots, scene_names,
};
pub use settings::{SettingValue, Settings};
