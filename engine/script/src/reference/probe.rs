//! Finds out what a function takes and what it refuses, by calling it.
//!
//! Ranges, choices, defaults and messages are those that a student meets, so they can't differ from
//! the code.

use std::collections::BTreeSet;

use lightbench_assets::files::Files;
use lightbench_render::validate::validate;
use lightbench_render::{PipelineDesc, Problem, Problems};

use super::adapter::EveryAdapter;
use crate::limits::Limits;
use crate::names::Entry;
use crate::pipeline::Workshop;
use crate::settings::Settings;

/// The file that messages name.
pub(super) const PATH: &str = "scripts/pipelines/mine.rhai";

/// What stands before each call that is tried: one thing of every sort by the name `known`.
const BEFORE: &str = r#"let p = pipeline("Mine");
p.number("known", 0, 0, 1);
p.target("known", "rgba16float");
p.target("known_depth", "depth32float-stencil8");
p.buffer("known_buffer", 4);
p.clear("known").writes("known").clear(0, 0, 0, 0).depth("known_depth").clear(0);
"#;

/// Texts to try where a function takes one.
const TEXTS: [&str; 8] = [
    "fresh",
    "a",
    "known",
    "known_depth",
    "known_buffer",
    "shaders/known.wgsl",
    "rgba16float",
    "rgb",
];

/// What may have to stand before a pass's method, and behind it.
const AROUND: [(&str, &str); 14] = [
    ("", ""),
    ("", ".clear(0, 0, 0, 0)"),
    ("", ".clear(0)"),
    (".shader(\"shaders/known.wgsl\")", ""),
    (".shader(\"shaders/known.wgsl\")", ".clear(0, 0, 0, 0)"),
    (".shader(\"shaders/known.wgsl\").writes(\"known\")", ""),
    (
        ".shader(\"shaders/known.wgsl\").writes(\"known\").depth(\"known_depth\")",
        "",
    ),
    (
        ".shader(\"shaders/known.wgsl\").writes(\"known\").depth(\"known_depth\")\
         .stencil(\"always\", 0)",
        "",
    ),
    (".writes(\"known\").clear(0, 0, 0, 0)", ""),
    (".depth(\"known_depth\").clear(0)", ""),
    (".reads(\"known\")", ""),
    (".updates(\"known_buffer\")", ""),
    (
        ".updates(\"known_buffer\").depth(\"known_depth\").clear(0)",
        "",
    ),
    (".repeat_for_lights(1)", ""),
];

/// One argument of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Argument {
    pub(super) name: String,
    /// "a number from 0 to 1"; empty where any value is taken.
    pub(super) takes: String,
    /// A value that is right.
    value: String,
}

/// What was found out about a form of a function.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Findings {
    pub(super) arguments: Vec<Argument>,
    /// The arguments that change nothing.
    pub(super) default: Option<String>,
    /// Messages, each with its help.
    pub(super) refusals: Vec<String>,
    /// For methods of passes: the kinds that take them.
    pub(super) kinds: BTreeSet<String>,
    /// For methods of the pipeline that begin a pass: its kind.
    pub(super) begins: Option<String>,
}

/// Calls functions in pipelines of its own.
pub(super) struct Probe {
    workshop: Workshop,
    /// How to begin a pass of each kind.
    begins: Vec<(String, String)>,
}

/// Where a call is made: what stands before it and behind it.
#[derive(Clone, Debug)]
struct Site {
    kind: String,
    before: String,
    behind: &'static str,
}

impl Probe {
    pub(super) fn new() -> Self {
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
    pub(super) fn entries(&self) -> Vec<Entry> {
        let entries = self.workshop.names().entries().iter();
        entries
            .filter(|entry| !entry.section.is_empty())
            .cloned()
            .collect()
    }

    /// The kinds of passes, in the order of registration.
    pub(super) fn kinds(&self) -> impl Iterator<Item = &str> {
        self.begins.iter().map(|(kind, _)| kind.as_str())
    }

    /// The mistakes of a text, with and without the checks of the whole description.
    pub(super) fn problems(&self, text: &str) -> Vec<Problem> {
        let checked = self.workshop.run_text(text);
        let checked = checked.and_then(|desc| validate(&desc, &EveryAdapter));
        checked
            .err()
            .map_or_else(Vec::new, |Problems(problems)| problems)
    }

    /// Finds out all about a form.
    pub(super) fn findings(&self, entry: &Entry) -> Findings {
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

    /// What stands before a call of that form.
    fn sites(&self, entry: &Entry) -> Vec<Site> {
        let one = |before: &str| {
            vec![Site {
                kind: String::new(),
                before: before.to_owned(),
                behind: "",
            }]
        };
        match entry.receiver {
            Some("pipeline") => one("p"),
            Some("target") => one("p.target(\"fresh\", \"rgba16float\")"),
            Some("buffer") => one("p.buffer(\"fresh\", 4)"),
            Some("pass") => {
                let site = |(kind, begin): &(String, String), (before, behind)| Site {
                    kind: kind.clone(),
                    before: format!("{begin}{before}"),
                    behind,
                };
                let around = |begin| AROUND.map(|around| site(begin, around));
                let sites = self.begins.iter().flat_map(around);
                let sound = |site: &Site| {
                    let begin = self.begins.iter().find(|(kind, _)| *kind == site.kind);
                    let bare = begin.map_or("", |(_, begin)| begin.as_str());
                    self.mistake(&site.before).is_none() && !self.adds_problems(bare, &site.before)
                };
                sites.filter(sound).collect()
            }
            _ => one(""),
        }
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

    /// What each argument takes, found with the first site that has a right value for all of them.
    fn arguments(&self, entry: &Entry, sites: &[Site]) -> Vec<Argument> {
        let mut best = Vec::new();
        for site in sites {
            let arguments = self.arguments_at(entry, site);
            let fits = |arguments: &Vec<Argument>| {
                let line = call(&site.before, entry, &values(arguments)) + site.behind;
                arguments.len() == entry.arguments.len() && self.mistake(&line).is_none()
            };
            if let Some(right) = with_other_texts(&arguments).find(fits) {
                return right;
            }
            if arguments.len() > best.len() {
                best = arguments;
            }
        }
        best
    }

    fn arguments_at(&self, entry: &Entry, site: &Site) -> Vec<Argument> {
        let mut found: Vec<Argument> = Vec::new();
        for name in &entry.arguments {
            // Wrong values from here on: the first of them is complained of.
            let said = |value: &str| {
                let mut all = values(&found);
                all.push(value.to_owned());
                all.resize(entry.arguments.len(), value.to_owned());
                let problem = self.mistake(&call(&site.before, entry, &all));
                problem.and_then(|problem| wanted(&problem.message, name, &entry.name))
            };
            let argument = match said("#{}").as_deref() {
                Some("a number") => number(name, said),
                Some("a text in quotes") => {
                    let takes = said("\"?\"").unwrap_or_else(|| "a text".to_owned());
                    let value = self.text(entry, site, &found, &takes);
                    Argument::new(name, takes, value)
                }
                Some("`true` or `false`") => Argument::new(name, "`true` or `false`", "true"),
                Some("an array") => Argument::new(name, "an array of texts", "[\"a\", \"b\"]"),
                Some(other) => Argument::new(name, other, "0"),
                None => return found,
            };
            found.push(argument);
        }
        found
    }

    /// A text that the function takes at that place.
    fn text(&self, entry: &Entry, site: &Site, found: &[Argument], takes: &str) -> String {
        let choice = takes.split('`').nth(1).map(str::to_owned);
        let texts = choice.into_iter().chain(TEXTS.map(str::to_owned));
        let mut quoted = texts.map(|text| format!("\"{text}\""));
        let fits = |text: &String| {
            let mut all = values(found);
            all.push(text.clone());
            // Later arguments stay wrong, and are what is complained of if this one is right.
            all.resize(entry.arguments.len(), "#{}".to_owned());
            let line = call(&site.before, entry, &all) + site.behind;
            match self.mistake(&line) {
                None => true,
                Some(problem) => {
                    let later = entry.arguments.get(found.len() + 1);
                    later.is_some_and(|name| wanted(&problem.message, name, &entry.name).is_some())
                }
            }
        };
        quoted.find(fits).unwrap_or_else(|| "\"fresh\"".to_owned())
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

impl Argument {
    fn new(name: &str, takes: impl Into<String>, value: impl Into<String>) -> Self {
        Self {
            name: name.to_owned(),
            takes: takes.into(),
            value: value.into(),
        }
    }
}

/// A number's range, from what is said of numbers far outside of it.
fn number(name: &str, said: impl Fn(&str) -> Option<String>) -> Argument {
    let Some(range) = said("-1000000000000").filter(|text| text != "a number") else {
        return Argument::new(name, "a number", "0");
    };
    let whole = said("0.12345").is_some_and(|text| text.contains("whole"));
    let kind = if whole { "a whole number" } else { "a number" };
    let least = range.split(' ').nth(1).unwrap_or("0").to_owned();
    Argument::new(name, format!("{kind} {range}"), least)
}

/// What a message wants of an argument: "from 0 to 1" of "`x` of `f` must be from 0 to 1, not 2".
fn wanted(message: &str, argument: &str, function: &str) -> Option<String> {
    let rest = message.strip_prefix(&format!("`{argument}` of `{function}` must be "))?;
    let (wanted, _) = rest.rsplit_once(", not ")?;
    Some(wanted.to_owned())
}

/// The arguments after `Default:` in a text.
pub(super) fn default_said(about: &str) -> Option<&str> {
    about.split_once("Default: `")?.1.split('`').next()
}

/// The arguments, then the same with other texts for the first that takes any.
fn with_other_texts(arguments: &[Argument]) -> impl Iterator<Item = Vec<Argument>> {
    let free = arguments
        .iter()
        .position(|argument| argument.takes == "a text");
    let others = free.into_iter().flat_map(move |index| {
        TEXTS.map(|text| {
            let mut other = arguments.to_vec();
            other[index].value = format!("\"{text}\"");
            other
        })
    });
    std::iter::once(arguments.to_vec()).chain(others)
}

/// A message without what stands in back quotes, and without numbers of lines.
fn without_names(message: &str) -> String {
    message.split('`').step_by(2).collect()
}

/// A message with its help.
pub(super) fn told(problem: &Problem) -> String {
    match &problem.hint {
        Some(hint) => format!("{}\n    help: {hint}", problem.message),
        None => problem.message.clone(),
    }
}

fn call(receiver: &str, entry: &Entry, arguments: &[String]) -> String {
    let dot = if receiver.is_empty() { "" } else { "." };
    format!("{receiver}{dot}{}({})", entry.name, arguments.join(", "))
}

fn values(arguments: &[Argument]) -> Vec<String> {
    arguments
        .iter()
        .map(|argument| argument.value.clone())
        .collect()
}
