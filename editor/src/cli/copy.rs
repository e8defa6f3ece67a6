//! `lightbench copy`: a shipped file in the project, to edit it there.

use clap::Args;
use lightbench::assets::files::{Files, Origin};

use super::project;
use super::report::{note, say};

/// Arguments of `lightbench copy`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench copy scripts/scenes/atrium.rhai
  lightbench copy scripts/pipelines/deferred_shading.rhai
  lightbench copy shaders/lib/lighting.wgsl

A copy that the project has already stays as it is.")]
pub struct Arguments {
    /// The file's path in the program, as `lightbench list files` prints it
    #[arg(value_name = "FILE")]
    file: String,
}

/// Copies a shipped file into the project.
///
/// # Errors
/// No project, no such file, or a folder that can't be written.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    let path = project::path_in_project(files, &arguments.file)?;
    let was_there = matches!(files.origin(&path)?, Origin::Project(_));
    let place = files.copy_to_project(&path)?;
    if was_there {
        note("The project has this file already; it stays as it is.");
    }
    say(place.display().to_string())
}
