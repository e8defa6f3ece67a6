//! The process that checks one hand-in: started by `lightbench grade` and not by people.

use std::fs;
use std::path::PathBuf;

use anyhow::Context as _;
use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::{Files, write_atomic};
use lightbench::course::confine::Confinement;
use lightbench::course::grading::{Assignment, NOT_ENFORCED};
use lightbench::lab::lesson::{CheckOptions, check};

use super::find;
use crate::cli::arguments::GpuArguments;
use crate::cli::report::say;

/// Arguments of the worker.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The lesson
    #[arg(value_name = "LESSON")]
    lesson: String,
    /// The unpacked hand-in
    #[arg(long, value_name = "DIR")]
    work: PathBuf,
    /// The folder to write into
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// More checks
    #[arg(long, value_name = "DIR")]
    hidden: Option<PathBuf>,
    /// The student, for whom numbers are drawn
    #[arg(long, value_name = "STUDENT")]
    id: Option<String>,
    /// Seconds that it may take
    #[arg(long, value_name = "SECONDS")]
    time: u64,
    /// Mebibytes of memory that it may take
    #[arg(long, value_name = "MIB")]
    memory: u64,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// The address space that is allowed for each byte of memory: drivers reserve much that they never use.
const ADDRESSES: u64 = 8;

/// Gives up what it needs not have. Call it before any thread is started, and before the project is
/// opened: nothing that a stranger wrote is read by then.
///
/// # Errors
/// Nobody who reads.
pub fn confine(arguments: &Arguments, project: Option<&PathBuf>) -> anyhow::Result<()> {
    let threads = std::thread::available_parallelism().map_or(1, |count| count.get() as u64);
    let lesson = PathBuf::from(&arguments.lesson);
    let read = [
        Some(&arguments.work),
        Some(&lesson),
        arguments.hidden.as_ref(),
        project,
    ];
    let confinement = Confinement {
        read: read.into_iter().flatten().cloned().collect(),
        write: vec![arguments.out.clone()],
        address_space: Some((arguments.memory << 20).saturating_mul(ADDRESSES)),
        processor_seconds: arguments.time.saturating_mul(threads),
        file_bytes: 256 << 20,
    };
    for line in confinement.enforce().not_enforced {
        say(format!("{NOT_ENFORCED}{line}"))?;
    }
    Ok(())
}

/// Checks the hand-in and writes the outcome.
///
/// # Errors
/// A lesson or a folder that can't be read, or no device.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    let lesson = find(files, &arguments.lesson)?;
    let pictures = arguments.out.join("pictures");
    fs::create_dir_all(&pictures).with_context(|| pictures.display().to_string())?;
    let options = CheckOptions {
        student: arguments.id.clone(),
        gpu: arguments.gpu.options(),
        pictures: Some(pictures),
        hidden: arguments.hidden.clone(),
        only: Vec::new(),
    };
    let outcome = check(&lesson, &arguments.work, &options, &Progress::new(), |_| {})?;
    let assignment = Assignment {
        work: arguments.work.clone(),
        out: arguments.out.clone(),
        id: arguments.id.clone(),
    };
    let json = outcome.to_json()?;
    Ok(write_atomic(assignment.outcome(), json.as_bytes())?)
}
