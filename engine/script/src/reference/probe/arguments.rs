//! What the arguments of a function take, from what is said of wrong ones.

use super::Probe;
use super::sites::{Site, call};
use crate::names::Entry;

/// Texts to try where a function takes one.
const TEXTS: [&str; 8] = [
    "fresh",
    "a",
    "known",
    "known_depth",
    "known_buffer",
    "shaders/output.wgsl",
    "rgba16float",
    "rgb",
];

/// One argument of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Argument {
    pub(crate) name: String,
    /// "a number from 0 to 1"; empty where any value is taken.
    pub(crate) takes: String,
    /// A value that is right.
    pub(super) value: String,
}

impl Probe {
    /// What each argument takes, found with the first site that has a right value for all of them.
    pub(super) fn arguments(&self, entry: &Entry, sites: &[Site]) -> Vec<Argument> {
        let mut best = Vec::new();
        for site in sites {
            let arguments = self.arguments_at(entry, site);
            let fits = |arguments: &Vec<Argument>| {
                let line = call(&site.before, entry, &values(arguments)) + site.behind;
                arguments.len() == entry.arguments.len() && self.mistake(&line).is_none()
            };
            let others = with_other_texts(&arguments).chain(std::iter::once(rising(&arguments)));
            if let Some(right) = { others }.find(fits) {
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
                // Each another point.
                Some("a vec3") => {
                    let value = format!("vec3({}, 0, 0)", found.len());
                    Argument::new(name, "a vec3", value)
                }
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

/// The arguments, then the same with other texts for the first that takes any.
pub(super) fn with_other_texts(arguments: &[Argument]) -> impl Iterator<Item = Vec<Argument>> {
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

/// The arguments, with numbers of which each is larger than the one before.
fn rising(arguments: &[Argument]) -> Vec<Argument> {
    let mut rising = arguments.to_vec();
    for (index, argument) in rising.iter_mut().enumerate() {
        if let Ok(least) = argument.value.parse::<f64>() {
            argument.value = (least + index as f64).to_string();
        }
    }
    rising
}

/// The values of arguments.
pub(super) fn values(arguments: &[Argument]) -> Vec<String> {
    arguments
        .iter()
        .map(|argument| argument.value.clone())
        .collect()
}
