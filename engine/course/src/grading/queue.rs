//! Hand-ins, one after another or some at a time.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use lightbench_assets::Digest;
use lightbench_assets::files::FileError;
use lightbench_lab::lesson::{Lesson, Outcome};

use super::record::{Ending, RECORD_SCHEMA, Record};
use crate::archive::{self, unpack};
use crate::exports::Submission;
use crate::hand_in::HandedIn;
use crate::supervise::{Bounds, End, Ended, supervise};

/// The file that a process writes its outcome to.
const OUTCOME: &str = "outcome.json";

/// How hand-ins are graded.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder of records, pictures and pages.
    pub out: PathBuf,
    /// How many are graded at a time.
    pub jobs: usize,
    /// What each may take.
    pub bounds: Bounds,
    /// What an archive may hold.
    pub archive: archive::Bounds,
    /// Hash of what the points depend on beside the archive.
    pub fingerprint: String,
    /// Students that are graded again though nothing has changed.
    pub again: Vec<String>,
    /// Ids by student, where the course has a list.
    pub ids: BTreeMap<String, String>,
}

/// What a process is to check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The folder with what was handed in.
    pub work: PathBuf,
    /// The folder that the process may write into: the outcome and pictures.
    pub out: PathBuf,
    /// For whom numbers are drawn.
    pub id: Option<String>,
}

impl Assignment {
    /// Where the outcome is expected.
    #[must_use]
    pub fn outcome(&self) -> PathBuf {
        self.out.join(OUTCOME)
    }
}

/// What is told while grading.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// How many are done, with this one.
    pub done: usize,
    /// How many there are.
    pub of: usize,
    /// The record.
    pub record: Record,
    /// Whether it was graded before, and nothing has changed since.
    pub known: bool,
}

/// Why grading ended.
#[derive(Debug, thiserror::Error)]
pub enum GradeError {
    /// A file can't be read or written.
    #[error("{}: {source}", path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file can't be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file is not what it should be.
    #[error("{}: {reason}; remove it, and the hand-in is graded again", path.display())]
    Data {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The program can't be started.
    #[error("can't start the process that checks: {0}")]
    Start(io::Error),
    /// It was stopped.
    #[error("stopped; the same command goes on with what is missing")]
    Cancelled,
}

impl GradeError {
    pub(crate) fn disk(path: &Path, source: io::Error) -> Self {
        Self::Disk {
            path: path.to_owned(),
            source,
        }
    }
}

/// The folder of a student below a folder. Names may have any letters, so unusual ones are replaced and
/// told apart by a hash.
#[must_use]
pub fn prepared(folder: &Path, student: &str) -> PathBuf {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.' | '@');
    if !student.is_empty() && !student.starts_with('.') && student.chars().all(plain) {
        return folder.join(student);
    }
    let kept: String = student.chars().filter(|c| plain(*c) && *c != '.').collect();
    let hash = Digest::of(student.as_bytes()).to_string();
    folder.join(format!("{kept}~{}", &hash[..8]))
}

/// Grades all hand-ins that have no record yet, or whose record is of something else. `launch` gives the
/// process that checks one. The records come in the order of the hand-ins.
///
/// # Errors
/// A disk that can't be written, a program that can't be started, or it was `cancelled`. What was graded
/// by then is on disk.
pub fn grade(
    lesson: &Lesson,
    submissions: &[Submission],
    options: &Options,
    launch: &(dyn Fn(&Assignment) -> Command + Sync),
    cancelled: &(dyn Fn() -> bool + Sync),
    tell: &(dyn Fn(Told) + Sync),
) -> Result<Vec<Record>, GradeError> {
    let next = AtomicUsize::new(0);
    let done = AtomicUsize::new(0);
    let records: Mutex<BTreeMap<usize, Record>> = Mutex::default();
    let failure: Mutex<Option<GradeError>> = Mutex::default();
    let failed = || {
        failure
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_some()
    };
    let work = || {
        let grader = Grader {
            lesson,
            options,
            launch,
            cancelled,
        };
        while !failed() {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(submission) = submissions.get(index) else {
                return;
            };
            match grader.one(submission) {
                Ok((record, known)) => {
                    let told = Told {
                        done: done.fetch_add(1, Ordering::Relaxed) + 1,
                        of: submissions.len(),
                        record: record.clone(),
                        known,
                    };
                    tell(told);
                    let mut records = records.lock().unwrap_or_else(PoisonError::into_inner);
                    records.insert(index, record);
                }
                Err(error) => {
                    let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
                    failure.get_or_insert(error);
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..options.jobs.clamp(1, submissions.len().max(1)) {
            scope.spawn(work);
        }
    });
    match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => {
            let records = records.into_inner();
            Ok(records
                .unwrap_or_else(PoisonError::into_inner)
                .into_values()
                .collect())
        }
    }
}

struct Grader<'a> {
    lesson: &'a Lesson,
    options: &'a Options,
    launch: &'a (dyn Fn(&Assignment) -> Command + Sync),
    cancelled: &'a (dyn Fn() -> bool + Sync),
}

impl Grader<'_> {
    fn one(&self, submission: &Submission) -> Result<(Record, bool), GradeError> {
        let folder = prepared(&self.options.out.join("students"), &submission.student);
        let bytes = match &submission.archive {
            Ok(path) => Some(fs::read(path).map_err(|error| GradeError::disk(path, error))?),
            Err(_) => None,
        };
        let listed = self.options.ids.get(&submission.student).cloned();
        let fingerprint = self.fingerprint(bytes.as_deref(), listed.as_deref());
        let again = self.options.again.contains(&submission.student);
        if !again
            && let Some(record) = Record::read(&folder)?
            && record.fingerprint == fingerprint
            && record.late == submission.late
            // What was no fault of the student is tried again.
            && !matches!(record.ending, Ending::Failed(_))
        {
            return Ok((record, true));
        }
        let file = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default();
            name.to_string_lossy().into_owned()
        };
        let mut record = Record {
            schema: RECORD_SCHEMA,
            student: submission.student.clone(),
            name: submission.name.clone(),
            late: submission.late,
            archive: submission.archive.as_ref().ok().map(file),
            replaced: submission.replaced.iter().map(file).collect(),
            id: listed,
            fingerprint,
            ending: Ending::Failed(String::new()),
            seconds: 0.0,
            memory: None,
            not_enforced: Vec::new(),
        };
        match &submission.archive {
            Err(none) => record.ending = Ending::NoSubmission(none.to_string()),
            Ok(archive) => self.check(archive, &folder, &mut record)?,
        }
        record.write(&folder)?;
        Ok((record, false))
    }

    fn fingerprint(&self, archive: Option<&[u8]>, id: Option<&str>) -> String {
        let parts = [
            self.options.fingerprint.as_bytes(),
            archive.unwrap_or_default(),
            id.unwrap_or_default().as_bytes(),
        ];
        // Each part by its own hash, so that none can run into the next.
        let hashes: String = parts.map(|part| Digest::of(part).to_string()).concat();
        Digest::of(hashes.as_bytes()).to_string()
    }

    fn check(&self, archive: &Path, folder: &Path, record: &mut Record) -> Result<(), GradeError> {
        let work = folder.join("work");
        let out = folder.join("check");
        for old in [&work, &out] {
            match fs::remove_dir_all(old) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return Err(GradeError::disk(old, error));
                }
                _ => {}
            }
        }
        if let Err(error) = unpack(archive, &work, &self.options.archive) {
            return match error {
                // The folder could not be written, which is no fault of the archive.
                archive::ArchiveError::Disk { path, source } => {
                    Err(GradeError::Disk { path, source })
                }
                refused => {
                    let reason = refused.reason();
                    record.ending = Ending::NoSubmission(format!(
                        "{reason}; make the archive with `lightbench hand-in`"
                    ));
                    Ok(())
                }
            };
        }
        fs::create_dir_all(&out).map_err(|error| GradeError::disk(&out, error))?;
        if let Some(says) = HandedIn::of(&work)
            && says.lesson != self.lesson.name
        {
            let text = format!("it is a hand-in of the lesson {}", says.lesson);
            record.ending = Ending::NoSubmission(text);
            return Ok(());
        }
        record.id = record.id.take().or_else(|| HandedIn::of(&work)?.student);
        let assignment = Assignment {
            work,
            out,
            id: record.id.clone(),
        };
        let command = (self.launch)(&assignment);
        let ended = supervise(command, &self.options.bounds, self.cancelled);
        let ended = ended.map_err(GradeError::Start)?;
        if ended.end == End::Cancelled {
            return Err(GradeError::Cancelled);
        }
        record.seconds = ended.seconds;
        record.memory = ended.memory;
        record.ending = self.ending(&ended, &assignment);
        let lines = String::from_utf8_lossy(&ended.output);
        let lines = lines
            .lines()
            .filter_map(|line| line.strip_prefix(NOT_ENFORCED));
        record.not_enforced = lines.map(str::to_owned).collect();
        Ok(())
    }

    fn ending(&self, ended: &Ended, assignment: &Assignment) -> Ending {
        let bounds = &self.options.bounds;
        let stopped = |text: String| Ending::Stopped(text);
        match ended.end {
            End::Time => stopped(format!(
                "it was stopped after {:.0} s: something in it does not come to an end",
                bounds.time.as_secs_f64()
            )),
            End::Memory => stopped(format!(
                "it was stopped when it used more than {} MiB of memory",
                bounds.memory >> 20
            )),
            End::Output => stopped(format!(
                "it was stopped when it had printed more than {} KiB",
                bounds.output >> 10
            )),
            End::Crashed(Some(signal)) => stopped(format!(
                "the process that checked it crashed with signal {signal}: something in it is too deep or \
                 too large for this program or the driver"
            )),
            End::Crashed(None) => stopped("the process that checked it crashed".to_owned()),
            End::Cancelled => Ending::Failed("it was cancelled".to_owned()),
            End::Exited(status) => match self.outcome(assignment) {
                Ok(outcome) => Ending::Checked(Box::new(outcome)),
                Err(reason) => {
                    let errors = String::from_utf8_lossy(&ended.errors);
                    let errors = errors.trim();
                    Ending::Failed(match errors {
                        "" => format!("the check ended with status {status}: {reason}"),
                        errors => errors.to_owned(),
                    })
                }
            },
        }
    }

    /// What the process found, if it is an outcome of this lesson whose points add up.
    fn outcome(&self, assignment: &Assignment) -> Result<Outcome, String> {
        let path = assignment.outcome();
        let text = fs::read_to_string(&path).map_err(|error| error.to_string())?;
        let outcome: Outcome = serde_json::from_str(&text).map_err(|error| error.to_string())?;
        let about = &self.lesson.about;
        let given: u32 = outcome.tasks.iter().map(|task| task.points).sum();
        let fits = outcome.lesson == self.lesson.name
            && outcome.of == about.points()
            && outcome.points == given
            && outcome.tasks.len() == about.tasks.len() + about.questions.len()
            && outcome.tasks.iter().all(|task| task.points <= task.of);
        fits.then_some(outcome)
            .ok_or_else(|| "its outcome is not one of this lesson".to_owned())
    }
}

/// What begins a line in which the process that checks says what it could not give up.
pub const NOT_ENFORCED: &str = "not enforced: ";

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::time::Duration;

    use lightbench_lab::lesson::Source;

    use super::*;

    /// One hand-in whose check is a shell script.
    fn ended(script: &str) -> Record {
        let folder = tempfile::tempdir().unwrap();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../lessons/11-linear-light");
        let lesson = Lesson::read("11-linear-light", Source::of_folder(&path).unwrap()).unwrap();
        let file = folder.path().join("ada.zip");
        archive::pack(&file, &[("a".to_owned(), Vec::new())]).unwrap();
        let submission = Submission {
            student: "ada".to_owned(),
            name: "Ada".to_owned(),
            late: false,
            archive: Ok(file),
            replaced: Vec::new(),
        };
        let options = Options {
            out: folder.path().join("out"),
            jobs: 1,
            bounds: Bounds {
                time: Duration::from_millis(500),
                memory: 1 << 30,
                output: 1000,
            },
            archive: archive::Bounds::default(),
            fingerprint: String::new(),
            again: Vec::new(),
            ids: BTreeMap::new(),
        };
        let launch = |assignment: &Assignment| {
            let mut command = Command::new("sh");
            command
                .args(["-c", script])
                .env("OUTCOME", assignment.outcome());
            command
        };
        let records = grade(
            &lesson,
            &[submission],
            &options,
            &launch,
            &|| false,
            &|_| {},
        );
        let record = records.unwrap().pop().unwrap();
        let written = Record::read(&options.out.join("students/ada")).unwrap();
        assert_eq!(written.as_ref(), Some(&record));
        record
    }

    #[test]
    fn what_hangs_crashes_or_floods_gets_no_points_and_is_marked() {
        for (script, words) in [
            ("sleep 100", "stopped after"),
            ("kill -SEGV $$", "crashed with signal 11"),
            ("yes", "had printed more than"),
        ] {
            let record = ended(script);
            assert!(matches!(record.ending, Ending::Stopped(_)), "{script}");
            assert!(record.problem().unwrap().contains(words), "{record:?}");
            assert_eq!(record.points(), Some(0));
            assert!(record.needs_a_person());
        }
    }

    #[test]
    fn a_check_that_fails_by_itself_gives_no_points_at_all() {
        let record = ended("echo 'error: no device' >&2; exit 1");
        assert_eq!(record.problem(), Some("error: no device"));
        assert_eq!(record.points(), None);
        // Nor does an outcome that is another lesson's, or none.
        for text in ["{}", "not JSON"] {
            let record = ended(&format!("printf '{text}' > \"$OUTCOME\""));
            assert_eq!(record.points(), None, "{record:?}");
        }
    }

    #[test]
    fn what_can_not_be_enforced_is_kept() {
        let record = ended("echo 'not enforced: no network: denied'; exit 1");
        assert_eq!(record.not_enforced, ["no network: denied"]);
    }
}
