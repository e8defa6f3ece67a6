//! The process that measures: started by `lightbench compare` and not by people.

use std::io::{self, BufRead as _, Read as _, Write as _};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use anyhow::anyhow;
use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::measure::MeasureError;
use lightbench::lab::study::{Line, Process, Remark, Store, StudyError, work};

use super::now;
use crate::cli::arguments::GpuArguments;
use crate::cli::progress::stop_on_ctrl_c;
use crate::cli::report::{self, Stopped};

/// Arguments of the worker.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The folder of the study
    #[arg(long, value_name = "DIR")]
    store: PathBuf,
    /// The command of the whole study
    #[arg(long, value_name = "TEXT")]
    command_line: String,
    #[command(flatten)]
    gpu: GpuArguments,
    /// Which process of the study this is, from 0
    #[arg(value_name = "N")]
    process: u32,
}

/// How often it is told how far the work is.
const EVERY: Duration = Duration::from_millis(200);

/// Measures the points whose keys stand on the standard input.
///
/// # Errors
/// What keeps a point from being measured.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let (store, plan) = Store::existing(&arguments.store)?;
    files.grant_again(&plan.outside);
    let mut wanted = Vec::new();
    for line in io::stdin().lock().lines() {
        let line = line?;
        if line.is_empty() {
            break;
        }
        wanted.push(line);
    }
    let mut points = plan.points()?;
    points.retain(|point| wanted.contains(&point.key));
    let progress = Progress::new();
    stop_on_ctrl_c(&progress);
    stop_with_the_input(&progress);
    let output = Output::default();
    let reporter = output.follow(&progress);
    let process = Process {
        index: arguments.process,
        points,
        gpu: arguments.gpu.options(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        command_line: arguments.command_line.clone(),
        clock: now,
    };
    let known = files.clone();
    let mut tell = |remark: Remark| {
        output.write(&match remark {
            Remark::Scene(line) => {
                let place = report::known(&known, &line.place);
                Line::Note(format!("{place}: {}", line.text))
            }
            Remark::Warning(text) => Line::Warning(text),
            Remark::Done(key) => Line::Done(key),
        });
    };
    let worked = work(&files, &plan, &store, &process, &progress, &mut tell);
    drop(reporter);
    worked.map_err(|error| match error {
        StudyError::Cancelled(_) | StudyError::Measure(MeasureError::Cancelled(_)) => {
            Stopped.into()
        }
        StudyError::Problems(problems) => report::problems(&files, problems),
        StudyError::Measure(MeasureError::Script(problem)) => report::problems(&files, problem),
        other => anyhow!(other),
    })
}

/// Stops when whoever started this process is gone.
fn stop_with_the_input(progress: &Progress) {
    let progress = progress.clone();
    thread::spawn(move || {
        let mut rest = Vec::new();
        // However reading ends, nobody is there any more.
        let _ = io::stdin().read_to_end(&mut rest);
        progress.cancel();
        // A frame may take long, and nobody waits for it.
        thread::sleep(Duration::from_secs(5));
        std::process::exit(130);
    });
}

/// Lines to whoever started this process.
#[derive(Clone, Default)]
struct Output(Arc<Mutex<()>>);

impl Output {
    fn write(&self, line: &Line) {
        let _alone = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Ok(text) = serde_json::to_string(line) {
            // Where nobody reads, nobody needs to be told.
            let mut output = io::stdout().lock();
            let _ = writeln!(output, "{text}");
            let _ = output.flush();
        }
    }

    /// Tells how far the work is until the value is dropped.
    fn follow(&self, progress: &Progress) -> Reporter {
        let (output, progress) = (self.clone(), progress.clone());
        let done = Arc::new(Mutex::new(false));
        let ended = Arc::clone(&done);
        thread::spawn(move || {
            let mut last = String::new();
            while !*ended.lock().unwrap_or_else(PoisonError::into_inner) {
                let label = progress.label();
                if label != last {
                    last.clone_from(&label);
                    output.write(&Line::Progress(progress.fraction(), label));
                }
                thread::sleep(EVERY);
            }
        });
        Reporter(done)
    }
}

struct Reporter(Arc<Mutex<bool>>);

impl Drop for Reporter {
    fn drop(&mut self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = true;
    }
}
