//! `lightbench edit`: the window.

use std::path::Path;

use anyhow::anyhow;
use clap::Args;
use lightbench::assets::files::Files;
use lightbench::lab::lesson::{About, find_lesson, lesson_of};

use super::arguments::{GpuArguments, SceneArguments};
use super::doctor;
use super::load::{self, Request};
use crate::ui::workbench::reporting::WorkerOptions;
use crate::ui::{self, EditorOptions};

/// Arguments of `lightbench edit`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench edit
  lightbench edit many_lights --pipeline forward_single_pass --set lights=256
  lightbench edit showroom --model teapot.obj

Open a shader or a script of the project in any text editor beside it: save, and the picture
changes. `lightbench copy` brings a shipped file into the project.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai file; without it, that of
    /// the lesson that the project was begun from, or atrium
    #[arg(value_name = "SCENE")]
    scene: Option<String>,
    /// The pipeline to begin with: a name or the path of a .rhai file; without it, that of the lesson,
    /// or deferred_shading
    #[arg(long, value_name = "PIPELINE")]
    pipeline: Option<String>,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Runs the command.
///
/// # Errors
/// No display, no driver, or names that mean nothing.
pub fn run(arguments: &Arguments, mut files: Files, limits: Option<&Path>) -> anyhow::Result<()> {
    doctor::display().map_err(|why| {
        anyhow!(
            "the editor needs a display, and there is {why}. Without one, `lightbench render` \
             writes a picture and `lightbench compare` a report"
        )
    })?;
    let begun = files.project().and_then(lesson_of);
    // A lesson with mistakes is told in the window.
    let lesson = begun.and_then(|begun| find_lesson(&files, begun.asked()).ok());
    let of_lesson = |name: fn(&About) -> &String, or: &str| {
        let named = lesson.as_ref().map(|lesson| name(&lesson.about).clone());
        named.unwrap_or_else(|| or.to_owned())
    };
    let scene = arguments.scene.clone();
    let scene = scene.unwrap_or_else(|| of_lesson(|about| &about.scene, "atrium"));
    let pipeline = arguments.pipeline.clone();
    let pipeline =
        pipeline.unwrap_or_else(|| of_lesson(|about| &about.pipeline, "deferred_shading"));
    let request = Request {
        scene: &scene,
        arguments: &arguments.scene_arguments,
        pipelines: std::slice::from_ref(&pipeline),
        gpu: &arguments.gpu,
    };
    let scripts = load::scripts(&mut files, &request)?;
    let (pipeline, pipeline_settings) = scripts
        .pipelines
        .into_iter()
        .next()
        .ok_or_else(|| anyhow!("no pipeline was named"))?;
    ui::run(EditorOptions {
        scene: scripts.scene,
        scene_settings: scripts.scene_settings,
        pipeline,
        pipeline_settings,
        gpu: arguments.gpu.options(),
        kept: ui::kept::default_path(),
        worker: WorkerOptions {
            program: None,
            limits: limits.map(Path::to_owned),
        },
        files,
    })
}
