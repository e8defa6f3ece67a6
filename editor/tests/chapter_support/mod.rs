//! Reads the chapter "Deferred shading from an empty file".
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::PathBuf;

use lightbench::assets::files::Files;

/// Where the files of the steps lie.
pub const STEPS: &str = "scripts/pipelines/from_empty";
/// The file that the reader writes.
pub const LIT: &str = "scripts/pipelines/lit.rhai";

/// A part of a step, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// A block of code in a language; the text ends with a line end.
    Code { language: String, text: String },
    /// The file of a picture.
    Picture(String),
    /// One of the things to try, in one line.
    Experiment(String),
}

/// A section of the chapter.
#[derive(Clone, Debug)]
pub struct Section {
    /// The heading without its marks.
    pub title: String,
    /// All of its text.
    pub text: String,
    pub parts: Vec<Part>,
}

/// The folder of the documents.
pub fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../engine/script/docs")
}

pub fn path() -> PathBuf {
    folder().join("deferred-shading.md")
}

/// The sections; the first one is what stands before the steps.
pub fn sections() -> Vec<Section> {
    let text = fs::read_to_string(path()).unwrap().replace("\r\n", "\n");
    let mut sections: Vec<Section> = Vec::new();
    let (_, text) = text.split_once("# ").unwrap();
    for section in text.split("\n## ") {
        let (title, text) = section.split_once('\n').unwrap();
        sections.push(Section {
            title: title.to_owned(),
            text: text.to_owned(),
            parts: parts(text),
        });
    }
    sections
}

/// The section of a step, from 1.
pub fn step(number: usize) -> Section {
    let start = format!("Step {number}: ");
    let mut sections = sections().into_iter();
    sections.find(|s| s.title.starts_with(&start)).unwrap()
}

/// The path and the text of a step's file.
pub fn step_file(number: usize) -> (String, String) {
    let files = Files::shipped();
    let start = format!("{STEPS}/{number}_");
    let listed = files.list(STEPS, "rhai").unwrap();
    let file = listed.into_iter().find(|f| f.path.starts_with(&start));
    let path = file.unwrap().path;
    let text = files.read_text(&path).unwrap();
    (path, text)
}

fn parts(text: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let code = lines.by_ref().take_while(|line| *line != "```");
            let text = code.map(|line| format!("{line}\n")).collect();
            let language = language.to_owned();
            parts.push(Part::Code { language, text });
        } else if let Some(picture) = line.strip_prefix("![") {
            let file = picture.split_once("](").unwrap().1;
            parts.push(Part::Picture(file.trim_end_matches(')').to_owned()));
        } else if ["1. ", "2. ", "3. "].iter().any(|n| line.starts_with(n)) {
            let mut item = line[3..].to_owned();
            while let Some(more) = lines.next_if(|line| line.starts_with("   ")) {
                item = format!("{item} {}", more.trim());
            }
            parts.push(Part::Experiment(item));
        }
    }
    parts
}

/// What stands in back quotes.
pub fn spans(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}
