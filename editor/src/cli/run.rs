//! `lightbench run`: an experiment, a script that looks into frames.

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::experiment::{Remark, Workbench};
use lightbench::script::{Settings, run_experiment};

use super::arguments::GpuArguments;
use super::progress::stop_on_ctrl_c;
use super::project;
use super::report::{self, Stopped, Usage, note, say, warn};
use super::study::running::launcher;
use super::study::this_command;

/// Arguments of `lightbench run`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench run compare_culling
  lightbench run follow_a_pixel --set scene=cornell_box --set x=120 --set y=200
  lightbench run my_experiment.rhai
  lightbench copy scripts/experiments/compare_culling.rhai    to begin one of your own

An experiment draws frames, looks into them and prints what it found. It writes pictures below the
project's folder out/ alone. `lightbench docs experiments` has every function. The exit status is 1
if an assertion does not hold.")]
pub struct Arguments {
    /// The experiment: the name of a file in scripts/experiments, or the path of a .rhai file
    #[arg(value_name = "EXPERIMENT")]
    experiment: String,
    /// A value for a parameter of the experiment, as in `--set lights=256`; may be given again
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Runs the command.
///
/// # Errors
/// What is wrong in the experiment or went wrong in it, or Ctrl-C.
pub fn run(arguments: &Arguments, mut files: Files, limits: Option<&Path>) -> anyhow::Result<()> {
    let mut settings = Settings::new();
    for text in &arguments.set {
        let set = settings.set_from_text(text);
        set.map_err(|mistake| Usage(format!("--set {text}: {mistake}")))?;
    }
    let path = project::script(&mut files, &arguments.experiment)?;
    let progress = Progress::new();
    stop_on_ctrl_c(&progress);
    let known = files.clone();
    let workbench =
        Workbench::new(
            &files,
            arguments.gpu.options(),
            &progress,
            move |remark| match remark {
                Remark::Scene(line) => {
                    let place = report::known(&known, &line.place);
                    note(format!("{place}: {}", line.text));
                }
                Remark::Warning(warning) => warn(warning),
            },
        );
    let unsaid = Arc::new(Mutex::new(None));
    let (first_unsaid, stop) = (Arc::clone(&unsaid), progress.clone());
    let print = move |line: lightbench::script::LogLine| {
        if let Err(error) = say(line.text) {
            // Nobody reads on, so nothing more is drawn.
            let mut first = first_unsaid.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert(error);
            stop.cancel();
        }
    };
    let launch = launcher(&files, &arguments.gpu, limits, &this_command())?;
    let laboratory = Box::new(workbench.with_studies(launch));
    let result = run_experiment(&files, &path, &settings, laboratory, print, &progress);
    if let Some(error) = unsaid.lock().unwrap_or_else(PoisonError::into_inner).take() {
        return Err(error);
    }
    if progress.is_cancelled() {
        return Err(Stopped.into());
    }
    result.map_err(|problems| report::problems(&files, problems))
}
