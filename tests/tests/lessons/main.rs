//! The shipped lessons: what they say is there, their solutions get all points, and mistakes lose some
//! with a message that names the cause.
#![allow(clippy::unwrap_used)]

mod figures;
mod formulas;
mod mutants;
mod texts;
mod variants;

use std::fs;
use std::path::{Path, PathBuf};

use lightbench::assets::Progress;
use lightbench::lab::lesson::{CheckOptions, Lesson, Outcome, Source, check};

/// The folder of the lessons, with what is kept back from students.
fn lessons() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../lessons")
}

/// All lessons, each with its folder. `LIGHTBENCH_LESSON=02` takes those whose names begin so, for who
/// writes one.
fn all() -> Vec<(PathBuf, Lesson)> {
    let only = std::env::var("LIGHTBENCH_LESSON").unwrap_or_default();
    let entries = fs::read_dir(lessons()).unwrap();
    let mut folders: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .filter(|path| {
            path.file_name()
                .unwrap()
                .to_str()
                .unwrap()
                .starts_with(&only)
        })
        .collect();
    folders.sort();
    assert!(!folders.is_empty());
    let read = folders.into_iter().map(|folder| {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let lesson = Lesson::read(&name, Source::of_folder(&folder).unwrap());
        let lesson = lesson.unwrap_or_else(|problems| panic!("{problems}"));
        (folder, lesson)
    });
    read.collect()
}

/// Copies all files below a folder into another.
fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            fs::create_dir_all(&target).unwrap();
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// A submission: the starter with the solution over it.
fn solved(folder: &Path) -> tempfile::TempDir {
    let work = tempfile::tempdir().unwrap();
    copy(&folder.join("starter"), work.path());
    copy(&folder.join("solution"), work.path());
    work
}

/// Checks some tasks, or all. What the checks themselves get wrong is a fault of the lesson.
fn checked(lesson: &Lesson, work: &Path, only: &[&str]) -> Outcome {
    let options = CheckOptions {
        only: only.iter().map(|task| (*task).to_owned()).collect(),
        ..CheckOptions::default()
    };
    check(lesson, work, &options, &Progress::new(), |_| {}).unwrap()
}

/// All that an outcome says of what is wrong, for messages of tests.
fn told(outcome: &Outcome) -> String {
    serde_json::to_string_pretty(&outcome.tasks).unwrap()
}
