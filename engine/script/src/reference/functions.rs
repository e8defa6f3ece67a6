//! The functions of pipeline files, each with what the probe found out about it.

use std::fmt::Write as _;

use super::probe::{Findings, Probe};
use crate::names::Entry;

/// What a text is that names something, by the name of its argument; with a function's name before
/// it, of that function alone.
const TEXTS: [(&str, &str); 16] = [
    ("reads.target", "the name of a target or buffer"),
    ("updates.target", "the name of a target or buffer"),
    ("copy.from", "the name of a target or buffer"),
    ("copy.to", "the name of a target or buffer"),
    ("buffer", "the name of a buffer"),
    ("counter", "the name of a counter"),
    ("format", "the name of a format"),
    ("from", "the name of a target"),
    ("name", "a name"),
    ("parameter", "the name of a parameter"),
    ("path", "a path"),
    ("target", "the name of a target"),
    ("to", "the name of a target"),
    ("variable", "a name"),
    ("ability", "a name"),
    ("channels", "letters of `rgba`"),
];

/// Where the longest help of a message is cut.
const HELP: usize = 120;

/// A function with all forms that have one text.
pub(super) struct Function {
    /// The shortest form first.
    forms: Vec<Entry>,
    /// Of the longest form.
    pub(super) findings: Findings,
    pub(super) section: &'static str,
}

/// All functions, in the order of registration.
pub(super) fn functions(probe: &Probe) -> Vec<Function> {
    let mut functions: Vec<Function> = Vec::new();
    for entry in probe.entries() {
        let findings = probe.findings(&entry);
        let section = entry.section;
        match functions.last_mut() {
            Some(last) if last.is_form(&entry) => {
                last.forms.push(entry);
                last.findings = findings;
            }
            _ => functions.push(Function {
                forms: vec![entry],
                findings,
                section,
            }),
        }
    }
    functions
}

impl Function {
    fn is_form(&self, entry: &Entry) -> bool {
        self.forms.iter().any(|form| {
            (form.receiver, &form.name, form.about) == (entry.receiver, &entry.name, entry.about)
        })
    }

    /// The kind of pass that it begins or that alone has it.
    pub(super) fn only_kind(&self) -> Option<&str> {
        let begins = self.findings.begins.as_deref();
        let mut kinds = self.findings.kinds.iter();
        let only = kinds.next().filter(|kind| !kind.is_empty());
        begins.or_else(|| only.filter(|_| kinds.next().is_none()).map(String::as_str))
    }

    /// The name as one calls it: `p.target`, `.scale`, `pipeline`.
    pub(super) fn short(&self) -> String {
        let name = self.name();
        match self.receiver() {
            Some("pipeline") => format!("p.{name}"),
            Some(_) => format!(".{name}"),
            None => name.to_owned(),
        }
    }

    fn name(&self) -> &str {
        self.forms.first().map_or("", |form| form.name.as_str())
    }

    fn receiver(&self) -> Option<&'static str> {
        self.forms.first().and_then(|form| form.receiver)
    }

    /// Its part of the page.
    pub(super) fn markdown(&self, probe: &Probe) -> String {
        let forms = self.forms.iter().map(|form| match form.receiver {
            Some("pipeline") => format!("`p{}`", form.form()),
            _ => format!("`{}`", form.form()),
        });
        let about = self.forms.first().map_or("", |form| form.about);
        let (about, _) = about.split_once(" Default: `").unwrap_or((about, ""));
        let mut text = format!("\n### {}\n\n", forms.collect::<Vec<_>>().join(", "));
        text += &wrapped(about);
        let mut rows = String::new();
        for argument in &self.findings.arguments {
            let here = format!("{}.{}", self.name(), argument.name);
            let named = |name: &str| TEXTS.iter().find(|(known, _)| *known == name);
            let named = named(&here).or_else(|| named(&argument.name));
            let takes = match (argument.takes.as_str(), named) {
                ("a text", Some((_, takes))) => takes,
                (takes, _) => takes,
            };
            // Writing to a text can't fail.
            let _ = writeln!(rows, "- `{}`: {takes}", argument.name);
        }
        if let Some(default) = &self.findings.default {
            let _ = writeln!(rows, "- default: `{default}`");
        }
        let all = probe.kinds().count();
        if self.receiver() == Some("pass") && (2..all).contains(&self.findings.kinds.len()) {
            let kinds: Vec<&str> = probe
                .kinds()
                .filter(|kind| self.findings.kinds.contains(*kind))
                .collect();
            let _ = writeln!(rows, "- passes: `{}`", kinds.join("`, `"));
        }
        if !rows.is_empty() {
            text += &format!("\n{rows}");
        }
        if !self.findings.refusals.is_empty() {
            let refusals = self.findings.refusals.iter().map(|text| shortened(text));
            let refusals: Vec<String> = refusals.collect();
            text += &format!("\nRefused with:\n\n```text\n{}\n```\n", refusals.join("\n"));
        }
        text
    }
}

/// A message whose help is cut where it lists very much.
fn shortened(message: &str) -> String {
    let lines = message
        .lines()
        .map(|line| match line.char_indices().nth(HELP) {
            Some((end, _)) => {
                let kept = line[..end].rfind(", ").unwrap_or(end);
                format!("{}, …", &line[..kept])
            }
            None => line.to_owned(),
        });
    lines.collect::<Vec<_>>().join("\n")
}

/// A paragraph, or an item of a list, in lines of at most 100 letters.
pub(super) fn wrapped(paragraph: &str) -> String {
    let mut text = String::new();
    let mut column = 0;
    let indent = if paragraph.starts_with("- ") {
        "  "
    } else {
        ""
    };
    for word in paragraph.split_whitespace() {
        let letters = word.chars().count();
        if column > 0 && column + 1 + letters > 100 {
            text.push('\n');
            text += indent;
            column = indent.len();
        } else if column > 0 {
            text.push(' ');
            column += 1;
        }
        text += word;
        column += letters;
    }
    text.push('\n');
    text
}
