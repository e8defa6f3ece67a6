//! A check of a lesson: `lightbench check` in a process of its own, so that a shader that never ends
//! takes nothing with it.

use std::ffi::OsString;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use lightbench::assets::{Progress, Task};
use lightbench::lab::lesson::Language;
use lightbench::render::GpuOptions;

use super::{CHECKED, OUTCOME};
use crate::ui::messages::say;
use crate::ui::workbench::Wake;
use crate::ui::workbench::reporting::WorkerOptions;

/// How often it is looked whether somebody wants the check to stop.
const PAUSE: Duration = Duration::from_millis(50);
/// The folder of a check that runs, below that of the last one.
const RUNNING: &str = "running";
/// What the names of a check's pictures end with.
const PICTURES: [&str; 3] = ["-expected.png", "-yours.png", "-difference.png"];

/// What a check needs to know.
#[derive(Clone, Debug)]
pub struct Order {
    /// The project, which says of which lesson it is.
    pub project: PathBuf,
    /// The language of its messages.
    pub language: Language,
    /// Which adapter draws.
    pub gpu: GpuOptions,
    /// How the process is started.
    pub worker: WorkerOptions,
}

/// The check that runs, and what came of the last one.
#[derive(Default)]
pub struct Checking {
    task: Option<Task<Result<(), String>>>,
    /// Why the last one came to no end.
    pub why_not: Option<String>,
}

impl Checking {
    /// Begins a check, unless one runs.
    pub fn begin(&mut self, order: Order, wake: Wake) {
        if self.task.is_some() {
            return;
        }
        self.why_not = None;
        let task = Task::start(move |progress| {
            let tell = wake.clone();
            let done = run(&order, progress, &*tell);
            wake();
            done
        });
        match task {
            Ok(task) => self.task = Some(task),
            Err(error) => self.why_not = Some(error.to_string()),
        }
    }

    /// How far it is and what is checked, while it runs.
    pub fn progress(&self) -> Option<(f32, String)> {
        let progress = self.task.as_ref()?.progress();
        Some((progress.fraction(), progress.label()))
    }

    /// Asks the check to stop.
    pub fn cancel(&self) {
        if let Some(task) = &self.task {
            task.progress().cancel();
        }
    }

    /// Stops the check and forgets what came of the last one.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Whether a check has come to its end since the last call.
    pub(super) fn poll(&mut self) -> bool {
        let Some(task) = &self.task else {
            return false;
        };
        let (result, stopped) = match task.poll() {
            Ok(None) => return false,
            Ok(Some(result)) => (result, task.progress().is_cancelled()),
            Err(lost) => (Err(lost.to_string()), false),
        };
        self.task = None;
        let done = result.is_ok();
        // Who stopped it knows.
        self.why_not = result.err().filter(|_| !stopped);
        done
    }
}

fn run(order: &Order, progress: &Progress, wake: &(dyn Fn() + Send + Sync)) -> Result<(), String> {
    let last = order.project.join(CHECKED);
    let running = last.join(RUNNING);
    let failed = |error: std::io::Error| format!("{}: {error}", running.display());
    if running.exists() {
        std::fs::remove_dir_all(&running).map_err(failed)?;
    }
    std::fs::create_dir_all(&running).map_err(failed)?;
    let checked = start(order, &running).and_then(|child| follow(child, progress, wake));
    let moved = checked.and_then(|said| {
        let outcome = running.join(OUTCOME);
        // The exit status tells whether all points were given; the file, whether there was a check.
        if !outcome.is_file() {
            return Err(said);
        }
        replace(&running, &last).map_err(|error| format!("{}: {error}", last.display()))
    });
    // What is left there is made anew by the next one.
    let _ = std::fs::remove_dir_all(&running);
    moved
}

fn start(order: &Order, out: &Path) -> Result<Child, String> {
    let program = match &order.worker.program {
        Some(program) => program.clone(),
        None => std::env::current_exe().map_err(|error| say!("lesson.no_program", why = error))?,
    };
    let mut arguments: Vec<OsString> = vec!["--project".into(), order.project.as_path().into()];
    if let Some(limits) = &order.worker.limits {
        arguments.extend(["--limits".into(), limits.into()]);
    }
    arguments.push("check".into());
    arguments.extend(["--work".into(), order.project.as_path().into()]);
    arguments.extend(["--language".into(), order.language.code().into()]);
    arguments.extend(["--pictures".into(), out.into()]);
    arguments.extend(["--json".into(), out.join(OUTCOME).into()]);
    if let Some(adapter) = &order.gpu.adapter {
        arguments.extend(["--adapter".into(), adapter.into()]);
    }
    if order.gpu.portable {
        arguments.push("--portable".into());
    }
    Command::new(&program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| {
            say!(
                "lesson.not_started",
                program = program.display(),
                why = error
            )
        })
}

/// Waits for the process to end, and gives what it said that is no progress.
fn follow(
    mut child: Child,
    progress: &Progress,
    wake: &(dyn Fn() + Send + Sync),
) -> Result<String, String> {
    let lines = lines(&mut child);
    let mut said = Vec::new();
    loop {
        if progress.is_cancelled() {
            // It may have ended by itself just now.
            let _ = child.kill();
            let _ = child.wait();
            return Err(say!("lesson.stopped").to_owned());
        }
        match lines.recv_timeout(PAUSE) {
            Ok(line) => match step(&line) {
                Some((fraction, title)) => {
                    // Whether it is to stop is asked above.
                    let _ = progress.begin(title, fraction);
                    wake();
                }
                None => said.push(line),
            },
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    let status = child.wait().map_err(|error| error.to_string())?;
    match said.is_empty() {
        true => Ok(say!("lesson.no_outcome", status = status)),
        false => Ok(said.join("\n")),
    }
}

/// The lines that the process writes for people.
fn lines(child: &mut Child) -> Receiver<String> {
    let (sender, lines) = channel();
    if let Some(errors) = child.stderr.take() {
        std::thread::spawn(move || {
            for line in BufReader::new(errors).split(b'\n').map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line).trim_end().to_owned();
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
    }
    lines
}

/// What `[2/5] A matt surface` says: the share that was done before, and the title.
fn step(line: &str) -> Option<(f32, String)> {
    let (count, title) = line.strip_prefix('[')?.split_once("] ")?;
    let (number, of) = count.split_once('/')?;
    let (number, of): (u32, u32) = (number.parse().ok()?, of.parse().ok()?);
    Some((
        (number.max(1) - 1) as f32 / of.max(1) as f32,
        title.to_owned(),
    ))
}

/// Puts the files of a check in the place of those of the one before.
fn replace(new: &Path, old: &Path) -> std::io::Result<()> {
    for entry in std::fs::read_dir(old)? {
        let path = entry?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        let is_of_checks = |name: &str| PICTURES.iter().any(|ending| name.ends_with(ending));
        if name.is_some_and(is_of_checks) {
            std::fs::remove_file(path)?;
        }
    }
    for entry in std::fs::read_dir(new)? {
        let entry = entry?;
        std::fs::rename(entry.path(), old.join(entry.file_name()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_told_from_other_lines() {
        let title = |text: &str| text.to_owned();
        assert_eq!(step("[1/4] A [lamp]"), Some((0.0, title("A [lamp]"))));
        assert_eq!(step("[4/4] Last"), Some((0.75, title("Last"))));
        for other in ["", "[x/4] a", "checks.rhai:3: [1/4] a", "[1] a"] {
            assert_eq!(step(other), None);
        }
    }
}
