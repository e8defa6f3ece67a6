//! `lightbench hand-in`: checks, shows the points, and writes one archive.

use std::path::{Path, PathBuf};

use clap::Args;
use lightbench::assets::files::Files;
use lightbench::course::hand_in::hand_in;

use super::check::Checking;
use crate::cli::report::{note, say};

/// Arguments of `lightbench hand-in`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench hand-in                                    in a project that `lesson start` made
  lightbench hand-in 1 --work first-light --id ana.perez

The archive holds the files that the lesson asks for, answers.toml and the reports that it names. It is
written whatever the points are: whoever grades checks again.")]
pub struct Arguments {
    #[command(flatten)]
    checking: Checking,
    /// The archive to write; without it, NAME.zip in the current folder
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// As `check`, but for points that are missing; or an archive that can't be written.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    let checked = arguments.checking.run(files)?;
    let name = match &checked.outcome.student {
        Some(student) => format!("{}-{}.zip", checked.lesson.name, plain(student)),
        None => format!("{}.zip", checked.lesson.name),
    };
    let out = arguments.out.as_deref().unwrap_or(Path::new(&name));
    hand_in(&checked.lesson, &checked.work, &checked.outcome, out)?;
    note("Hand in:");
    say(out.display().to_string())
}

/// A student's name with `_` for all that a file's name had better not have.
fn plain(student: &str) -> String {
    let letter = |c: char| {
        if c.is_alphanumeric() || "-_.@".contains(c) {
            c
        } else {
            '_'
        }
    };
    let name: String = student.chars().map(letter).take(60).collect();
    name.trim_start_matches('.').to_owned()
}
