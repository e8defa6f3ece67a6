//! What came of one hand-in, as a file.

use std::fs;
use std::path::{Path, PathBuf};

use lightbench_assets::files::write_atomic;
use lightbench_lab::lesson::Outcome;
use serde::{Deserialize, Serialize};

use super::GradeError;

/// Version of the data. It grows when a field changes its meaning or goes away.
pub const RECORD_SCHEMA: u32 = 1;

/// The file of a record.
const FILE: &str = "record.json";

/// What came of one hand-in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// [`RECORD_SCHEMA`].
    pub schema: u32,
    /// What names the student in the system of the course.
    pub student: String,
    /// The name for people.
    pub name: String,
    /// Whether the system marked the hand-in as late.
    pub late: bool,
    /// The file that was graded; `None` where there was none.
    pub archive: Option<String>,
    /// Older files of the same student.
    pub replaced: Vec<String>,
    /// For whom numbers were drawn: what the hand-in says, or what a list says.
    pub id: Option<String>,
    /// Hash of all that the points depend on: the archive, the lesson, hidden checks, the program.
    pub fingerprint: String,
    /// How the check ended.
    pub ending: Ending,
    /// Seconds that it took.
    pub seconds: f64,
    /// The most memory that it was seen to use, in bytes.
    pub memory: Option<u64>,
    /// What the system could not enforce against it.
    pub not_enforced: Vec<String>,
}

/// How a check ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// It was checked.
    Checked(Box<Outcome>),
    /// Nothing can be checked: there is no archive, or it is refused. It gets no points.
    NoSubmission(String),
    /// The check took too long, too much memory, printed too much or crashed. It gets no points, and a
    /// person should look at it.
    Stopped(String),
    /// The check could not be made, through no fault of the student.
    Failed(String),
}

impl Record {
    /// The points, where the hand-in was judged.
    #[must_use]
    pub fn points(&self) -> Option<u32> {
        match &self.ending {
            Ending::Checked(outcome) => Some(outcome.points),
            Ending::NoSubmission(_) | Ending::Stopped(_) => Some(0),
            Ending::Failed(_) => None,
        }
    }

    /// The outcome, where there is one.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        match &self.ending {
            Ending::Checked(outcome) => Some(outcome),
            _ => None,
        }
    }

    /// Why there is no outcome.
    #[must_use]
    pub fn problem(&self) -> Option<&str> {
        match &self.ending {
            Ending::Checked(_) => None,
            Ending::NoSubmission(text) | Ending::Stopped(text) | Ending::Failed(text) => Some(text),
        }
    }

    /// Whether a person should look at it before the points are given out.
    #[must_use]
    pub fn needs_a_person(&self) -> bool {
        match &self.ending {
            Ending::Checked(outcome) => outcome.marked,
            Ending::NoSubmission(_) => false,
            Ending::Stopped(_) | Ending::Failed(_) => true,
        }
    }

    /// The word for how it ended, as tables have it.
    #[must_use]
    pub fn state(&self) -> &'static str {
        match &self.ending {
            Ending::Checked(outcome) if outcome.marked => "near a threshold",
            Ending::Checked(_) => "checked",
            Ending::NoSubmission(_) => "no submission",
            Ending::Stopped(_) => "stopped",
            Ending::Failed(_) => "failed",
        }
    }

    /// Writes the record into a folder, whole or not at all.
    ///
    /// # Errors
    /// A disk that can't be written.
    pub fn write(&self, folder: &Path) -> Result<(), GradeError> {
        let path = folder.join(FILE);
        let text = serde_json::to_string_pretty(self).map_err(|error| GradeError::Data {
            path: path.clone(),
            reason: error.to_string(),
        })?;
        fs::create_dir_all(folder).map_err(|error| GradeError::disk(folder, error))?;
        Ok(write_atomic(&path, text.as_bytes())?)
    }

    /// Reads the record of a folder; `None` where there is none.
    ///
    /// # Errors
    /// A file that can't be read, or that another version has written.
    pub fn read(folder: &Path) -> Result<Option<Self>, GradeError> {
        let path: PathBuf = folder.join(FILE);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(GradeError::disk(&path, error)),
        };
        let record: Result<Self, _> = serde_json::from_str(&text);
        match record {
            Ok(record) if record.schema == RECORD_SCHEMA => Ok(Some(record)),
            // Another version wrote it, and this one grades anew.
            Ok(_) => Ok(None),
            Err(error) => Err(GradeError::Data {
                path,
                reason: error.to_string(),
            }),
        }
    }
}
