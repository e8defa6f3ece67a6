//! `lightbench new`: a project, or a pipeline or a lesson in one.

mod lesson;
mod name;
mod pipeline;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use lightbench::assets::files::{Files, create_project};

use super::report::{Usage, note, say};

/// Arguments of `lightbench new`.
#[derive(Args, Debug)]
#[command(
    arg_required_else_help = true,
    args_conflicts_with_subcommands = true,
    override_usage = "lightbench new project <DIR>\n       \
        lightbench new pipeline <NAME> [--project <DIR>]\n       \
        lightbench new lesson <NAME> [--project <DIR>]\n       \
        lightbench new <DIR>",
    after_help = "\
Examples:
  lightbench new project lighting-course
  cd lighting-course
  lightbench new pipeline mine            a pipeline that draws, and its shader, to change
  lightbench copy shaders/output.wgsl     then edit it: your copy is used from now on
  lightbench edit --pipeline mine

`lightbench new DIR` is short for `lightbench new project DIR`. A project in a folder whose name is
`pipeline`, `lesson`, `project` or `help` needs the long form.

A file of the project is used in place of the shipped one of the same path. Delete your copy to have
the shipped file again. A new version of the program never changes a project."
)]
pub struct Arguments {
    #[command(subcommand)]
    what: Option<What>,
    /// The folder of a new project, as in `lightbench new project DIR`
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Makes a project: a folder for scenes, pipelines and shaders of your own
    #[command(after_help = "\
Example:
  lightbench new project lighting-course")]
    Project {
        /// The folder to make; if it exists, it must be empty
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
    /// Makes a pipeline in the project, with a shader of its own
    #[command(after_help = "\
Example:
  lightbench new pipeline mine
  lightbench check-pipeline mine
  lightbench render cornell_box --pipeline mine --out out/mine.png

It makes scripts/pipelines/NAME.rhai and shaders/NAME/shade.wgsl in the project that the current
folder belongs to, or in that of --project. Nothing that exists is changed.")]
    Pipeline {
        /// Its name: letters, digits, `_` and `-`
        #[arg(value_name = "NAME")]
        name: String,
    },
    /// Makes a lesson in the project: text, starter, checks and solution
    #[command(after_help = "\
Examples:
  lightbench new lesson night
  lightbench new lesson 20-night

It makes lessons/NN-NAME in the project that the current folder belongs to, or in that of --project, with
the next number unless the name begins with one. The lesson has one task, and its checks run.")]
    Lesson {
        /// Its name: letters, digits, `_` and `-`
        #[arg(value_name = "NAME")]
        name: String,
    },
}

/// Makes a project, a pipeline or a lesson.
///
/// # Errors
/// A folder with something in it, a name that is taken or that can't be a file's, no project for a
/// pipeline or a lesson, or a place that can't be written.
pub fn run(
    arguments: &Arguments,
    files: impl FnOnce() -> anyhow::Result<Files>,
) -> anyhow::Result<()> {
    match (&arguments.what, &arguments.folder) {
        (Some(What::Pipeline { name }), _) => pipeline::make(name, &files()?),
        (Some(What::Lesson { name }), _) => lesson::make(name, &files()?),
        (Some(What::Project { folder }), _) | (None, Some(folder)) => project(folder),
        (None, None) => Err(Usage("name the folder of the new project".to_owned()).into()),
    }
}

fn project(folder: &Path) -> anyhow::Result<()> {
    let made = create_project(folder)?;
    say(made.display().to_string())?;
    note(format!(
        "Start with: cd \"{}\" && lightbench edit",
        folder.display()
    ));
    Ok(())
}

/// `night_vision` as people write it: `Night vision`.
fn title(name: &str) -> String {
    let words = name.replace(['_', '-'], " ");
    let mut letters = words.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters.clone()).collect()
}
