//! Follows the chapter "Deferred shading from an empty file" as a reader does, through the program.
//!
//! `LIGHTBENCH_UPDATE=1` (`./x docs`) writes the pictures and the quoted messages anew instead of
//! comparing them.
#![allow(clippy::unwrap_used)]

mod chapter_support;
mod cli_support;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use chapter_support::{LIT, Part, Section, folder, sections, spans, step, step_file};
use cli_support::{Outcome, run_in};
use lightbench::assets::files::Files;
use lightbench::lab::{LdrImage, diff};
use tempfile::TempDir;

/// Pictures from other versions of the driver may differ so much (FLIP, mean). Losing one light of
/// the 64 is 0.01 or more.
const SAME_PICTURE: f64 = 0.005;
/// Two pipelines that do the same work in another order (steps of 255).
const SAME_LIGHT: u8 = 2;

fn updates() -> bool {
    std::env::var_os("LIGHTBENCH_UPDATE").is_some()
}

/// A reader with a folder.
struct Reader {
    _place: TempDir,
    project: PathBuf,
    /// The first command of the step that draws.
    draws: Vec<String>,
}

impl Reader {
    /// Does what stands before the first step.
    fn new() -> Self {
        let place = tempfile::tempdir().unwrap();
        let mut here = place.path().to_owned();
        let introduction = &sections()[0];
        for part in &introduction.parts {
            let Part::Code { text, .. } = part else {
                continue;
            };
            for line in text.lines() {
                match line.strip_prefix("cd ") {
                    Some(folder) => here = here.join(folder),
                    None => drop(run(&here, &words(line)).succeeded()),
                }
            }
        }
        assert!(here.join("lightbench.toml").exists(), "{}", here.display());
        Self {
            _place: place,
            project: here,
            draws: Vec::new(),
        }
    }

    fn run(&self, line: &str) -> Outcome {
        run(&self.project, &words(line))
    }

    fn write(&self, path: &str, text: &str) {
        fs::write(self.project.join(path), text).unwrap();
    }

    fn picture(&self, file: &str) -> LdrImage {
        open(&self.project.join("out").join(file))
    }

    /// Draws the step's picture under another name.
    fn draw(&self, file: &str) -> LdrImage {
        let out = self.draws.iter().position(|word| word == "--out").unwrap();
        let mut words = self.draws.clone();
        words[out + 1] = format!("out/{file}");
        run(&self.project, &words).succeeded();
        self.picture(file)
    }

    /// Goes through a step: its commands, its pictures, its experiments and its mistake.
    fn follow(&mut self, number: usize) {
        let section = step(number);
        let (_, right) = step_file(number);
        self.write(LIT, &right);
        let mut wrong: Option<String> = None;
        let mut said = String::new();
        for part in &section.parts {
            match part {
                Part::Code { language, text } => match language.as_str() {
                    "diff" => wrong = Some(patched(&right, text)),
                    "sh" => match wrong.take() {
                        Some(text) => {
                            self.write(LIT, &text);
                            said = self.run(text_line(&section)).failed(1, &[]).stderr;
                            self.write(LIT, &right);
                        }
                        None => self.commands(text),
                    },
                    "text" => compare_message(&section, text, &said),
                    "rhai" | "wgsl" => {}
                    other => panic!("{}: a block of {other}", section.title),
                },
                Part::Picture(file) => self.compare_picture(file),
                Part::Experiment(text) => self.experiment(text, &right),
            }
        }
    }

    fn commands(&mut self, text: &str) {
        for line in text.lines() {
            let outcome = self.run(line).succeeded();
            if self.draws.is_empty() && line.starts_with("lightbench render") {
                self.draws = words(line);
            }
            // The chapter says that the two pictures are the same bit for bit.
            if line.starts_with("lightbench diff") {
                assert!(
                    outcome.stdout.contains("Pixels that differ at all   0 %"),
                    "{}",
                    outcome.all()
                );
            }
        }
    }

    fn compare_picture(&self, link: &str) {
        let kept = folder().join(link);
        let name = link.rsplit('/').next().unwrap();
        let made = self.project.join("out").join(name);
        if updates() {
            fs::copy(&made, &kept).unwrap();
        }
        let flip = flip(&open(&kept), &open(&made));
        assert!(
            flip <= SAME_PICTURE,
            "{link} is old (FLIP {flip}): make it again with ./x docs"
        );
    }

    /// One of the things to try: a command, or a change whose picture is compared with the step's.
    fn experiment(&self, text: &str, right: &str) {
        let spans = spans(text);
        let command = spans.iter().find(|span| span.starts_with("lightbench "));
        if let Some(command) = command {
            self.run(command).succeeded();
            return;
        }
        let (_, change) = text.split_once("hange `").unwrap_or_else(|| {
            panic!("neither a command nor a change: {text}");
        });
        let (from, rest) = change.split_once("` to `").unwrap();
        let (to, _) = rest.split_once('`').unwrap();
        let shader = spans.iter().find(|span| span.starts_with("shaders/"));
        let path = shader.map_or(LIT, |path| path);
        let before = match shader {
            Some(path) => {
                self.run(&format!("lightbench copy {path}")).succeeded();
                fs::read_to_string(self.project.join(path)).unwrap()
            }
            None => right.to_owned(),
        };
        assert_eq!(before.matches(from).count(), 1, "`{from}` in {path}");
        self.write(path, &before.replace(from, to));
        let changed = self.draw("changed.png");
        self.write(path, &before);
        let plain = self.draw("plain.png");
        let furthest = furthest(&plain, &changed);
        if text.contains("stays the same") {
            assert!(furthest <= SAME_LIGHT, "{text}: {furthest}");
        } else {
            let flip = flip(&plain, &changed);
            assert!(flip > 0.02, "nobody sees it: {text}: {flip}");
        }
    }
}

/// The command of the section's mistake, which is its last one.
fn text_line(section: &Section) -> &str {
    let mut last = "";
    for part in &section.parts {
        if let Part::Code { language, text } = part
            && language == "sh"
        {
            last = text.trim();
        }
    }
    last
}

fn run(folder: &Path, words: &[String]) -> Outcome {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    assert_eq!(words[0], "lightbench", "{words:?}");
    run_in(folder, &words[1..], &[])
}

fn words(line: &str) -> Vec<String> {
    line.split_whitespace().map(str::to_owned).collect()
}

/// Takes the lines with `-` out of a text and puts those with `+` there.
fn patched(text: &str, patch: &str) -> String {
    let side = |sign: char| -> String {
        let lines = patch.lines().filter_map(|line| line.strip_prefix(sign));
        lines.map(|line| format!("{line}\n")).collect()
    };
    let (old, new) = (side('-'), side('+'));
    assert_eq!(text.matches(&old).count(), 1, "{old}");
    text.replace(&old, &new)
}

fn compare_message(section: &Section, quoted: &str, said: &str) {
    if quoted == said {
        return;
    }
    assert!(
        updates(),
        "{}: the program says now\n{said}\nand the chapter has\n{quoted}\nwrite it anew with \
         ./x docs",
        section.title
    );
    let path = chapter_support::path();
    let chapter = fs::read_to_string(&path).unwrap();
    let (before, rest) = chapter.split_once(&section.title).unwrap();
    let (old, new) = (
        format!("```text\n{quoted}```"),
        format!("```text\n{said}```"),
    );
    let chapter = format!("{before}{}{}", section.title, rest.replacen(&old, &new, 1));
    fs::write(path, chapter).unwrap();
}

fn open(path: &Path) -> LdrImage {
    let picture = image::ImageReader::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .decode()
        .unwrap()
        .into_rgba8();
    let pixels = picture.pixels().map(|pixel| pixel.0).collect();
    LdrImage::new(picture.width(), picture.height(), pixels).unwrap()
}

fn flip(a: &LdrImage, b: &LdrImage) -> f64 {
    let difference = diff::diff_ldr(a, b, diff::DiffOptions::default()).unwrap();
    difference.difference.flip.mean
}

/// The largest difference of a channel.
fn furthest(a: &LdrImage, b: &LdrImage) -> u8 {
    let channels = |image: &LdrImage| image.pixels.as_flattened().to_vec();
    let pairs = channels(a).into_iter().zip(channels(b));
    pairs.map(|(a, b)| a.abs_diff(b)).max().unwrap()
}

#[test]
fn step_1_can_be_followed() {
    Reader::new().follow(1);
}

#[test]
fn step_2_can_be_followed() {
    Reader::new().follow(2);
}

#[test]
fn step_3_can_be_followed() {
    Reader::new().follow(3);
}

#[test]
fn step_4_can_be_followed() {
    Reader::new().follow(4);
}

#[test]
fn step_5_can_be_followed() {
    Reader::new().follow(5);
}

#[test]
fn step_6_can_be_followed() {
    Reader::new().follow(6);
}

#[test]
fn step_7_can_be_followed() {
    Reader::new().follow(7);
}

#[test]
fn each_step_is_short_and_has_all_its_parts() {
    let steps = sections();
    let steps = steps.iter().filter(|s| s.title.starts_with("Step "));
    assert_eq!(steps.clone().count(), 7);
    for (index, section) in steps.enumerate() {
        let (path, text) = step_file(index + 1);
        let lines = text.lines().count();
        assert!(lines <= 45, "{path} has {lines} lines");
        let count = |wanted: &dyn Fn(&Part) -> bool| {
            section.parts.iter().filter(|part| wanted(part)).count()
        };
        let code = |wanted: &'static str| {
            count(&|part| matches!(part, Part::Code { language, .. } if language == wanted))
        };
        let title = &section.title;
        assert_eq!(count(&|p| matches!(p, Part::Experiment(_))), 3, "{title}");
        assert!(count(&|p| matches!(p, Part::Picture(_))) >= 1, "{title}");
        assert!(code("rhai") >= 1 && code("sh") >= 2, "{title}");
        assert_eq!((code("diff"), code("text")), (1, 1), "{title}");
        assert!(section.text.contains("\n> "), "{title} has no equation");
    }
}

#[test]
fn every_listing_is_literally_in_the_step_s_files() {
    for number in 1..=7 {
        let section = step(number);
        let (path, pipeline) = step_file(number);
        let shaders: Vec<String> = spans(&section.text)
            .into_iter()
            .filter(|span| span.starts_with("shaders/from_empty/"))
            .map(|path| Files::shipped().read_text(path).unwrap())
            .collect();
        for part in &section.parts {
            let Part::Code { language, text } = part else {
                continue;
            };
            match language.as_str() {
                "rhai" => assert!(pipeline.contains(text.as_str()), "{path} has no\n{text}"),
                "wgsl" => assert!(
                    shaders.iter().any(|shader| shader.contains(text.as_str())),
                    "no shader of step {number} has\n{text}"
                ),
                _ => {}
            }
        }
        // Everything that is new in the pipeline is quoted.
        for line in marked(&pipeline) {
            let quoted = section.parts.iter().any(|part| {
                matches!(part, Part::Code { language, text } if language == "rhai"
                    && text.lines().any(|quoted| quoted == line))
            });
            assert!(quoted, "step {number} does not quote\n{line}");
        }
    }
}

/// The lines that are marked as new: those that end in `// new`, perhaps with a colon and more, and
/// those below a comment that begins with `// New:`, up to an empty line.
fn marked(text: &str) -> Vec<&str> {
    let mut marked = Vec::new();
    let mut in_block = false;
    for line in text.lines() {
        in_block = (in_block && !line.is_empty()) || line.starts_with("// New:");
        let alone = line
            .rsplit_once("// new")
            .is_some_and(|(_, rest)| rest.is_empty() || rest.starts_with(':'));
        if in_block || alone {
            marked.push(line);
        }
    }
    marked
}

/// Marks are neither forgotten nor left over from the step before.
#[test]
fn the_marks_are_on_what_is_new() {
    let code = |line: &str| line.split("//").next().unwrap_or("").trim().to_owned();
    let mut before: BTreeSet<String> = BTreeSet::new();
    for number in 1..=7 {
        let (path, text) = step_file(number);
        let marks = marked(&text);
        for line in text.lines() {
            let is_new = !before.contains(&code(line));
            let title = line.contains("= pipeline(");
            if is_new && !title && !code(line).is_empty() && code(line) != "p" {
                assert!(marks.contains(&line), "{path}: this is new: {line}");
            }
            if line.contains("// new") {
                assert!(is_new, "{path}: this is not new: {line}");
            }
        }
        before = text.lines().map(code).collect();
    }
}
