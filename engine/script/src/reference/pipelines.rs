//! The reference of pipeline files.

use std::fmt::Write as _;

use lightbench_assets::files::{FileError, Files};
use lightbench_render::Format;
use lightbench_render::binding::provided;
use lightbench_render::heat_map::HeatMap;
use lightbench_render::reflection::SampleKind;

use super::functions::{Function, functions};
use super::parts::{parts, parts_row};
use super::probe::{Probe, told};

/// A part of the page: its heading, which is also that of the functions' registration, and what
/// stands before the functions.
const BEFORE_KINDS: [(&str, &str); 5] = [
    ("Pipelines", include_str!("prose/pipelines.txt")),
    ("Parameters", include_str!("prose/parameters.txt")),
    ("Targets", include_str!("prose/targets.txt")),
    ("Buffers and counters", include_str!("prose/buffers.txt")),
    (PASSES, include_str!("prose/passes.txt")),
];
const AFTER_KINDS: [(&str, &str); 6] = [
    ("The shader", include_str!("prose/shader.txt")),
    ("What is drawn", include_str!("prose/drawn.txt")),
    (
        "What the shader reads and updates",
        include_str!("prose/resources.txt"),
    ),
    ("Colour targets", include_str!("prose/colours.txt")),
    ("Depth and stencil", include_str!("prose/depth.txt")),
    (
        "Changing another pipeline",
        include_str!("prose/changing.txt"),
    ),
];
const PASSES: &str = "Passes";

/// What is said of each kind of pass, besides its methods.
pub(super) const KINDS: [(&str, &str); 10] = [
    ("geometry", include_str!("prose/kinds/geometry.txt")),
    ("lights", include_str!("prose/kinds/lights.txt")),
    ("shadow", include_str!("prose/kinds/shadow.txt")),
    ("fullscreen", include_str!("prose/kinds/fullscreen.txt")),
    ("compute", include_str!("prose/kinds/compute.txt")),
    ("clear", include_str!("prose/kinds/clear.txt")),
    ("copy", include_str!("prose/kinds/copy.txt")),
    ("resolve", include_str!("prose/kinds/resolve.txt")),
    ("mips", include_str!("prose/kinds/mips.txt")),
    ("history", include_str!("prose/kinds/history.txt")),
];

/// The pipeline in which the mistakes of the page are made, where the comment stands.
const BENCH: &str = r#"let p = pipeline("Mine");
p.target("depth", "depth32float");
p.target("hdr", "rgba16float");
p.target("output", "rgba8unorm");
p.clear("begin")
    .writes("hdr").clear(0, 0, 0, 0)
    .writes("output").clear(0, 0, 0, 1)
    .depth("depth").clear(0.0);
// The mistake stands here.
p.show("output");
p
"#;
const MISTAKE: &str = "// The mistake stands here.";

/// Where the complete examples lie, one for each kind of pass.
pub(super) const EXAMPLES: &str = "scripts/pipelines/examples";

/// The page, as Markdown.
///
/// # Errors
/// An example that can't be read.
pub fn pipelines(files: &Files) -> Result<String, FileError> {
    let probe = Probe::new();
    let functions = functions(&probe);
    let page = Page {
        files,
        probe: &probe,
        functions: &functions,
    };
    page.write()
}

struct Page<'a> {
    files: &'a Files,
    probe: &'a Probe,
    functions: &'a [Function],
}

impl Page<'_> {
    fn write(&self) -> Result<String, FileError> {
        let mut text = String::from(
            "# Pipeline files: the reference\n\n\
             <!-- Written by `lightbench docs pipelines`. Change the texts in engine/script/src \
             instead. -->\n\n",
        );
        text += &self.prose(include_str!("prose/introduction.txt"));
        text += &self.overview();
        text += &parts_row(self.files)?;
        for (title, prose) in BEFORE_KINDS {
            self.section(&mut text, title, prose);
        }
        for kind in self.probe.kinds() {
            self.kind(&mut text, kind)?;
        }
        for (title, prose) in AFTER_KINDS {
            self.section(&mut text, title, prose);
        }
        for title in self.other_sections() {
            self.section(&mut text, title, "");
        }
        text += &parts(self.files)?;
        Ok(text)
    }

    /// Headings of functions that the page knows nothing else of.
    fn other_sections(&self) -> Vec<&str> {
        let mut others: Vec<&str> = Vec::new();
        for function in self.functions {
            let known = BEFORE_KINDS.iter().chain(&AFTER_KINDS);
            let known = known
                .into_iter()
                .any(|(title, _)| *title == function.section);
            if !known && function.only_kind().is_none() && !others.contains(&function.section) {
                others.push(function.section);
            }
        }
        others
    }

    /// A table of all headings with the names below them.
    fn overview(&self) -> String {
        let mut text = String::from("\n| part | functions |\n| --- | --- |\n");
        let mut row = |title: &str, link: &str, names: Vec<&Function>| {
            let names: Vec<String> = names.iter().map(|f| format!("`{}`", f.short())).collect();
            // What is there in two forms is named once.
            let mut once: Vec<String> = Vec::new();
            once.extend(names.into_iter().filter(|name| name != "``"));
            once.dedup();
            // Writing to a text can't fail.
            let _ = writeln!(text, "| [{title}](#{link}) | {} |", once.join(", "));
        };
        for (title, _) in BEFORE_KINDS {
            row(title, &anchor(title), self.in_section(title));
        }
        for kind in self.probe.kinds() {
            row(
                &format!("`{kind}` passes"),
                &anchor(&format!("{kind} passes")),
                self.of_kind(kind),
            );
        }
        for (title, _) in AFTER_KINDS {
            row(title, &anchor(title), self.in_section(title));
        }
        for title in self.other_sections() {
            row(title, &anchor(title), self.in_section(title));
        }
        text
    }

    /// The functions under a heading, but for those of one kind of pass.
    fn in_section(&self, title: &str) -> Vec<&Function> {
        let all = self.functions.iter();
        all.filter(|f| f.section == title && f.only_kind().is_none())
            .collect()
    }

    /// The functions that belong to one kind of pass: those that begin it first.
    fn of_kind(&self, kind: &str) -> Vec<&Function> {
        let all = self.functions.iter();
        all.filter(|f| f.only_kind() == Some(kind)).collect()
    }

    fn section(&self, text: &mut String, title: &str, prose: &str) {
        let _ = write!(text, "\n## {title}\n\n{}", self.prose(prose));
        for function in self.in_section(title) {
            *text += &function.markdown(self.probe);
        }
    }

    fn kind(&self, text: &mut String, kind: &str) -> Result<(), FileError> {
        let prose = KINDS.iter().find(|(known, _)| *known == kind);
        let _ = write!(
            text,
            "\n## `{kind}` passes\n\n{}",
            self.prose(prose.map_or("", |(_, prose)| prose))
        );
        *text += &self.shared(kind);
        let example = format!("{EXAMPLES}/{kind}.rhai");
        if self.files.exists(&example) {
            *text += &self.example(&example)?;
        }
        for function in self.of_kind(kind) {
            *text += &function.markdown(self.probe);
        }
        Ok(())
    }

    /// The methods of several kinds that this kind takes.
    fn shared(&self, kind: &str) -> String {
        let mut text = String::new();
        for (title, _) in AFTER_KINDS {
            let takes = |f: &&&Function| f.findings.kinds.contains(kind);
            let mut names: Vec<String> = Vec::new();
            for function in self.in_section(title).iter().filter(takes) {
                let name = format!("`{}`", function.short());
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            if !names.is_empty() {
                let _ = writeln!(
                    text,
                    "- [{title}](#{}): {}",
                    anchor(title),
                    names.join(", ")
                );
            }
        }
        if text.is_empty() {
            return text;
        }
        format!("\nIt takes these methods, which other kinds have too:\n\n{text}")
    }

    /// A whole pipeline and the shaders that it brings.
    fn example(&self, path: &str) -> Result<String, FileError> {
        let pipeline = self.files.read_text(path)?;
        let mut text = format!("\nA whole pipeline, `{path}`:\n\n```rhai\n{pipeline}```\n");
        let paths = pipeline.split('"').skip(1).step_by(2);
        for shader in paths.filter(|path| path.starts_with("shaders/examples/")) {
            let wgsl = self.files.read_text(shader)?;
            let _ = write!(text, "\nIts shader, `{shader}`:\n\n```wgsl\n{wgsl}```\n");
        }
        Ok(text)
    }

    /// Puts what the program knows into the blocks of a text: a mistake's message below it, the
    /// bench of the mistakes, the tables.
    fn prose(&self, prose: &str) -> String {
        let mut text = String::new();
        let mut block = Block::None;
        for line in prose.lines() {
            match (line, &mut block) {
                ("```rhai mistake", _) => {
                    block = Block::Mistake(String::new());
                    text += "```rhai\n";
                }
                ("```rhai bench", _) => {
                    text += "```rhai\n";
                    text += BENCH;
                }
                ("```formats", _) => {
                    block = Block::Table;
                    text += &formats();
                }
                ("```provided", _) => {
                    block = Block::Table;
                    text += &provided_table();
                }
                ("```heat_maps", _) => {
                    block = Block::Table;
                    text += &heat_maps();
                }
                ("```", Block::Table) => block = Block::None,
                ("```", Block::Mistake(snippet)) => {
                    let problems = self.probe.problems(&BENCH.replace(MISTAKE, snippet));
                    let said: Vec<String> = problems.iter().map(told).collect();
                    let _ = writeln!(text, "```\n\n```text\n{}\n```", said.join("\n"));
                    block = Block::None;
                }
                (line, block) => {
                    if let Block::Mistake(snippet) = block {
                        snippet.push_str(line);
                        snippet.push('\n');
                    }
                    text += line;
                    text.push('\n');
                }
            }
        }
        text
    }
}

/// What a line of prose stands in.
enum Block {
    /// Nothing that the program adds to.
    None,
    /// Lines with a mistake, so far.
    Mistake(String),
    /// The place of a table.
    Table,
}

/// The formats that a target may have.
fn formats() -> String {
    let mut text = String::from("| format | bytes | numbers |\n| --- | --- | --- |\n");
    for name in Format::names() {
        if let Some(format) = Format::from_name(&name) {
            let kind = SampleKind::of_format(format.0).in_words();
            let _ = writeln!(text, "| `{name}` | {} | {kind} |", format.bytes_per_texel());
        }
    }
    text
}

/// What a shader finds in group 1 without a word of the pipeline.
fn provided_table() -> String {
    let mut text = String::from("| declared as | it |\n| --- | --- |\n");
    for thing in provided() {
        let _ = writeln!(text, "| `{}` | {} |", thing.declaration, thing.about);
    }
    text
}

/// What can take the picture's place.
fn heat_maps() -> String {
    let mut text = String::from("| `heat_map` | counts |\n| --- | --- |\n");
    for (name, map) in HeatMap::NAMES {
        let _ = writeln!(text, "| `{name}` | {} |", map.title());
    }
    text
}

/// The link to a heading, as GitHub makes it.
fn anchor(title: &str) -> String {
    title.to_lowercase().replace(' ', "-")
}
