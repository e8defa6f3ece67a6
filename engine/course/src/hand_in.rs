//! What a student hands in: one archive with the submitted files, the answers with their reports, and a
//! file that says whose it is.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lightbench_assets::files::{FileError, Files};
use lightbench_lab::lesson::{ANSWERS, Lesson, Outcome, read_answers};
use serde::{Deserialize, Serialize};

use crate::archive::{ArchiveError, pack};

/// The file that says whose work it is.
pub const HAND_IN: &str = "hand-in.json";

/// Whose work an archive holds. What it says of points is for the student's eyes: whoever grades checks
/// again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HandedIn {
    /// The name of the lesson.
    pub lesson: String,
    /// The student, if one was named.
    #[serde(default)]
    pub student: Option<String>,
    /// Version of the program that made it.
    pub program: String,
    /// Points that the student saw.
    pub points: u32,
    /// Points that there were.
    pub of: u32,
}

impl HandedIn {
    /// What an unpacked archive says; `None` where it says nothing, as one that was packed by hand.
    #[must_use]
    pub fn of(work: &Path) -> Option<Self> {
        let text = fs::read_to_string(work.join(HAND_IN)).ok()?;
        serde_json::from_str(&text).ok()
    }
}

/// Why there is no archive.
#[derive(Debug, thiserror::Error)]
pub enum HandInError {
    /// A file of the work can't be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The archive can't be written.
    #[error(transparent)]
    Archive(#[from] ArchiveError),
    /// Something can't be written as text.
    #[error("{HAND_IN}: {0}")]
    Data(#[from] serde_json::Error),
}

/// The paths of what a work hands in, as far as the files are there: what is missing is told when it is
/// checked.
fn paths(lesson: &Lesson, work: &Path, files: &Files) -> Vec<String> {
    let mut paths: BTreeSet<String> = lesson.about.submits.iter().cloned().collect();
    if !lesson.about.questions.is_empty() && work.join(ANSWERS).is_file() {
        paths.insert(ANSWERS.to_owned());
        // Answers that can't be read are handed in as they are.
        let answers = read_answers(files).unwrap_or_default();
        paths.extend(answers.into_values().map(|answer| answer.report));
    }
    paths.retain(|path| work.join(path).is_file());
    paths.into_iter().collect()
}

/// Writes the archive of a work, and says what is in it. The same work gives the same bytes.
///
/// # Errors
/// A file that is there and can't be read, or a disk that can't be written.
pub fn hand_in(
    lesson: &Lesson,
    work: &Path,
    outcome: &Outcome,
    archive: &Path,
) -> Result<Vec<PathBuf>, HandInError> {
    let files = Files::with_project(work)?;
    let about = HandedIn {
        lesson: lesson.name.clone(),
        student: outcome.student.clone(),
        program: env!("CARGO_PKG_VERSION").to_owned(),
        points: outcome.points,
        of: outcome.of,
    };
    let about = serde_json::to_string_pretty(&about)?;
    let mut content = vec![(HAND_IN.to_owned(), about.into_bytes())];
    for path in paths(lesson, work, &files) {
        let bytes = files.read(&path)?;
        content.push((path, bytes));
    }
    pack(archive, &content)?;
    Ok(content.into_iter().map(|(path, _)| path.into()).collect())
}
