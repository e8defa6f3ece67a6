//! `lightbench list`: what there is.

use clap::{Args, ValueEnum};
use lightbench::assets::files::{Files, Origin};
use lightbench::render::gpu::adapters;
use lightbench::script::{list_pipelines, list_scenes};

use super::report::{self, say, warn};
use super::{doctor, project};

/// What to list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Lighting pipelines, for --pipeline
    Pipelines,
    /// Scenes
    Scenes,
    /// Graphics adapters, for --adapter
    Adapters,
    /// Every shipped script and shader, and those of the project, for `lightbench copy`
    Files,
}

/// Arguments of `lightbench list`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench list pipelines
  lightbench list adapters

Each line has the name that other commands take, where the file comes from (the project or the
program, \"shipped\"), and a title.")]
pub struct Arguments {
    /// What to list
    #[arg(value_name = "WHAT")]
    kind: Kind,
}

/// Runs the command.
///
/// # Errors
/// A folder that can't be read, or no adapter.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    match arguments.kind {
        Kind::Pipelines => {
            let entries = list_pipelines(files)?.into_iter();
            scripts(
                files,
                entries
                    .map(|e| (e.name, e.title, e.origin, e.problem))
                    .collect(),
            )
        }
        Kind::Scenes => {
            let entries = list_scenes(files)?.into_iter();
            scripts(
                files,
                entries.map(|e| (e.name, e.title, e.origin, None)).collect(),
            )
        }
        Kind::Adapters => list_adapters(),
        Kind::Files => list_files(files),
    }
}

type Script = (String, String, Origin, Option<lightbench::render::Problem>);

fn scripts(files: &Files, entries: Vec<Script>) -> anyhow::Result<()> {
    let rows = entries.iter().map(|(name, title, origin, _)| {
        [name.clone(), project::origin(files, origin), title.clone()]
    });
    table(&rows.collect::<Vec<_>>())?;
    for (.., problem) in entries {
        if let Some(problem) = problem {
            warn(report::problem(files, problem).to_string());
        }
    }
    Ok(())
}

fn list_adapters() -> anyhow::Result<()> {
    let adapters = adapters();
    if adapters.is_empty() {
        return Err(doctor::no_driver());
    }
    let rows: Vec<_> = adapters
        .iter()
        .enumerate()
        .map(|(number, adapter)| {
            [
                number.to_string(),
                adapter.name.clone(),
                format!("{}, {}", adapter.kind, adapter.backend),
                format!("{} {}", adapter.driver, adapter.driver_info)
                    .trim()
                    .to_owned(),
            ]
        })
        .collect();
    table(&rows)
}

fn list_files(files: &Files) -> anyhow::Result<()> {
    let mut rows = Vec::new();
    for folder in ["lessons", "scripts", "shaders"] {
        for file in files.list(folder, "")? {
            rows.push([file.path, project::origin(files, &file.origin)]);
        }
    }
    table(&rows)
}

/// Prints rows with their columns under each other.
fn table<const COLUMNS: usize>(rows: &[[String; COLUMNS]]) -> anyhow::Result<()> {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: Vec<usize> = (0..COLUMNS)
        .map(|column| width(column).unwrap_or(0))
        .collect();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            line.push_str(&format!("{cell:<width$}  "));
        }
        say(line.trim_end())?;
    }
    Ok(())
}
