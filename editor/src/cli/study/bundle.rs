//! `lightbench bundle` and `lightbench reproduce`: a study for others, and the same study again.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Args;
use lightbench::assets::files::Files;
use lightbench::lab::report::read_json;
use lightbench::lab::study::bundle::{pack, unpack};
use lightbench::lab::study::history::{Change, PictureChange, Reported, TimeChange, changes};
use lightbench::lab::study::{Plan, Store};

use super::running::{Ran, Run};
use super::{against, outcome, this_command};
use crate::cli::arguments::GpuArguments;
use crate::cli::project;
use crate::cli::report::{Said, Stopped, Usage, say};

/// Arguments of `lightbench bundle`.
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  lightbench bundle report --out lights.tar.gz

The bundle holds the plan of the study, the report, and every script, shader, model and picture that
was read, as it was measured. `lightbench reproduce` measures it again on any machine.")]
pub struct BundleArguments {
    /// The folder of the report
    #[arg(value_name = "DIR")]
    report: PathBuf,
    /// The bundle to write; it ends in .tar.gz
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// Packs a report.
///
/// # Errors
/// No report there, inputs that have changed, or a disk that can't be written.
pub fn bundle(arguments: &BundleArguments, mut files: Files) -> anyhow::Result<()> {
    if !arguments.out.display().to_string().ends_with(".tar.gz") {
        return Err(Usage(format!(
            "--out {}: name a file that ends in .tar.gz",
            arguments.out.display()
        ))
        .into());
    }
    project::writable(&arguments.out)?;
    let study = read_json(&arguments.report.join("report.json"))?;
    files.grant_again(&study.plan.outside);
    pack(&study, &arguments.report, &files, &arguments.out)?;
    say(arguments.out.display().to_string())
}

/// Arguments of `lightbench reproduce`.
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  lightbench reproduce lights.tar.gz --out again

Measures the study of a bundle with the inputs that it holds, and says of each picture whether it is
equal, within its bound or different, and of each count and time what changed. Times are compared on
the same machine and driver alone. The exit status is 1 where a picture or a count differs.")]
pub struct ReproduceArguments {
    /// The bundle
    #[arg(value_name = "FILE")]
    bundle: PathBuf,
    /// The folder for the new report and what the bundle holds; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Measures a bundle again.
///
/// # Errors
/// A bundle that is none, or anything that keeps it from being measured.
pub fn reproduce(arguments: &ReproduceArguments, limits: Option<&Path>) -> anyhow::Result<()> {
    project::writable(&arguments.out.join("report.html"))?;
    let out = std::path::absolute(&arguments.out)
        .with_context(|| format!("--out {}", arguments.out.display()))?;
    let unpacked = unpack(&arguments.bundle, &out.join("bundle"))?;
    let mut files = Files::with_project(&unpacked.project)?;
    let plan: Plan = unpacked.plan;
    files.grant_again(&plan.outside);
    let points = plan.points()?;
    let store = Store::open(&out, &plan, env!("CARGO_PKG_VERSION"), false)?;
    let command_line = this_command();
    let run = Run {
        files: &files,
        gpu: &arguments.gpu,
        limits,
        command_line: &command_line,
    };
    let Ran { mut study, stopped } = run.measure(&store, &plan, &points)?;
    outcome::write(&mut study, &out)?;
    if stopped {
        return Err(Stopped.into());
    }
    let old = unpacked.report.join("report.json");
    let before = read_json(&old)?;
    let found = changes(
        Reported {
            study: &study,
            folder: &out,
        },
        Reported {
            study: &before,
            folder: old.parent().unwrap_or(Path::new(".")),
        },
    )?;
    against::print(&found)?;
    let count = |is: fn(&Change) -> bool| found.changes.iter().filter(|change| is(change)).count();
    say(format!(
        "Pictures: {} equal, {} within the bound, {} different. Counts: {} equal, {} different. \
         Times: {} the same within 5 %, {} changed, {} not decided or not comparable.",
        count(|c| c.picture == PictureChange::Equal),
        count(|c| matches!(c.picture, PictureChange::WithinBound(..))),
        count(|c| matches!(
            c.picture,
            PictureChange::Differs(..) | PictureChange::OtherSize
        )),
        count(|c| c.counts.is_empty()),
        count(|c| !c.counts.is_empty()),
        count(|c| matches!(c.time, TimeChange::Same(..))),
        count(|c| matches!(c.time, TimeChange::Faster(..) | TimeChange::Slower(..))),
        count(|c| matches!(
            c.time,
            TimeChange::Undecided(..) | TimeChange::TooFew | TimeChange::OtherMachine
        )),
    ))?;
    let differs = found.changes.iter().any(|change| {
        matches!(
            change.picture,
            PictureChange::Differs(..) | PictureChange::OtherSize
        ) || !change.counts.is_empty()
    });
    if differs { Err(Said.into()) } else { Ok(()) }
}
