//! The command line: one module a command, over the same calls as the editor.

mod arguments;
mod bench;
mod bench_frame;
mod bench_pipelines;
mod check_pipeline;
mod compare;
mod copy;
mod diff;
mod docs;
mod doctor;
mod edit;
mod export;
mod faults;
mod inspect;
mod lesson;
mod list;
mod load;
mod new;
mod progress;
mod project;
mod render;
mod report;
mod run;
mod save;
mod settings;
mod study;
mod trace;

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context as _;
use clap::{Parser, Subcommand};
use lightbench::script::GivenLimits;

/// A workbench for real-time lighting pipelines.
///
/// Describe a scene in a script, draw it with one pipeline or another, and see what each costs and
/// where their pictures differ.
#[derive(Debug, Parser)]
#[command(
    name = "lightbench",
    version,
    max_term_width = 100,
    propagate_version = true,
    arg_required_else_help = true,
    after_help = "\
Start with:
  lightbench edit                                       look round the default scene
  lightbench render atrium --out atrium.png             one picture, without a window
  lightbench compare atrium --out report                which pipeline is faster, and by how much
  lightbench new project my-project                     a place for scenes and shaders of your own
  lightbench new pipeline mine                          in it: a pipeline of your own, to change

`lightbench help COMMAND` explains a command, with examples.
The exit status is 0 if all went well, 1 if not, 2 if the command was mistyped."
)]
struct Arguments {
    /// The project's folder; without it, the project that the current folder belongs to
    #[arg(long, value_name = "DIR", global = true)]
    project: Option<PathBuf>,
    /// A TOML file whose table `limits` bounds what scripts may use, over the project's own
    #[arg(long, value_name = "FILE", global = true)]
    limits: Option<PathBuf>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Opens the editor
    Edit(edit::Arguments),
    /// Writes one picture of a scene, as PNG or EXR
    Render(render::Arguments),
    /// Traces rays through a scene, for a picture to compare those of pipelines with
    Trace(trace::Arguments),
    /// Shows what the targets of a frame hold after each pass
    Inspect(inspect::Arguments),
    /// Runs an experiment: a script that draws frames, looks into them and says what it found
    Run(run::Arguments),
    /// Measures pipelines on scenes and writes a report
    Compare(compare::Arguments),
    /// Makes one report of the shares that several machines measured
    Merge(study::merge::Arguments),
    /// Packs a report with everything that it was made from
    Bundle(study::bundle::BundleArguments),
    /// Measures a bundle again and says what is equal and what differs
    Reproduce(study::bundle::ReproduceArguments),
    /// Measures for `compare`, which starts it
    #[command(hide = true)]
    StudyWorker(study::worker::Arguments),
    /// Lists lessons, begins one, or packs one for students
    Lesson(lesson::Arguments),
    /// Checks what a student made of a lesson, and says what is right and what is not
    Check(lesson::check::Arguments),
    /// Checks a lesson's work, shows the points, and writes one archive to hand in
    HandIn(lesson::hand_in::Arguments),
    /// Grades a folder of hand-ins, and makes tables and pages of it
    Grade(lesson::grade::Arguments),
    /// Checks a hand-in for `grade`, which starts it
    #[command(hide = true)]
    GradeWorker(lesson::worker::Arguments),
    /// Says how far apart two pictures are
    Diff(diff::Arguments),
    /// Writes a scene to a file that holds its entities instead of a script
    Save(save::Arguments),
    /// Writes a scene for another renderer, Mitsuba 3
    Export(export::Arguments),
    /// Lists pipelines, scenes, adapters or files
    List(list::Arguments),
    /// Makes a project for scenes, pipelines and shaders of your own, or a pipeline in one
    New(new::Arguments),
    /// Copies a shipped file into the project, so that it can be edited
    Copy(copy::Arguments),
    /// Checks a pipeline and prints every mistake in it
    CheckPipeline(check_pipeline::Arguments),
    /// Prints the reference of scene scripts, pipeline files, the shader library or experiments
    Docs(docs::Arguments),
    /// Says what is here, what is missing, and how to mend it
    Doctor,
    /// Measures the program itself
    Bench(bench::Arguments),
}

/// Runs the program with the arguments of the process. Call it before any thread is started.
pub fn main() -> ExitCode {
    hush_device_selection();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version come here too. A reader that went away needs neither.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    faults::start_log();
    faults::catch(|| report::finish(run(arguments)))
}

/// Mesa's layer that chooses a Vulkan device asks Wayland for the desktop's. Where there is no
/// Wayland session, that ends in a line "error: XDG_RUNTIME_DIR is invalid" for every command, so
/// the layer is turned off there, as its manifest offers.
fn hush_device_selection() {
    if cfg!(target_os = "linux") && std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: nothing else reads or writes the environment yet: `main` has started no thread.
        #[allow(unsafe_code)]
        unsafe {
            std::env::set_var("NODEVICE_SELECT", "1");
        }
    }
}

fn run(arguments: Arguments) -> anyhow::Result<()> {
    if let Command::GradeWorker(worker) = &arguments.command {
        lesson::worker::confine(worker, arguments.project.as_ref())?;
    }
    if let Some(path) = &arguments.limits {
        let text = std::fs::read_to_string(path)
            .with_context(|| format!("--limits {} can't be read", path.display()))?;
        let given = GivenLimits::read(&path.display().to_string(), &text)
            .map_err(|problem| anyhow::anyhow!("{problem}"))?;
        given.impose();
    }
    let project = arguments.project.as_deref();
    let files = || project::open(project);
    let limits = arguments.limits.as_deref();
    match arguments.command {
        Command::Edit(arguments) => edit::run(&arguments, files()?, limits),
        Command::Render(arguments) => render::run(&arguments, files()?),
        Command::Trace(arguments) => trace::run(&arguments, files()?),
        Command::Inspect(arguments) => inspect::run(&arguments, files()?),
        Command::Run(arguments) => run::run(&arguments, files()?, limits),
        Command::Compare(arguments) => compare::run(&arguments, files()?, limits),
        Command::Merge(arguments) => study::merge::run(&arguments),
        Command::Bundle(arguments) => study::bundle::bundle(&arguments, files()?),
        Command::Reproduce(arguments) => study::bundle::reproduce(&arguments, limits),
        Command::StudyWorker(arguments) => study::worker::run(&arguments, files()?),
        Command::Lesson(arguments) => lesson::run(&arguments, &files()?),
        Command::Check(arguments) => lesson::check::run(&arguments, &files()?),
        Command::HandIn(arguments) => lesson::hand_in::run(&arguments, &files()?),
        Command::Grade(arguments) => lesson::grade::run(&arguments, &files()?, limits),
        Command::GradeWorker(arguments) => lesson::worker::run(&arguments, &files()?),
        Command::Diff(arguments) => diff::run(&arguments),
        Command::Save(arguments) => save::run(&arguments, files()?),
        Command::Export(arguments) => export::run(&arguments, files()?),
        Command::List(arguments) => list::run(&arguments, &files()?),
        Command::New(arguments) => new::run(&arguments, files),
        Command::Copy(arguments) => copy::run(&arguments, &files()?),
        Command::CheckPipeline(arguments) => check_pipeline::run(&arguments, files()?),
        Command::Docs(arguments) => docs::run(&arguments, &files()?),
        Command::Doctor => doctor::run(&files()?),
        Command::Bench(arguments) => bench::run(&arguments, files),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_arguments_are_sound() {
        Arguments::command().debug_assert();
    }
}
