//! Finds out what a function takes and what it refuses, by calling it.
//!
//! Ranges, choices, defaults and messages are those that a student meets, so they can't differ from
//! the code.

mod arguments;
mod sites;

use std::collections::BTreeSet;

use lightbench_assets::files::Files;
use lightbench_render::validate::validate;
use lightbench_render::{PipelineDesc, Problem, Problems};

use super::adapter::EveryAdapter;
use crate::limits::Limits;
use crate::names::Entry;
use crate::pipeline::Workshop;
use crate::settings::Settings;
use arguments::{Argument, values, with_other_texts};
use sites::{Site, call};

/// The file that messages name.
pub(in crate::reference) const PATH: &str = "scripts/pipelines/mine.rhai";

/// What stands before each call that is tried: one thing of every sort by the name `known`.
const BEFORE: &str = r#"let p = pipeline("Mine");
p.number("known", 0, 0, 1);
p.target("known", "rgba16float");
p.target("known_depth", "depth32float-stencil8");
p.buffer("known_buffer", 4);
p.clear("known").writes("known").clear(0, 0, 0, 0).depth("known_depth").clear(0);
"#;

/// What was found out about a form of a function.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(in crate::reference) struct Findings {
    pub(in crate::reference) arguments: Vec<Argument>,
    /// The arguments that change nothing.
    pub(in crate::reference) default: Option<String>,
    /// Messages, each with its help.
    pub(in crate::reference) refusals: Vec<String>,
    /// For methods of passes: the kinds that take them.
    pub(in crate::reference) kinds: BTreeSet<String>,
    /// For methods of the pipeline that begin a pass: its kind.
    pub(in crate::reference) begins: Option<String>,
}

/// Calls functions in pipelines of its own.
pub(in crate::reference) struct Probe {
    workshop: Workshop,
    /// How to begin a pass of each kind.
    begins: Vec<(String, String)>,
}

impl Probe {
    pub(in crate::reference) fn new() -> Self {
        let files = Files::shipped();
        let workshop = Workshop::new(&files, PATH, &Settings::new(), &Limits::default());
        let mut probe = Self {
            workshop,
            begins: Vec::new(),
        };
        for entry in probe.entries() {
            if let Some(kind) = probe.findings(&entry).begins
                && !probe.begins.iter().any(|(known, _)| *known == kind)
            {
                let arguments = probe.arguments(&entry, &probe.sites(&entry));
                probe
                    .begins
                    .push((kind, call("p", &entry, &values(&arguments))));
            }
        }
        probe
    }

    /// Every form that pipeline files have beyond mathematics, in the order of registration.
    pub(in crate::reference) fn entries(&self) -> Vec<Entry> {
        let entries = self.workshop.names().entries().iter();
        entries
            .filter(|entry| !entry.section.is_empty())
            .cloned()
            .collect()
    }

    /// The kinds of passes, in the order of registration.
    pub(in crate::reference) fn kinds(&self) -> impl Iterator<Item = &str> {
        self.begins.iter().map(|(kind, _)| kind.as_str())
    }

    /// The mistakes of a text, with and without the checks of the whole description.
    pub(in crate::reference) fn problems(&self, text: &str) -> Vec<Problem> {
        let checked = self.workshop.run_text(text);
        let checked = checked.and_then(|desc| validate(&desc, &EveryAdapter));
        checked
            .err()
            .map_or_else(Vec::new, |Problems(problems)| problems)
    }

    /// Finds out all about a form.
    pub(in crate::reference) fn findings(&self, entry: &Entry) -> Findings {
        let sites = self.sites(entry);
        let arguments = self.arguments(entry, &sites);
        let mut findings = Findings {
            refusals: self.refusals(entry, &sites, &arguments),
            kinds: self.takers(entry, &sites, &arguments),
            ..Findings::default()
        };
        if entry.receiver == Some("pipeline") {
            let made = self.run(&call("p", entry, &values(&arguments)));
            // The first pass is there already.
            let pass = made.ok().and_then(|desc| desc.passes.into_iter().nth(1));
            findings.begins = pass.map(|pass| pass.kind.name().to_owned());
        }
        findings.default = self.default(entry, &sites, &arguments);
        findings.arguments = arguments;
        findings
    }

    /// Runs one line after those of [`BEFORE`].
    fn run(&self, line: &str) -> Result<PipelineDesc, Problems> {
        self.workshop.run_text(&format!("{BEFORE}{line};\np"))
    }

    /// What is wrong with the line.
    fn mistake(&self, line: &str) -> Option<Problem> {
        let Problems(problems) = self.run(line).err()?;
        let at = BEFORE.lines().count() as u32 + 1;
        problems
            .into_iter()
            .find(|problem| problem.place.line >= at)
    }

    /// Whether the checks of the whole description find something in a line that they do not find in
    /// the beginning of it.
    fn adds_problems(&self, beginning: &str, line: &str) -> bool {
        let check = |line: &str| {
            let made = self.run(line);
            let checked = made.and_then(|desc| validate(&desc, &EveryAdapter));
            checked
                .err()
                .map_or_else(Vec::new, |Problems(problems)| problems)
        };
        let (without, with) = (check(beginning), check(line));
        let at = BEFORE.lines().count() as u32 + 1;
        let is_new = |problem: &&Problem| {
            let known = without.iter().any(|other| other.message == problem.message);
            problem.place.line == at && !known
        };
        with.iter().any(|problem| is_new(&problem))
    }

    /// Messages beyond those of a value of the wrong kind or outside its range.
    fn refusals(&self, entry: &Entry, sites: &[Site], arguments: &[Argument]) -> Vec<String> {
        let mut lines = Vec::new();
        let right = values(arguments);
        for site in sites.iter().filter(|site| site.behind.is_empty()) {
            // Right values in the wrong place, and the same twice.
            let once = call(&site.before, entry, &right);
            lines.push(once.clone());
            lines.push(match entry.receiver {
                Some("pass" | "target" | "buffer") => call(&once, entry, &right),
                Some(_) => format!("{once}; {once}"),
                None => continue,
            });
            for (index, argument) in arguments.iter().enumerate() {
                let wrong: &[&str] = match argument.takes.as_str() {
                    "a text" => &["\"?\""],
                    "a number" => &["100"],
                    "an array of texts" => &["[]", "[\"a\", \"a\"]"],
                    _ => &[],
                };
                for value in wrong {
                    let mut values = right.clone();
                    values[index] = (*value).to_owned();
                    lines.push(call(&site.before, entry, &values) + site.behind);
                }
            }
        }
        let mut refusals = Vec::new();
        // Messages that differ in names only are one.
        let mut seen = BTreeSet::new();
        for line in lines {
            let Some(problem) = self.mistake(&line) else {
                continue;
            };
            // That a method belongs to another kind is said once for all.
            let text = told(&problem);
            if !text.contains("belongs to a") && seen.insert(without_names(&problem.message)) {
                refusals.push(text);
            }
        }
        refusals
    }

    /// The kinds of passes that take a method.
    fn takers(&self, entry: &Entry, sites: &[Site], arguments: &[Argument]) -> BTreeSet<String> {
        let line = |site: &Site, arguments: &[Argument]| {
            call(&site.before, entry, &values(arguments)) + site.behind
        };
        let builds = |site: &&Site| self.mistake(&line(site, arguments)).is_none();
        let built: Vec<&Site> = sites.iter().filter(builds).collect();
        let mut kinds = BTreeSet::new();
        for arguments in with_other_texts(arguments) {
            let useful = built.iter().filter(|site| {
                let line = line(site, &arguments);
                self.mistake(&line).is_none() && !self.adds_problems(&site.before, &line)
            });
            kinds.extend(useful.map(|site| site.kind.clone()));
        }
        // What needs more than a line to make sense is judged by the builder alone.
        if kinds.is_empty() {
            kinds.extend(built.into_iter().map(|site| site.kind.clone()));
        }
        kinds
    }

    /// The arguments with which a call changes nothing: those of the text's `Default:`, or the choice
    /// or switch that does so.
    fn default(&self, entry: &Entry, sites: &[Site], arguments: &[Argument]) -> Option<String> {
        if !matches!(entry.receiver, Some("pass" | "target" | "buffer")) {
            return None;
        }
        let mut options = Vec::new();
        if let Some(said) = default_said(entry.about) {
            options.push(said.to_owned());
        } else if let [only] = arguments {
            let names = only.takes.split('`').skip(1).step_by(2);
            options.extend(names.map(|name| match name {
                "true" | "false" => name.to_owned(),
                name => format!("\"{name}\""),
            }));
        }
        for site in sites {
            let Ok(without) = self.run(&site.before) else {
                continue;
            };
            let same = |option: &&String| {
                let with = self.run(&call(&site.before, entry, std::slice::from_ref(*option)));
                with.is_ok_and(|with| with == without)
            };
            if let Some(option) = options.iter().find(same) {
                return Some(option.clone());
            }
        }
        None
    }
}

/// The arguments after `Default:` in a text.
pub(in crate::reference) fn default_said(about: &str) -> Option<&str> {
    about.split_once("Default: `")?.1.split('`').next()
}

/// A message without what stands in back quotes, and without numbers of lines.
fn without_names(message: &str) -> String {
    message.split('`').step_by(2).collect()
}

/// A message with its help.
pub(in crate::reference) fn told(problem: &Problem) -> String {
    match &problem.hint {
        Some(hint) => format!("{}\n    help: {hint}", problem.message),
        None => problem.message.clone(),
    }
}
