//! Measuring what a study still lacks, in processes of this same program.

use std::env;
use std::ffi::OsString;
use std::io::IsTerminal as _;
use std::path::Path;

use anyhow::{Context as _, anyhow};
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::study::tuning::{choose, tuning_plan};
use lightbench::lab::study::{
    Launch, Plan, Planned, ProcessError, Store, Study, Told, drop_stale, in_words, join,
    run_processes,
};
use lightbench::script::{Settings, load_pipeline};

use crate::cli::arguments::GpuArguments;
use crate::cli::progress::{Bar, stop_on_ctrl_c};
use crate::cli::report::{self, Said, Stopped, note, warn};

/// Where and how it is measured.
pub struct Run<'a> {
    /// The files of the project.
    pub files: &'a Files,
    /// The adapter.
    pub gpu: &'a GpuArguments,
    /// The file of `--limits`, by which the processes are bound too.
    pub limits: Option<&'a Path>,
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
        for path in drop_stale(store, plan, points, self.files)? {
            note(format!(
                "{path} has changed: what was measured with it is measured again"
            ));
        }
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
        let launch =
            launcher(self.files, self.gpu, self.limits, self.command_line)?(store.folder());
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
}

impl Run<'_> {
    /// Finds the fastest values of each pipeline at each point, and puts them into the plan.
    ///
    /// # Errors
    /// As [`Run::measure`]; also where it was stopped.
    pub fn tune(&self, plan: &mut Plan, points: &[Planned], folder: &Path) -> anyhow::Result<()> {
        let mut descriptions = Vec::new();
        for choice in &plan.pipelines {
            let mut settings = Settings::new();
            for setting in &choice.settings {
                settings.set(setting.name.as_str(), setting.value.as_str());
            }
            let desc = load_pipeline(self.files, &choice.path, &settings);
            descriptions.push(desc.map_err(|problems| report::problems(self.files, problems))?);
        }
        let tuning = tuning_plan(plan, &descriptions);
        let store = Store::open(folder, &tuning, env!("CARGO_PKG_VERSION"), false)
            .or_else(|_| Store::open(folder, &tuning, env!("CARGO_PKG_VERSION"), true))?;
        note(format!(
            "tuning: {} variants of {} pipelines",
            tuning.pipelines.len(),
            plan.pipelines.len()
        ));
        let Ran { study, stopped } = self.measure(&store, &tuning, points)?;
        if stopped {
            return Err(Stopped.into());
        }
        choose(plan, &study);
        Ok(())
    }
}

/// How a process is started that measures into a folder.
///
/// # Errors
/// Where the system does not tell this program's own file.
pub fn launcher(
    files: &Files,
    gpu: &GpuArguments,
    limits: Option<&Path>,
    command_line: &str,
) -> anyhow::Result<impl Fn(&Path) -> Launch + Send + 'static> {
    let program = env::current_exe().context("can't find this program's own file")?;
    let mut before: Vec<OsString> = Vec::new();
    if let Some(project) = files.project() {
        before.extend(["--project".into(), project.into()]);
    }
    if let Some(limits) = limits {
        before.extend(["--limits".into(), limits.into()]);
    }
    before.push("study-worker".into());
    before.extend(["--command-line".into(), command_line.into()]);
    before.extend(gpu.again());
    Ok(move |folder: &Path| {
        let mut arguments = before.clone();
        arguments.extend(["--store".into(), folder.into()]);
        Launch {
            program: program.clone(),
            arguments,
        }
    })
}
