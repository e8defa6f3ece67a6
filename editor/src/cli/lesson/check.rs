//! `lightbench check`: what a student handed in, judged by the checks of a lesson.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::Args;
use lightbench::assets::Progress;
use lightbench::assets::files::{Files, write_atomic};
use lightbench::lab::experiment::Remark;
use lightbench::lab::lesson::{
    self, CheckError, CheckEvent, CheckOptions, LESSON_PAGE, Lesson, Outcome, check, lesson_of,
};

use super::printed::Printed;
use super::{Language, find};
use crate::cli::arguments::GpuArguments;
use crate::cli::progress::stop_on_ctrl_c;
use crate::cli::report::{Said, Stopped, Usage, note, say, warn};

/// Arguments of `lightbench check`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench check                                      in a project that `lesson start` made
  lightbench check 1 --work first-light --task lambert
  lightbench check lessons/01-first-light --work first-light --id ana.perez --json result.json

The files that the lesson names are taken from the work, everything else from the lesson. Where a
picture differs, what was expected, what was drawn and the difference are written into a folder.
The exit status is 0 if all points were given, 1 if not.")]
pub struct Arguments {
    #[command(flatten)]
    checking: Checking,
    /// A task or question to check alone; may be given again
    #[arg(long, value_name = "TASK")]
    task: Vec<String>,
    /// A file to write the outcome to, as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// A folder with more checks, which students do not have
    #[arg(long, value_name = "DIR")]
    hidden: Option<PathBuf>,
}

/// What `check` and `hand-in` are told of a work.
#[derive(Args, Debug)]
pub struct Checking {
    /// The lesson: its number, its name, or its folder; without it, that of the project
    #[arg(value_name = "LESSON")]
    lesson: Option<String>,
    /// The folder that was handed in; without it, the project
    #[arg(long, value_name = "DIR")]
    work: Option<PathBuf>,
    /// The student, for whom numbers are drawn; without it, that of the project
    #[arg(long, value_name = "STUDENT")]
    id: Option<String>,
    /// The language of the messages
    #[arg(long, value_enum, default_value_t)]
    language: Language,
    /// The folder for pictures of what differs; without it, out/check of the work
    #[arg(long, value_name = "DIR")]
    pictures: Option<PathBuf>,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// A work that was checked.
pub struct Checked {
    /// Of which lesson.
    pub lesson: Lesson,
    /// The folder.
    pub work: PathBuf,
    /// What was found.
    pub outcome: Outcome,
}

/// Runs the command.
///
/// # Errors
/// A lesson or a folder that can't be read, no device, or points that are missing.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    let Arguments { checking, .. } = arguments;
    let checked = checking.run_with(files, &arguments.task, arguments.hidden.as_deref())?;
    let outcome = checked.outcome;
    if let Some(path) = &arguments.json {
        let json = outcome.to_json()?;
        write_atomic(path, json.as_bytes())
            .with_context(|| format!("--json {}", path.display()))?;
    }
    match outcome.points == outcome.of {
        true => Ok(()),
        false => Err(Said.into()),
    }
}

impl Checking {
    /// Checks a whole work and prints what was found.
    ///
    /// # Errors
    /// A lesson or a folder that can't be read, or no device.
    pub fn run(&self, files: &Files) -> anyhow::Result<Checked> {
        self.run_with(files, &[], None)
    }

    fn run_with(
        &self,
        files: &Files,
        only: &[String],
        hidden: Option<&Path>,
    ) -> anyhow::Result<Checked> {
        let Some(work) = self.work.as_deref().or(files.project()) else {
            let usage = "name the folder that was handed in, as in `--work DIR`";
            return Err(Usage(usage.to_owned()).into());
        };
        let begun = lesson_of(work);
        let asked = self.lesson.clone();
        let Some(asked) = asked.or_else(|| begun.as_ref().map(|begun| begun.asked().to_owned()))
        else {
            let usage = format!(
                "name the lesson: {} does not say which one it is for",
                work.display()
            );
            return Err(Usage(usage).into());
        };
        let lesson = find(files, &asked)?;
        let pictures = self
            .pictures
            .clone()
            .unwrap_or_else(|| work.join("out/check"));
        let options = CheckOptions {
            student: self.id.clone().or_else(|| begun.and_then(|begun| begun.id)),
            gpu: self.gpu.options(),
            pictures: Some(pictures.clone()),
            hidden: hidden.map(Path::to_owned),
            only: only.to_vec(),
        };
        forget_pictures(&pictures)?;
        let progress = Progress::new();
        stop_on_ctrl_c(&progress);
        let language = self.language.into();
        let tell = move |event| tell(event, language);
        let outcome =
            check(&lesson, work, &options, &progress, tell).map_err(|error| match error {
                CheckError::Stopped => Stopped.into(),
                CheckError::NoTask(_) => anyhow::Error::from(Usage(error.to_string())),
                CheckError::Checks(problems) => problems.into(),
                other => other.into(),
            })?;
        let printed = Printed {
            outcome: &outcome,
            lesson: &lesson,
            language,
            pictures: &pictures,
            page: Some(work.join(LESSON_PAGE)).filter(|page| page.is_file()),
        };
        say(printed.to_string().trim_end())?;
        Ok(Checked {
            work: work.to_owned(),
            lesson,
            outcome,
        })
    }
}

/// Takes away the pictures of an earlier check, which would look like those of this one.
fn forget_pictures(folder: &Path) -> anyhow::Result<()> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(());
    };
    for entry in entries {
        let path = entry?.path();
        let name = path
            .file_name()
            .and_then(|name| name.to_str())
            .unwrap_or_default();
        let ours = ["-expected.png", "-yours.png", "-difference.png"];
        if ours.iter().any(|ending| name.ends_with(ending))
            && let Err(error) = std::fs::remove_file(&path)
        {
            bail!("{}: {error}", path.display());
        }
    }
    Ok(())
}

fn tell(event: CheckEvent, language: lesson::Language) {
    match event {
        CheckEvent::Begins { title, done, of } => note(format!(
            "[{}/{of}] {}",
            done + 1,
            title.in_language(language)
        )),
        CheckEvent::Printed(line) => note(format!("{}: {}", line.place, line.text)),
        CheckEvent::Remark(Remark::Scene(line)) => note(format!("{}: {}", line.place, line.text)),
        CheckEvent::Remark(Remark::Warning(warning)) => warn(warning),
    }
}
