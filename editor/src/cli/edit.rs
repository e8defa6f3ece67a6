//! `lightbench edit`: the window.

use std::path::Path;

use anyhow::anyhow;
use clap::Args;
use lightbench::assets::files::Files;

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
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai file
    #[arg(value_name = "SCENE", default_value = "atrium")]
    scene: String,
    /// The pipeline to begin with: a name or the path of a .rhai file
    #[arg(long, value_name = "PIPELINE", default_value = "deferred_shading")]
    pipeline: String,
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
    let request = Request {
        scene: &arguments.scene,
        arguments: &arguments.scene_arguments,
        pipelines: std::slice::from_ref(&arguments.pipeline),
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
