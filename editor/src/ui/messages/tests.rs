//! The catalogue and the program know the same keys, and the same names in braces.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::{ENGLISH, fill, filled, read};

/// A place where the program says something: file, line, key, names that are filled in.
struct Said {
    place: String,
    key: String,
    names: BTreeSet<String>,
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") && !is_of_tests(&path) {
            found.push(path);
        }
    }
}

fn is_of_tests(path: &Path) -> bool {
    path.ends_with("tests.rs") || path.ends_with("messages/mod.rs")
}

/// The text up to the bracket that closes the call.
fn arguments(after: &str) -> &str {
    let (mut depth, mut quoted, mut escaped) = (1, false, false);
    for (at, letter) in after.char_indices() {
        match letter {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '(' | '[' | '{' if !quoted => depth += 1,
            ')' | ']' | '}' if !quoted => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &after[..at];
        }
    }
    after
}

/// The names before `=` on the first level of a call's arguments.
fn names(arguments: &str) -> BTreeSet<String> {
    let (mut depth, mut quoted, mut escaped) = (0, false, false);
    let mut starts = Vec::new();
    for (at, letter) in arguments.char_indices() {
        match letter {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '(' | '[' | '{' if !quoted => depth += 1,
            ')' | ']' | '}' if !quoted => depth -= 1,
            ',' if !quoted && depth == 0 => starts.push(at + 1),
            _ => {}
        }
    }
    let after = starts.into_iter().map(|at| arguments[at..].trim_start());
    let named = after.filter_map(|rest| rest.split_once(" = ").map(|(name, _)| name));
    named
        .filter(|name| name.chars().all(|one| one.is_alphanumeric() || one == '_'))
        .map(str::to_owned)
        .collect()
}

fn said() -> Vec<Said> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut said = Vec::new();
    for file in files {
        let code = std::fs::read_to_string(&file).unwrap();
        for call in ["say!(", "message!("] {
            for (at, _) in code.match_indices(call) {
                let inside = arguments(&code[at + call.len()..]);
                let key = inside.split('"').nth(1).unwrap_or_default();
                let line = code[..at].lines().count();
                said.push(Said {
                    place: format!("{}:{line}", file.display()),
                    key: key.to_owned(),
                    names: names(inside),
                });
            }
        }
    }
    said
}

fn braces(text: &str) -> BTreeSet<String> {
    let parts = text.split('{').skip(1);
    parts
        .filter_map(|part| part.split_once('}').map(|(name, _)| name.to_owned()))
        .collect()
}

#[test]
fn every_key_has_a_text_and_every_text_is_said() {
    let catalogue: BTreeMap<String, String> = read(ENGLISH).unwrap().into_iter().collect();
    let said = said();
    let mut wrong = Vec::new();
    for Said { place, key, names } in &said {
        match catalogue.get(key) {
            None => wrong.push(format!("{place}: no message `{key}`")),
            Some(text) if braces(text) != *names => wrong.push(format!(
                "{place}: `{key}` names {:?}, and {names:?} are filled in",
                braces(text)
            )),
            Some(_) => {}
        }
    }
    let used: BTreeSet<&String> = said.iter().map(|one| &one.key).collect();
    for key in catalogue.keys().filter(|key| !used.contains(key)) {
        wrong.push(format!("nothing says `{key}`"));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn values_stand_where_the_text_names_them() {
    let catalogue = read("[log]\nsaved = \"{file} was saved as {name}.\"").unwrap();
    assert_eq!(catalogue["log.saved"], "{file} was saved as {name}.");
    let values: [(&str, &dyn std::fmt::Display); 2] = [("name", &7), ("file", &"a.rhai")];
    assert_eq!(
        fill(&catalogue["log.saved"], &values),
        "a.rhai was saved as 7."
    );
    // A key that is unknown is shown itself.
    assert_eq!(filled("nobody.says_this", &[]), "nobody.says_this");
}
