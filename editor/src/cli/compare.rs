//! `lightbench compare`: pipelines measured on scenes, at one point or many.

use std::path::{Path, PathBuf};

use clap::Args;
use lightbench::assets::files::Files;
use lightbench::lab::report::read_json;
use lightbench::lab::study::{Planned, Shard, Store};

use super::project;
use super::report::{Said, Stopped, Usage, note};
use super::study::plan::PlanArguments;
use super::study::running::{Ran, Run};
use super::study::{against, outcome, this_command};

/// Arguments of `lightbench compare`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench compare --out report                      all pipelines, the atrium with 4 to 256 lights
  lightbench compare many_lights --pipelines forward_single_pass,deferred_shading \\
      --set lights=256 --size 1280x720 --frames 20 --out report
  lightbench compare atrium --sweep lights=16,64,256 --sweep size=320x180,640x360 --out report
  lightbench compare atrium --pipelines tiled_deferred --sweep tile_size=8,16,32 --out report
  lightbench compare atrium --start 0 --step 0.5 --frames 20 --seconds 60 --out fly-through
  lightbench compare --out shares/3 --shard 3/16       a sixteenth of the points, then `merge`

The report is one HTML file that needs nothing else, with the same numbers as JSON and CSV, tables and
charts, and the pictures beside it. Each process opens the device anew and measures all points; each
result is written when it is there. Stopped with Ctrl-C or killed, the same command goes on.")]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArguments,
    /// The folder for the report; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replace another study in that folder
    #[arg(long)]
    restart: bool,
    /// Measure one share of the points alone, as for one of several machines
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Let each pipeline run with the fastest of the values that its file declares as tunable, found
    /// first at each point; the report says which
    #[arg(long)]
    tune: bool,
    /// The report.json of an earlier run: says what became faster, slower or different. The exit status
    /// is 1 where something is slower, or has another picture or other counts
    #[arg(long, value_name = "OLD.json")]
    against: Option<PathBuf>,
}

/// Runs the command.
///
/// # Errors
/// Anything that keeps the report from being made.
pub fn run(arguments: &Arguments, mut files: Files, limits: Option<&Path>) -> anyhow::Result<()> {
    project::writable(&arguments.out.join("report.html"))?;
    if let Some(old) = &arguments.against {
        // Read before anything is measured.
        read_json(old)?;
        let folder = old.parent().and_then(|folder| folder.canonicalize().ok());
        if folder.is_some() && folder == arguments.out.canonicalize().ok() {
            return Err(Usage(format!(
                "--against {} would be replaced by the new report; give another folder with --out",
                old.display()
            ))
            .into());
        }
    }
    let mut plan = arguments.plan.plan(&mut files)?;
    let command_line = this_command();
    let run = Run {
        files: &files,
        gpu: &arguments.plan.gpu,
        limits,
        command_line: &command_line,
    };
    let points = share(plan.points()?, arguments.shard);
    if arguments.tune {
        run.tune(&mut plan, &points, &arguments.out.join("tuning"))?;
    }
    let version = env!("CARGO_PKG_VERSION");
    let store = Store::open(&arguments.out, &plan, version, arguments.restart)?;
    if points.is_empty() {
        note("this share has no point; there are more shares than points");
        return Ok(());
    }
    let Ran { mut study, stopped } = run.measure(&store, &plan, &points)?;
    outcome::write(&mut study, &arguments.out)?;
    if stopped {
        return Err(Stopped.into());
    }
    let Some(old) = &arguments.against else {
        return Ok(());
    };
    if against::compare(&study, &arguments.out, old)? {
        return Err(Said.into());
    }
    Ok(())
}

fn share(all: Vec<Planned>, shard: Option<Shard>) -> Vec<Planned> {
    let Some(shard) = shard else { return all };
    let keys: Vec<&str> = all.iter().map(|point| point.key.as_str()).collect();
    let mine: Vec<String> = shard.of(&keys).into_iter().map(str::to_owned).collect();
    let mut points = all;
    points.retain(|point| mine.contains(&point.key));
    points
}
