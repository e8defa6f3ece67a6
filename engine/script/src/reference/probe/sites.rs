//! Where a call is tried: what stands before it and behind it.

use super::Probe;
use crate::names::Entry;

/// What may have to stand before a pass's method, and behind it.
const AROUND: [(&str, &str); 14] = [
    ("", ""),
    ("", ".clear(0, 0, 0, 0)"),
    ("", ".clear(0)"),
    (".shader(\"shaders/output.wgsl\")", ""),
    (".shader(\"shaders/output.wgsl\")", ".clear(0, 0, 0, 0)"),
    (".shader(\"shaders/output.wgsl\").writes(\"known\")", ""),
    (
        ".shader(\"shaders/output.wgsl\").writes(\"known\").depth(\"known_depth\")",
        "",
    ),
    (
        ".shader(\"shaders/output.wgsl\").writes(\"known\").depth(\"known_depth\")\
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

/// Where a call is made: what stands before it and behind it.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) kind: String,
    pub(super) before: String,
    pub(super) behind: &'static str,
}

impl Probe {
    /// What stands before a call of that form.
    pub(super) fn sites(&self, entry: &Entry) -> Vec<Site> {
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
}

/// A call as a script writes it.
pub(super) fn call(receiver: &str, entry: &Entry, arguments: &[String]) -> String {
    let dot = if receiver.is_empty() { "" } else { "." };
    format!("{receiver}{dot}{}({})", entry.name, arguments.join(", "))
}
