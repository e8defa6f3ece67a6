//! What the reference says of one name, for who is writing it.

use lightbench_world::reflect::{FieldInfo, Role};

use super::api::{example, form, is_form, is_letter};
use super::completion::type_of;
use crate::names::{Entry, Names};
use crate::scene::Scene;
use crate::scene::overlays::field_path;
use lightbench_world::ComponentKind;

/// The text of a function, a property, a component or a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Help {
    /// How it is written, each way once.
    pub forms: Vec<String>,
    /// What it does.
    pub about: String,
    /// A call that shows it.
    pub example: Option<String>,
}

/// All that the reference has of a name: one for each type that has a member of that name, and one
/// for the function.
#[must_use]
pub fn help(names: &Names, name: &str) -> Vec<Help> {
    let mut found: Vec<(&Entry, Help)> = Vec::new();
    for entry in names.entries().iter().filter(|entry| entry.name == name) {
        let spelled = form(entry).trim_matches('`').to_owned();
        match found.iter_mut().find(|(first, _)| is_form(first, entry)) {
            Some((_, help)) if help.forms.contains(&spelled) => {}
            Some((_, help)) => help.forms.push(spelled),
            None if entry.about.is_empty() => {}
            None => found.push((
                entry,
                Help {
                    forms: vec![spelled],
                    about: entry.about.to_owned(),
                    example: example(names, entry).map(str::to_owned),
                },
            )),
        }
    }
    found.into_iter().map(|(_, help)| help).collect()
}

/// The help for what stands at a place of a line, in bytes: a name, or in a text a component or a
/// field.
#[must_use]
pub fn help_at(scene: &Scene, line: &str, caret: usize) -> Vec<Help> {
    let caret = floor(line, caret);
    let before = &line[..caret];
    if let Some(start) = open_text(before) {
        let end = line[caret..].find('"').map_or(line.len(), |at| caret + at);
        return component_or_field(&line[start..end]).into_iter().collect();
    }
    let start = before.rfind(|letter| !is_letter(letter)).map_or(0, |at| {
        at + before[at..].chars().next().map_or(1, char::len_utf8)
    });
    let after = &line[caret..];
    let end = caret + after.find(|c| !is_letter(c)).unwrap_or(after.len());
    let (mut rest, mut name) = (&line[..start], &line[start..end]);
    if name.is_empty() {
        // Inside of a call it is the call that is asked for.
        let called = open_call(before).map_or("", |(called, _)| called);
        rest = called.trim_end_matches(is_letter);
        name = &called[rest.len()..];
    }
    let all = help(scene.names(), name);
    // Behind a dot there are members alone, elsewhere functions.
    let member = rest.ends_with('.');
    let fits = |help: &Help| {
        let has_receiver = help.forms.iter().any(|form| {
            let called = form.split('(').next().unwrap_or_default();
            called.contains('.')
        });
        has_receiver == member
    };
    let (mut fitting, others): (Vec<Help>, Vec<Help>) = all.into_iter().partition(fits);
    // Those of the type that stands before the dot come first.
    let object = rest.strip_suffix('.');
    if let Some(known) = object.and_then(|object| type_of(scene, object)) {
        let of_it = format!("{known}.");
        fitting.sort_by_key(|help| !help.forms[0].starts_with(&of_it));
    }
    if fitting.is_empty() { others } else { fitting }
}

/// What the world says of a component or a field that scripts name.
fn component_or_field(path: &str) -> Option<Help> {
    let kinds = ComponentKind::ALL.iter().copied();
    for kind in kinds.filter(|kind| kind.info().role != Role::Hidden) {
        let info = kind.info();
        for field in info.fields {
            let known = field_path(kind, field)?;
            if known == path {
                return Some(Help {
                    forms: vec![known.to_owned()],
                    about: about_field(field),
                    example: None,
                });
            }
            if known.split_once('.').is_some_and(|(name, _)| name == path) {
                return Some(Help {
                    forms: vec![path.to_owned()],
                    about: words(info.doc),
                    example: None,
                });
            }
        }
    }
    None
}

/// What a field means, with its unit and range.
#[must_use]
pub(super) fn about_field(field: &FieldInfo) -> String {
    let mut about = words(field.doc);
    let what = crate::scene::field_takes(field);
    about += &format!(" It takes {what}.");
    about
}

/// A text of the source in one line.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What stands before the last parenthesis that is open at the end of a text, and how many commas stand
/// behind it.
pub(super) fn open_call(before: &str) -> Option<(&str, usize)> {
    let (mut depth, mut commas) = (0, 0);
    for (at, letter) in before.char_indices().rev() {
        match letter {
            ')' | ']' | '}' => depth += 1,
            '(' if depth == 0 => return Some((&before[..at], commas)),
            '(' | '[' | '{' => depth -= 1,
            ',' if depth == 0 => commas += 1,
            _ => {}
        }
    }
    None
}

/// Where the text begins that is open at the end of a line, behind its quote.
pub(super) fn open_text(before: &str) -> Option<usize> {
    let (mut open, mut escaped) = (None, false);
    for (at, letter) in before.char_indices() {
        match (letter, open) {
            _ if escaped => escaped = false,
            ('\\', Some(_)) => escaped = true,
            ('"', None) => open = Some(at + 1),
            ('"', Some(_)) => open = None,
            _ => {}
        }
    }
    open
}

/// The last place at or before an index at which a letter begins.
pub(super) fn floor(text: &str, index: usize) -> usize {
    let mut index = index.min(text.len());
    while !text.is_char_boundary(index) {
        index -= 1;
    }
    index
}
