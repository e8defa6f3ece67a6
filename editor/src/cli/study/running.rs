//! Measuring what a study still lacks, in processes of this same program.

use std::env;
use std::ffi::OsString;
use std::io::IsTerminal as _;

use anyhow::{Context as _, anyhow};
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::study::{
    Launch, Plan, Planned, ProcessError, Store, Study, Told, in_words, join, run_processes, stale,
};

use crate::cli::arguments::GpuArguments;
use crate::cli::progress::{Bar, stop_on_ctrl_c};
use crate::cli::report::{Said, Stopped, note, warn};

/// Where and how it is measured.
pub struct Run<'a> {
    /// The files of the project.
    pub files: &'a Files,
    /// The adapter.
    pub gpu: &'a GpuArguments,
    /// The command that stands in the report.
    pub command_line: &'a str,
}

/// What is there afterwards, and whether it was stopped before all was measured.
pub struct Ran {
    /// The study.
    pub study: Study,
    /// Whether somebody pressed Ctrl-C.
    pub stopped: bool,
}

impl Run<'_> {
    /// Measures the points that the store lacks and joins all that is there.
    ///
    /// # Errors
    /// A process that failed, or parts that can't be joined.
    pub fn measure(&self, store: &Store, plan: &Plan, points: &[Planned]) -> anyhow::Result<Ran> {
        self.drop_stale(store, plan, points)?;
        let known = points
            .iter()
            .map(|point| (0..plan.processes).filter(|p| store.has(point, *p)).count())
            .sum::<usize>();
        let all = points.len() * plan.processes as usize;
        if known == all {
            note("everything is measured already; the report is written again");
        } else if known > 0 {
            note(format!(
                "going on: {known} of {all} measurements are there already"
            ));
        }
        let progress = Progress::new();
        stop_on_ctrl_c(&progress);
        let bar = Bar::follow(&progress);
        let terminal = std::io::stderr().is_terminal();
        let mut tell = |told| match told {
            Told::Done {
                process,
                key,
                seconds_left,
            } if !terminal => note(format!(
                "process {} of {}: {key}; {} left",
                process + 1,
                plan.processes,
                in_words(seconds_left)
            )),
            Told::Done { .. } => {}
            Told::Warning(text) => warn(text),
            Told::Note(text) => note(text),
        };
        let launch = self.launch(store)?;
        let ran = run_processes(&launch, store, plan, points, &progress, &mut tell);
        drop(bar);
        let stopped = match ran {
            Ok(()) => false,
            Err(ProcessError::Cancelled(_)) => true,
            Err(ProcessError::Failed(text)) => {
                // It says `error:` itself.
                note(text);
                return Err(Said.into());
            }
            Err(other) => return Err(anyhow!(other)),
        };
        let study = join(store, plan, points)?;
        if stopped && study.points.is_empty() {
            note("nothing is complete yet; the same command goes on");
            return Err(Stopped.into());
        }
        if stopped {
            note("stopped; the report holds what is measured, and the same command goes on");
        }
        Ok(Ran { study, stopped })
    }

    /// Removes what was measured with files that have changed since.
    fn drop_stale(&self, store: &Store, plan: &Plan, points: &[Planned]) -> anyhow::Result<()> {
        let mut told: Vec<String> = Vec::new();
        for point in points {
            for process in 0..plan.processes {
                let Some(part) = store.read(point, process)? else {
                    continue;
                };
                let changed = stale(&part, self.files);
                if changed.is_empty() {
                    continue;
                }
                store.remove(point, process)?;
                for path in changed {
                    if !told.contains(&path) {
                        note(format!(
                            "{path} has changed: what was measured with it is measured again"
                        ));
                        told.push(path);
                    }
                }
            }
        }
        Ok(())
    }

    fn launch(&self, store: &Store) -> anyhow::Result<Launch> {
        let program = env::current_exe().context("can't find this program's own file")?;
        let mut arguments: Vec<OsString> = Vec::new();
        if let Some(project) = self.files.project() {
            arguments.extend(["--project".into(), project.into()]);
        }
        if let Some(limits) = limits_file() {
            arguments.extend(["--limits".into(), limits]);
        }
        arguments.extend([
            "study-worker".into(),
            "--store".into(),
            store.folder().into(),
        ]);
        arguments.extend(["--command-line".into(), self.command_line.into()]);
        arguments.extend(self.gpu.again());
        Ok(Launch { program, arguments })
    }
}

/// What `--limits` of this process names: its workers are held to the same.
fn limits_file() -> Option<OsString> {
    let mut arguments = env::args_os();
    while let Some(argument) = arguments.next() {
        if argument == "--limits" {
            return arguments.next();
        }
        let file = argument
            .to_str()
            .and_then(|text| text.strip_prefix("--limits="));
        if let Some(file) = file {
            return Some(file.into());
        }
    }
    None
}
