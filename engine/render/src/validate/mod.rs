//! Checks a pipeline's description before anything is built from it.
//!
//! Every mistake is reported at once, each with its place and the way to mend it. What only the
//! shaders can tell is checked in [`crate::binding`], after they are composed.

mod attachments;
mod every_adapter;
mod kinds;
mod models;
mod order;
mod resources;
mod results;
mod support;
mod transfers;

use std::collections::{BTreeMap, BTreeSet};

use crate::description::{PipelineDesc, TargetDesc};
use crate::problem::{Place, Problem, Problems, nearest, suggestion};

pub use every_adapter::EveryAdapter;
pub use support::FormatSupport;

/// Checks the description.
///
/// # Errors
/// Every mistake that was found, in the order of the declarations.
pub fn validate(desc: &PipelineDesc, support: &impl FormatSupport) -> Result<(), Problems> {
    let mut checker = Checker {
        desc,
        support,
        problems: Vec::new(),
        meant: BTreeSet::new(),
        unwritten: BTreeSet::new(),
    };
    checker.names();
    checker.models();
    checker.targets();
    checker.buffers();
    for pass in &desc.passes {
        checker.kind(pass);
        checker.attachments(pass);
        checker.feedback(pass);
        checker.shader(pass);
    }
    // What a misspelt name meant is known only now.
    checker.uses();
    checker.order();
    checker.results();
    if checker.problems.is_empty() {
        return Ok(());
    }
    // The pipeline's own file comes first, then the parts that it imports.
    checker.problems.sort_by_key(|problem| {
        let place = &problem.place;
        let part = place.file != desc.file.file;
        (part, place.file.clone(), place.line, place.column)
    });
    checker.problems.dedup();
    Err(Problems(checker.problems))
}

struct Checker<'a, S> {
    desc: &'a PipelineDesc,
    support: &'a S,
    problems: Vec<Problem>,
    /// What misspelt names probably meant: that these are not written or not used is no mistake of
    /// its own.
    meant: BTreeSet<&'a str>,
    /// Targets of which it was told that nobody writes them.
    unwritten: BTreeSet<&'a str>,
}

impl<'a, S: FormatSupport> Checker<'a, S> {
    fn report(&mut self, at: &Place, message: String, hint: impl Into<Option<String>>) {
        let mut problem = Problem::new(at.clone(), message);
        problem.hint = hint.into();
        self.problems.push(problem);
    }

    /// The target of that name, or a report.
    fn target(&mut self, name: &str, at: &Place) -> Option<&'a TargetDesc> {
        let desc = self.desc;
        let found = desc.target(name);
        if found.is_none() {
            let names = || desc.targets.iter().map(|target| target.name.as_str());
            self.meant.extend(nearest(name, names()));
            let hint = if desc.buffer(name).is_some() {
                format!("`{name}` is a buffer: a shader writes it through .updates")
            } else {
                suggestion(name, names()).unwrap_or_else(|| {
                    let list = names()
                        .map(|name| format!("`{name}`"))
                        .collect::<Vec<_>>()
                        .join(", ");
                    if list.is_empty() {
                        format!("declare it: p.target(\"{name}\", \"rgba16float\")")
                    } else {
                        format!("the targets are: {list}")
                    }
                })
            };
            self.report(at, format!("there is no target `{name}`"), hint);
        }
        found
    }

    /// Reports a name that is neither a target nor a buffer; says whether it is one.
    fn known(&mut self, name: &str, at: &Place) -> bool {
        let desc = self.desc;
        if desc.target(name).is_some() || desc.buffer(name).is_some() {
            return true;
        }
        let targets = desc.targets.iter().map(|target| target.name.as_str());
        let buffers = desc.buffers.iter().map(|buffer| buffer.name.as_str());
        self.meant
            .extend(nearest(name, targets.clone().chain(buffers.clone())));
        if buffers.len() == 0 {
            self.target(name, at);
        } else {
            let hint = suggestion(name, targets.chain(buffers))
                .unwrap_or_else(|| "declare it with p.target or p.buffer".to_owned());
            self.report(at, format!("there is no target or buffer `{name}`"), hint);
        }
        false
    }

    fn names(&mut self) {
        let desc = self.desc;
        let groups: [(&str, Vec<(&str, &Place)>); 5] = [
            (
                "target",
                desc.targets
                    .iter()
                    .map(|t| (t.name.as_str(), &t.at))
                    .collect(),
            ),
            (
                "pass",
                desc.passes
                    .iter()
                    .map(|p| (p.name.as_str(), &p.at))
                    .collect(),
            ),
            (
                "buffer",
                desc.buffers
                    .iter()
                    .map(|b| (b.name.as_str(), &b.at))
                    .collect(),
            ),
            (
                "counter",
                desc.counters
                    .iter()
                    .map(|c| (c.name.as_str(), &c.at))
                    .collect(),
            ),
            (
                "parameter",
                desc.parameters
                    .iter()
                    .map(|p| (p.name.as_str(), &p.at))
                    .collect(),
            ),
        ];
        for (what, names) in groups {
            let mut seen: BTreeMap<&str, &Place> = BTreeMap::new();
            for (name, at) in names {
                if let Some(first) = seen.insert(name, at) {
                    let first = first.line;
                    self.report(
                        at,
                        format!("the {what} `{name}` was declared already, in line {first}"),
                        "give one of them another name".to_owned(),
                    );
                }
            }
        }
    }
}
