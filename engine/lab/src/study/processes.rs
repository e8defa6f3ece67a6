//! Running the processes of a study, one after another, and following what they say.
//!
//! A worker is told its points on its standard input, one a line, and an empty line ends them. It writes
//! one JSON object a line to its standard output. When its input ends, whoever started it is gone or
//! wants it to stop, and it stops.

use std::ffi::OsString;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use lightbench_assets::{Cancelled, Progress};
use serde::{Deserialize, Serialize};

use super::model::Plan;
use super::points::Planned;
use super::store::Store;

/// How often the user's wish to stop is looked for.
const LOOK: Duration = Duration::from_millis(50);
/// How long a worker may take to stop by itself.
const GRACE: Duration = Duration::from_secs(10);

/// How a worker is started.
#[derive(Clone, Debug)]
pub struct Launch {
    /// The program.
    pub program: PathBuf,
    /// What it is given before the number of its process.
    pub arguments: Vec<OsString>,
}

/// A line of a worker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Line {
    /// How far the point under way is, 0 to 1, and what is being done.
    Progress(f32, String),
    /// A point is measured and written.
    Done(String),
    /// What a person should know.
    Warning(String),
    /// What a script printed.
    Note(String),
}

/// What is told while processes run.
#[derive(Clone, Debug, PartialEq)]
pub enum Told {
    /// A process has measured a point.
    Done {
        /// The process, from 0.
        process: u32,
        /// The point.
        key: String,
        /// Seconds until all is measured, as far as can be known.
        seconds_left: f64,
    },
    /// What a person should know; each once.
    Warning(String),
    /// What a script printed; each once.
    Note(String),
}

/// Why not all processes came to their end.
#[derive(Debug, thiserror::Error)]
pub enum ProcessError {
    /// A worker can't be started.
    #[error("can't start {}: {error}", program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// A worker failed; it has said why.
    #[error("{0}")]
    Failed(String),
    /// It was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Measures what is missing: each process in turn measures all points that it has not measured yet.
///
/// # Errors
/// A worker that fails, or `progress` that is cancelled. What was measured by then is on disk.
pub fn run_processes(
    launch: &Launch,
    store: &Store,
    plan: &Plan,
    points: &[Planned],
    progress: &Progress,
    tell: &mut dyn FnMut(Told),
) -> Result<(), ProcessError> {
    let missing: Vec<Vec<&Planned>> = (0..plan.processes)
        .map(|process| {
            points
                .iter()
                .filter(|point| !store.has(point, process))
                .collect()
        })
        .collect();
    let mut follower = Follower {
        plan,
        progress,
        tell,
        began: Instant::now(),
        all: missing.iter().map(Vec::len).sum(),
        done: 0,
        said: Vec::new(),
    };
    for (process, points) in missing.iter().enumerate() {
        if !points.is_empty() {
            run_one(launch, process as u32, points, &mut follower)?;
        }
    }
    Ok(())
}

struct Follower<'a> {
    plan: &'a Plan,
    progress: &'a Progress,
    tell: &'a mut dyn FnMut(Told),
    began: Instant,
    /// Points of all processes that are to be measured, and that are.
    all: usize,
    done: usize,
    said: Vec<String>,
}

impl Follower<'_> {
    fn hear(&mut self, process: u32, line: Line) {
        match line {
            Line::Progress(fraction, label) => self.show(process, fraction, &label),
            Line::Done(key) => {
                self.done += 1;
                let seconds_left = self.seconds_left(0.0);
                (self.tell)(Told::Done {
                    process,
                    key,
                    seconds_left,
                });
            }
            Line::Warning(text) => self.once(text, Told::Warning),
            Line::Note(text) => self.once(text, Told::Note),
        }
    }

    /// Every process says the same.
    fn once(&mut self, text: String, told: fn(String) -> Told) {
        if !self.said.contains(&text) {
            self.said.push(text.clone());
            (self.tell)(told(text));
        }
    }

    fn seconds_left(&self, fraction: f32) -> f64 {
        let done = self.done as f64 + f64::from(fraction);
        let elapsed = self.began.elapsed().as_secs_f64();
        elapsed / done.max(1e-3) * (self.all as f64 - done).max(0.0)
    }

    fn show(&self, process: u32, fraction: f32, label: &str) {
        let share = (self.done as f32 + fraction) / self.all.max(1) as f32;
        let mut words = format!(
            "process {} of {}: {label}",
            process + 1,
            self.plan.processes
        );
        if share > 0.02 {
            words += &format!(", {} left", in_words(self.seconds_left(fraction)));
        }
        // Whether it is cancelled is looked at between two lines.
        let _ = self.progress.begin(words, share);
    }
}

/// "40 s", "3 min", "2 h 5 min".
pub fn in_words(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u64;
    match minutes {
        _ if seconds < 90.0 => format!("{seconds:.0} s"),
        0..=90 => format!("{minutes} min"),
        _ => format!("{} h {} min", minutes / 60, minutes % 60),
    }
}

fn run_one(
    launch: &Launch,
    process: u32,
    points: &[&Planned],
    follower: &mut Follower<'_>,
) -> Result<(), ProcessError> {
    let start = |error| ProcessError::Start {
        program: launch.program.clone(),
        error,
    };
    let mut child = Command::new(&launch.program)
        .args(&launch.arguments)
        .arg(process.to_string())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(start)?;
    // Held open until the worker is done.
    let mut input = child.stdin.take();
    if let Some(input) = &mut input {
        let keys: String = points
            .iter()
            .map(|point| format!("{}\n", point.key))
            .collect();
        // A worker that is gone already says why on its error output.
        let _ = input.write_all(format!("{keys}\n").as_bytes());
        let _ = input.flush();
    }
    let (lines, errors) = (child.stdout.take(), child.stderr.take());
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let lines = lines
            .map(BufReader::new)
            .into_iter()
            .flat_map(|lines| lines.lines());
        for line in lines.map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    let errors = thread::spawn(move || {
        let mut text = String::new();
        if let Some(mut errors) = errors {
            let mut bytes = Vec::new();
            // What can't be read can't be told.
            let _ = errors.read_to_end(&mut bytes);
            text = String::from_utf8_lossy(&bytes).into_owned();
        }
        text
    });
    loop {
        match receiver.recv_timeout(LOOK) {
            Ok(line) => {
                // Whatever else a driver prints is nothing for us.
                if let Ok(line) = serde_json::from_str(&line) {
                    follower.hear(process, line);
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        if follower.progress.is_cancelled() {
            drop(input.take());
            stop(&mut child);
            return Err(Cancelled.into());
        }
    }
    let status = child.wait().map_err(start)?;
    let errors = errors.join().unwrap_or_default();
    if follower.progress.is_cancelled() {
        return Err(Cancelled.into());
    }
    if status.success() {
        for line in errors.lines().filter(|line| !line.trim().is_empty()) {
            follower.once(line.to_owned(), Told::Note);
        }
        return Ok(());
    }
    let errors = errors.trim_end();
    Err(ProcessError::Failed(match errors {
        "" => format!("error: a process that measured ended with {status} and did not say why"),
        errors => errors.to_owned(),
    }))
}

/// Waits for a worker that was told to stop, and ends it where it does not.
fn stop(child: &mut Child) {
    let began = Instant::now();
    while began.elapsed() < GRACE {
        if !matches!(child.try_wait(), Ok(None)) {
            return;
        }
        thread::sleep(LOOK);
    }
    // It may have ended meanwhile.
    let _ = child.kill();
    let _ = child.wait();
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn times_are_said_as_people_do() {
        for (seconds, words) in [
            (0.4, "0 s"),
            (89.0, "89 s"),
            (100.0, "2 min"),
            (3600.0, "60 min"),
            (7500.0, "2 h 5 min"),
        ] {
            assert_eq!(in_words(seconds), words);
        }
    }

    #[test]
    fn lines_read_back() {
        for line in [
            Line::Progress(0.5, "drawing \"x\"\n".into()),
            Line::Done("scene=a".into()),
            Line::Warning("w".into()),
        ] {
            let text = serde_json::to_string(&line).unwrap();
            assert!(!text.contains('\n'));
            assert_eq!(serde_json::from_str::<Line>(&text).unwrap(), line);
        }
    }
}
