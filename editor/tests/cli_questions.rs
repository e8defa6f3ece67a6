//! The measured questions of the shipped lessons: measured with the solution as the lesson's text says, the
//! right answer gets all points; another number, or the report of something else, gets none.
#![allow(clippy::unwrap_used)]

mod cli_support;

use std::fs;
use std::path::{Path, PathBuf};

use cli_support::run_in;
use serde::Deserialize;

/// What a lesson's folder says of its questions.
#[derive(Deserialize)]
struct Variants {
    answer: Vec<Answer>,
}

/// The answer of a question, as somebody read it from the report.
#[derive(Deserialize)]
struct Answer {
    question: String,
    /// What measures it: arguments of `compare`, or of another command with its name.
    compare: Option<Vec<String>>,
    run: Option<Vec<String>>,
    /// The report in the folder that the command writes.
    report: String,
    value: f64,
    wrong: f64,
    /// Arguments of `compare` for a report that does not answer it.
    other: Vec<String>,
}

/// The folders of the lessons.
fn lessons() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lessons");
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut found: Vec<PathBuf> = paths.filter(|path| path.is_dir()).collect();
    found.sort();
    found
}

/// The project of a student who has solved all tasks.
fn solved(lesson: &Path, place: &Path) -> PathBuf {
    let path = lesson.to_str().unwrap();
    run_in(place, &["lesson", "start", path, "--into", "mine"], &[]).succeeded();
    let project = place.join("mine");
    let mut folders = vec![lesson.join("solution")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let from = entry.unwrap().path();
            if from.is_dir() {
                folders.push(from);
                continue;
            }
            let to = project.join(from.strip_prefix(lesson.join("solution")).unwrap());
            fs::create_dir_all(to.parent().unwrap()).unwrap();
            fs::copy(from, to).unwrap();
        }
    }
    project
}

fn measure(project: &Path, command: &str, arguments: &[String], out: &str) {
    let mut all = vec![command];
    all.extend(arguments.iter().map(String::as_str));
    all.extend(["--out", out]);
    run_in(project, &all, &[]).succeeded();
}

/// The points that an answer gets, and what the check says.
fn points(project: &Path, question: &str, value: f64, report: &str) -> (u64, u64, String) {
    let text = format!("[{question}]\nvalue = {value:?}\nreport = \"{report}\"\n");
    fs::write(project.join("answers.toml"), text).unwrap();
    let check = ["check", "--task", question, "--json", "out/result.json"];
    let said = run_in(project, &check, &[]).all();
    let json = fs::read(project.join("out/result.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    let number = |name: &str| json[name].as_u64().unwrap();
    (number("points"), number("of"), said)
}

fn answers_of(lesson: &Path) {
    let text = fs::read_to_string(lesson.join("hidden/variants.toml")).unwrap();
    let variants: Variants = toml::from_str(&text).unwrap();
    let about = fs::read_to_string(lesson.join("lesson.toml")).unwrap();
    let about: toml::Table = toml::from_str(&about).unwrap();
    let questions = about["question"].as_array().unwrap();
    assert_eq!(
        questions.len(),
        variants.answer.len(),
        "{}",
        lesson.display()
    );
    let place = tempfile::tempdir().unwrap();
    let project = solved(lesson, place.path());
    for answer in &variants.answer {
        let Answer {
            question, value, ..
        } = answer;
        let (command, arguments) = match (&answer.compare, &answer.run) {
            (Some(compare), None) => ("compare", compare),
            (None, Some(run)) => ("run", run),
            _ => panic!("`{question}` has to be measured in one way"),
        };
        measure(&project, command, arguments, "reports/right");
        let report = format!("reports/right/{}", answer.report);
        let (found, of, said) = points(&project, question, *value, &report);
        assert!(of > 0 && found == of, "{}: {said}", lesson.display());
        let (found, _, said) = points(&project, question, answer.wrong, &report);
        assert_eq!(found, 0, "{}: {said}", lesson.display());
        measure(&project, "compare", &answer.other, "reports/other");
        let (found, _, said) = points(&project, question, *value, "reports/other/report.json");
        assert_eq!(found, 0, "{}: {said}", lesson.display());
    }
}

/// One after another, because each measures.
#[test]
fn questions_of_all_lessons_are_answered_from_reports() {
    for lesson in lessons() {
        answers_of(&lesson);
    }
}
