//! `lightbench merge`: the shares of several machines as one study.

use std::path::PathBuf;

use clap::Args;
use lightbench::lab::study::{Store, join};

use super::outcome;
use crate::cli::project;
use crate::cli::report::{Usage, note};

/// Arguments of `lightbench merge`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench compare --out shares/1 --shard 1/2        on one machine
  lightbench compare --out shares/2 --shard 2/2        on another
  lightbench merge shares/1 shares/2 --out report

A share is whole points: all pipelines of a point are measured on one machine, and no ratio is formed
across machines. Points that no share has are named; measure them and merge again.")]
pub struct Arguments {
    /// The folders of the shares
    #[arg(value_name = "DIR", required = true)]
    shares: Vec<PathBuf>,
    /// The folder for the report; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// Folders without a study, or with different ones, and points that two machines have measured.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    project::writable(&arguments.out.join("report.html"))?;
    let mut stores = Vec::new();
    for share in &arguments.shares {
        stores.push(Store::existing(share)?);
    }
    let Some((first, plan)) = stores.first() else {
        return Err(Usage("name the folders of the shares".to_owned()).into());
    };
    if let Some((other, _)) = stores.iter().find(|(_, other)| other != plan) {
        return Err(Usage(format!(
            "{} and {} hold different studies; only shares of one study can be merged",
            first.folder().display(),
            other.folder().display()
        ))
        .into());
    }
    let points = plan.points()?;
    let version = env!("CARGO_PKG_VERSION");
    let merged = Store::open(&arguments.out, plan, version, false)?;
    for point in &points {
        // The share that has most of a point gives all of it: processes of different machines are
        // never put together.
        let has = |store: &Store| (0..plan.processes).filter(|p| store.has(point, *p)).count();
        let most = stores
            .iter()
            .map(|(store, _)| store)
            .rev()
            .max_by_key(|store| has(store));
        let Some(most) = most.filter(|store| has(store) > has(&merged)) else {
            continue;
        };
        for process in 0..plan.processes {
            merged.remove(point, process)?;
            if most.has(point, process) {
                merged.take(most, point, process)?;
            }
        }
    }
    let mut study = join(&merged, plan, &points)?;
    if !study.missing.is_empty() {
        note(format!(
            "{} of {} points are not complete: {}",
            study.missing.len(),
            points.len(),
            study.missing.join("; ")
        ));
    }
    outcome::write(&mut study, &arguments.out)
}
