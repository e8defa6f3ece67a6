//! The catalogue and the program know the same keys, and the same names in braces.

#![allow(clippy::unwrap_used)]

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

/// The texts in quotes of a file, each with its line and what stands before it, without those of
/// comments, attributes' and tests' own.
fn literals(code: &str) -> Vec<(usize, String, String)> {
    let code = code.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let letters: Vec<char> = code.chars().collect();
    let is = |at: usize, what: &str| what.chars().zip(&letters[at..]).all(|(a, b)| a == *b);
    let (mut found, mut at, mut line) = (Vec::new(), 0, 1);
    while at < letters.len() {
        let start = at;
        if is(at, "//") {
            while at < letters.len() && letters[at] != '\n' {
                at += 1;
            }
        } else if is(at, "'\"'") {
            at += 3;
        } else if is(at, "'\\\"'") || is(at, "'\\\\'") {
            at += 4;
        } else if letters[at] == '"' {
            at += 1;
            while letters[at] != '"' {
                at += if letters[at] == '\\' { 2 } else { 1 };
            }
            at += 1;
            let text: String = letters[start + 1..at - 1].iter().collect();
            let before: String = letters[start.saturating_sub(40)..start].iter().collect();
            found.push((line, before.trim_end().to_owned(), text));
        } else {
            at += 1;
        }
        line += letters[start..at]
            .iter()
            .filter(|one| **one == '\n')
            .count();
    }
    found
}

/// Two words beside each other.
fn is_words(text: &str) -> bool {
    let plain = |word: &&str| word.len() > 1 && word.chars().all(|one| one.is_alphabetic());
    let words: Vec<bool> = text.split(' ').map(|word| plain(&word)).collect();
    words.windows(2).any(|pair| pair[0] && pair[1])
}

/// What is said to whoever started the program, and documents that the editor writes.
const OTHERS: [&str; 6] = [
    "ui/bench/",
    "ui/surface.rs",
    "ui/window.rs",
    "ui/messages/",
    "notebook/entry.rs",
    "notebook/markdown.rs",
];

/// Calls whose words nobody reads: names of widgets, and what a broken program says.
const CALLS: [&str; 9] = [
    "Id::unique(",
    "Id::new(",
    "Grid::new(",
    "push_id(",
    "panic!(",
    "expect(",
    "label: Some(",
    "tracing::error!(",
    "tracing::warn!(",
];

/// Names, not words: of a feature, of commands, and of what a change replaces in the history.
const NAMES: [&str; 5] = [
    "pipeline statistics",
    "lightbench run ",
    "lightbench compare {} --warmup {} --frames {} --processes {} --seconds {} --out {}",
    "pipeline parameter {parameter}",
    "scene parameter {parameter}",
];

#[test]
fn no_text_stands_outside_the_catalogue() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/ui");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let mut wrong = Vec::new();
    for file in files {
        let name = file.to_str().unwrap().replace('\\', "/");
        if OTHERS.iter().any(|other| name.contains(other)) {
            continue;
        }
        let code = std::fs::read_to_string(&file).unwrap();
        for (line, before, text) in literals(&code) {
            let known =
                CALLS.iter().any(|call| before.ends_with(call)) || NAMES.contains(&text.as_str());
            if is_words(&text) && !known {
                wrong.push(format!("{name}:{line}: {text:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
