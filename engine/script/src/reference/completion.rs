//! What a name that is being written may become.

use std::collections::BTreeSet;

use lightbench_world::Name;
use lightbench_world::reflect::Role;

use super::api::is_letter;
use super::lookup::{about_field, floor, open_call, open_text};
use crate::names::{Entry, Names};
use crate::scene::Scene;
use crate::scene::overlays::field_path;
use lightbench_world::ComponentKind;

/// Candidates that are listed; nobody reads more.
const MOST: usize = 200;

/// One name that fits.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Candidate {
    /// What stands in the line then, in place of what was begun.
    pub text: String,
    /// How it is written: a form with its arguments, or the name.
    pub form: String,
    /// What it does, in a line.
    pub about: String,
}

/// What fits at a place of a line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Completions {
    /// Where the begun name starts, in bytes.
    pub start: usize,
    /// The names, by the alphabet.
    pub candidates: Vec<Candidate>,
}

impl Completions {
    /// What all candidates begin with.
    #[must_use]
    pub fn common(&self) -> &str {
        let mut candidates = self.candidates.iter();
        let first = candidates.next().map_or("", |first| first.text.as_str());
        candidates.fold(first, |common, other| {
            let same = common.chars().zip(other.text.chars());
            let length = same.take_while(|(a, b)| a == b).map(|(a, _)| a.len_utf8());
            &common[..length.sum()]
        })
    }
}

/// What may stand where a name was begun in a line of the console: functions, methods and properties
/// of what stands before the dot, variables; in a text, names of entities, components and fields.
#[must_use]
pub fn complete(scene: &Scene, line: &str, caret: usize) -> Completions {
    let before = &line[..floor(line, caret)];
    let (start, mut all) = match open_text(before) {
        Some(start) => (start, in_text(scene, before, start)),
        None => {
            let rest = before.trim_end_matches(is_letter);
            let all = match rest.strip_suffix('.') {
                Some(object) => members(scene, object),
                None => plain(scene),
            };
            (rest.len(), all)
        }
    };
    let begun = &before[start..];
    // A number is no name.
    if begun.starts_with(|c: char| c.is_ascii_digit()) && open_text(before).is_none() {
        all.clear();
    }
    all.retain(|candidate| candidate.text.starts_with(begun));
    let all: BTreeSet<Candidate> = all.into_iter().collect();
    let mut candidates: Vec<Candidate> = Vec::new();
    for candidate in all {
        let is_full = candidates.len() == MOST;
        match candidates.last_mut() {
            // Forms of one function stand in one line.
            Some(last) if last.text == candidate.text => {
                if last.form != candidate.form {
                    last.form += &format!(", {}", candidate.form);
                }
            }
            _ if is_full => break,
            _ => candidates.push(candidate),
        }
    }
    Completions { start, candidates }
}

fn candidate(entry: &Entry) -> Candidate {
    let open = if entry.property { "" } else { "(" };
    let close = if !entry.property && entry.arguments.is_empty() {
        ")"
    } else {
        ""
    };
    Candidate {
        text: format!("{}{open}{close}", entry.name),
        form: entry.form(),
        about: entry
            .about
            .split(". ")
            .next()
            .unwrap_or_default()
            .to_owned(),
    }
}

fn plain(scene: &Scene) -> Vec<Candidate> {
    let names = scene.names();
    let functions = names.entries().iter();
    let functions = functions.filter(|entry| entry.receiver.is_none());
    let mut all: Vec<Candidate> = functions.map(candidate).collect();
    let own: BTreeSet<&str> = names.entries().iter().map(|e| e.name.as_str()).collect();
    let builtin = names.builtin().filter(|name| !own.contains(name));
    all.extend(builtin.map(|name| Candidate {
        text: format!("{name}("),
        form: format!("{name}(…)"),
        about: "A function of Rhai".to_owned(),
    }));
    all.extend(scene.console_variables().into_iter().map(|name| Candidate {
        form: name.clone(),
        text: name,
        about: "A variable".to_owned(),
    }));
    all
}

fn members(scene: &Scene, object: &str) -> Vec<Candidate> {
    let names = scene.names();
    let known = type_of(scene, object);
    let members = names.entries().iter().filter(|entry| match known {
        Some(known) => entry.receiver == Some(known),
        None => entry.receiver.is_some(),
    });
    let members = members.filter(|entry| !(entry.property && entry.about.is_empty()));
    members.map(candidate).collect()
}

/// The type of what a line ends with, where the names alone tell it: a call, a property or a
/// variable.
pub(super) fn type_of(scene: &Scene, object: &str) -> Option<&'static str> {
    let names = scene.names();
    let (called, property) = match object.strip_suffix(')') {
        Some(inside) => (open_call(inside)?.0, false),
        None => (object, true),
    };
    let rest = called.trim_end_matches(is_letter);
    let name = &called[rest.len()..];
    let receiver = match rest.strip_suffix('.') {
        Some(object) => Some(type_of(scene, object)?),
        None => None,
    };
    if property && receiver.is_none() {
        return scene.console_type(name);
    }
    given(names, receiver, name, property)
}

fn given(
    names: &Names,
    receiver: Option<&str>,
    name: &str,
    property: bool,
) -> Option<&'static str> {
    let mut entries = names.entries().iter();
    let entry = entries.find(|entry| {
        (entry.receiver, entry.name.as_str(), entry.property) == (receiver, name, property)
    })?;
    names.types().find(|known| *known == names.given_by(entry))
}

/// What a text may be, by the argument that it is.
fn in_text(scene: &Scene, before: &str, start: usize) -> Vec<Candidate> {
    let call = &before[..start - 1];
    let mut all = Vec::new();
    let argument = argument(scene.names(), call);
    let is = |names: &[&str]| {
        argument
            .as_ref()
            .is_none_or(|argument| names.contains(&argument.as_str()))
    };
    if is(&["name"]) {
        let named = scene.world.columns::<Name>();
        all.extend(named.text().iter().map(|name| Candidate {
            text: name.clone(),
            form: format!("\"{name}\""),
            about: "An entity".to_owned(),
        }));
    }
    let kinds = ComponentKind::ALL.iter().copied();
    for kind in kinds.filter(|kind| kind.info().role != Role::Hidden) {
        for field in kind.info().fields {
            let Some(path) = field_path(kind, field) else {
                continue;
            };
            if is(&["field", "component"]) && argument.as_deref() != Some("component") {
                all.push(Candidate {
                    text: path.to_owned(),
                    form: path.to_owned(),
                    about: about_field(field),
                });
            }
            let component = path.split('.').next().unwrap_or_default();
            if is(&["component", "field"]) {
                all.push(Candidate {
                    text: component.to_owned(),
                    form: component.to_owned(),
                    about: "A component".to_owned(),
                });
            }
        }
    }
    all
}

/// The name of the argument that comes next in an open call, as in `entity("lamp").set(`.
fn argument(names: &Names, call: &str) -> Option<String> {
    let (called, commas) = open_call(call)?;
    let rest = called.trim_end_matches(is_letter);
    let name = &called[rest.len()..];
    let member = rest.ends_with('.');
    let mut entries = names.entries().iter();
    let entry = entries.find(|entry| {
        entry.name == name && entry.receiver.is_some() == member && entry.arguments.len() > commas
    })?;
    let argument = entry.arguments[commas].clone();
    // A name that is given, and not looked for, may be any.
    (name != "spawn").then_some(argument)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use lightbench_assets::Progress;

    use super::super::{help, help_at};
    use super::*;
    use crate::testing::project;
    use crate::{Settings, load_scene};

    fn scene() -> Scene {
        let script = "point_light(\"lamp 1\"); point_light(\"lamp 2\"); spawn(\"table\");";
        let (_folder, files) = project(&[("scripts/scenes/test.rhai", script)]);
        let mut scene = load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap();
        scene.evaluate("let bulb = entity(\"lamp 1\");").unwrap();
        scene
    }

    fn texts(scene: &Scene, line: &str) -> Vec<String> {
        let found = complete(scene, line, line.len());
        found.candidates.into_iter().map(|one| one.text).collect()
    }

    #[test]
    fn names_complete_by_what_stands_before_them() {
        let scene = scene();
        assert_eq!(texts(&scene, "point_l"), ["point_light(", "point_light()"]);
        assert_eq!(texts(&scene, "let x = smooth"), ["smoothstep("]);
        assert_eq!(texts(&scene, "stat"), ["state"]);
        assert_eq!(texts(&scene, "bul"), ["bulb"]);
        assert!(texts(&scene, "to_str").contains(&"to_string(".to_owned()));
        // Of an entity, and of no other type.
        let intensity = ["intensity", "intensity("];
        assert_eq!(texts(&scene, "entity(\"lamp 1\").inten"), intensity);
        assert_eq!(texts(&scene, "bulb.inten"), intensity);
        assert_eq!(texts(&scene, "spawn(\"a\").at(1, (2), 3).inten"), intensity);
        assert_eq!(texts(&scene, "bulb.position.norm"), ["normalize()"]);
        assert!(texts(&scene, "bulb.position.inten").is_empty());
        assert!(texts(&scene, "unknown.inten").contains(&"intensity".to_owned()));
        assert!(texts(&scene, "3").is_empty());
        let forms = complete(&scene, "bulb.rotat", 10).candidates;
        let forms: Vec<&str> = forms.iter().map(|one| one.form.as_str()).collect();
        assert_eq!(forms, [".rotate(rotation), .rotate(x, y, z)", ".rotation"]);
    }

    #[test]
    fn texts_complete_to_what_their_argument_names() {
        let scene = scene();
        assert_eq!(texts(&scene, "entity(\"la"), ["lamp 1", "lamp 2"]);
        assert_eq!(complete(&scene, "entity(\"la", 10).common(), "lamp ");
        assert_eq!(texts(&scene, "bulb.get(\"light.ra"), ["light.range"]);
        assert_eq!(texts(&scene, "bulb.set(\"light.ra"), ["light.range"]);
        assert_eq!(texts(&scene, "bulb.add(\"li"), ["light"]);
        assert_eq!(
            texts(&scene, "entity(\"table\").set(\"light.k"),
            ["light.kind"]
        );
        assert!(texts(&scene, "print(\"la").contains(&"lamp 1".to_owned()));
    }

    #[test]
    fn help_is_the_text_of_the_reference() {
        let scene = scene();
        let page = super::super::api();
        let page: String = page.split_whitespace().collect::<Vec<_>>().join(" ");
        for entry in scene.names().entries() {
            let help = help(scene.names(), &entry.name);
            assert!(!help.is_empty(), "{}", entry.name);
            for help in help {
                assert!(page.contains(&help.about), "{}", help.about);
                for form in &help.forms {
                    assert!(page.contains(&format!("`{form}`")), "{form}");
                }
            }
        }
        let at = |line: &str, caret: usize| {
            let help = help_at(&scene, line, caret);
            help.first()
                .map(|help| help.forms[0].clone())
                .unwrap_or_default()
        };
        let line = "entity(\"lamp 1\").set(\"light.range\", noise(1))";
        assert_eq!(at(line, 3), "entity(name)");
        assert_eq!(at(line, 18), "entity.set(field, value)");
        assert_eq!(at(line, 30), "light.range");
        assert_eq!(at(line, 38), "noise(x)");
        assert_eq!(at(line, line.len()), "");
        assert_eq!(at("entity(\"lamp 1\").at(1, ", 23), "entity.at(x, y, z)");
        let field = &help_at(&scene, line, 30)[0];
        assert!(
            field.about.contains("of at least 0, in m."),
            "{}",
            field.about
        );
        assert!(help_at(&scene, "ä", 1).is_empty());
    }
}
