//! `lightbench new` and `lightbench copy`: a project and what is in it.

use std::path::PathBuf;

use clap::Args;
use lightbench::assets::files::{Files, Origin, create_project};

use super::project;
use super::report::{note, say};

/// Arguments of `lightbench new`.
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  lightbench new lighting-course
  cd lighting-course
  lightbench copy shaders/output.wgsl     then edit it: your copy is used from now on
  lightbench edit

A file of the project is used in place of the shipped one of the same path. Delete your copy to have
the shipped file again. A new version of the program never changes a project.")]
pub struct NewArguments {
    /// The folder to make; if it exists, it must be empty
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Makes a project.
///
/// # Errors
/// A folder with something in it, or one that can't be made.
pub fn new(arguments: &NewArguments) -> anyhow::Result<()> {
    let folder = create_project(&arguments.folder)?;
    say(folder.display().to_string())?;
    note(format!(
        "Start with: cd \"{}\" && lightbench edit",
        arguments.folder.display()
    ));
    Ok(())
}

/// Arguments of `lightbench copy`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench copy scripts/scenes/atrium.rhai
  lightbench copy scripts/pipelines/deferred_shading.rhai
  lightbench copy shaders/lib/lighting.wgsl

A copy that the project has already stays as it is.")]
pub struct CopyArguments {
    /// The file's path in the program, as `lightbench list files` prints it
    #[arg(value_name = "FILE")]
    file: String,
}

/// Copies a shipped file into the project.
///
/// # Errors
/// No project, no such file, or a folder that can't be written.
pub fn copy(arguments: &CopyArguments, files: &Files) -> anyhow::Result<()> {
    let path = project::path_in_project(files, &arguments.file)?;
    let was_there = matches!(files.origin(&path)?, Origin::Project(_));
    let place = files.copy_to_project(&path)?;
    if was_there {
        note("The project has this file already; it stays as it is.");
    }
    say(place.display().to_string())
}
