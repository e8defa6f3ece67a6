//! The reference of scene scripts and behaviours.

use std::fmt::Write as _;

use super::calls::{CALLS, OTHER_CALLS};
use super::functions::wrapped;
use crate::names::{Entry, Names};
use crate::scene::scene_names;

/// The heading of what all kinds of scripts have: it is registered before anybody names a section.
const COMMON: &str = "Numbers, vectors, colours and chance";

/// The page, as Markdown.
#[must_use]
pub fn api() -> String {
    let mut text = String::from(
        "# Scene scripts and behaviours: the reference\n\n\
         <!-- Written by `lightbench docs api`. Change the texts in engine/script/src instead. -->\n\n",
    );
    text += include_str!("prose/api.txt");
    let names = scene_names();
    let mut sections: Vec<(&str, Vec<&Entry>)> = Vec::new();
    for entry in names.entries() {
        let title = match entry.section {
            "" => COMMON,
            title => title,
        };
        match sections.iter_mut().find(|(known, _)| *known == title) {
            Some((_, entries)) => entries.push(entry),
            None => sections.push((title, vec![entry])),
        }
    }
    // What every script begins with first, mathematics last.
    sections.sort_by_key(|(title, _)| *title == COMMON);
    for (title, entries) in sections {
        let _ = write!(text, "\n## {title}\n");
        let mut entries = entries.into_iter().peekable();
        while let Some(entry) = entries.next() {
            let mut forms = vec![form(entry)];
            while let Some(next) = entries.next_if(|next| is_form(entry, next)) {
                if !forms.contains(&form(next)) {
                    forms.push(form(next));
                }
            }
            let _ = write!(
                text,
                "\n### {}\n\n{}",
                forms.join(", "),
                wrapped(entry.about)
            );
            if let Some(example) = example(&names, entry) {
                let _ = write!(text, "\n```rhai\n{}\n```\n", example.replace("; ", ";\n"));
            }
        }
    }
    text
}

/// Whether both are forms of one function, or the reading and the writing of one property.
pub(super) fn is_form(one: &Entry, other: &Entry) -> bool {
    (one.receiver, &one.name) == (other.receiver, &other.name)
        && (one.about == other.about || other.about.is_empty())
}

/// A form with what it belongs to before the dot, as in `entity.position`.
pub(super) fn form(entry: &Entry) -> String {
    format!("`{}{}`", entry.receiver.unwrap_or_default(), entry.form())
}

/// A call that shows a function: the shortest of those that show it on an object of its type.
pub(super) fn example(names: &Names, entry: &Entry) -> Option<&'static str> {
    let word = match (entry.property, entry.receiver) {
        (true, _) => format!(".{}", entry.name),
        (false, Some(_)) => format!(".{}(", entry.name),
        (false, None) => format!("{}(", entry.name),
    };
    let places = |call: &&'static str| -> Vec<usize> {
        let shows = |at: &usize| {
            let before = call[..*at].chars().next_back();
            let after = call[at + word.len()..].chars().next();
            let whole_word = !entry.property || !after.is_some_and(is_letter);
            let own = entry.receiver.is_some()
                || !before.is_some_and(|letter| letter == '.' || is_letter(letter));
            whole_word && own
        };
        let all = call.match_indices(&word).map(|(at, _)| at);
        all.filter(shows).collect()
    };
    let all = CALLS.iter().chain(OTHER_CALLS).copied();
    let found = all.map(|call| (call, places(&call)));
    let found = found.filter(|(_, places)| !places.is_empty());
    let on_its_type = |call: &str, places: &[usize]| {
        let maker = |at: &usize| maker_of(call, *at);
        places
            .iter()
            .any(|at| is_made_by(names, entry.receiver, maker(at)))
    };
    found
        .min_by_key(|(call, places)| (!on_its_type(call, places), call.len()))
        .map(|(call, _)| call)
}

/// Whether a plain function gives what a function is called on.
fn is_made_by(names: &Names, receiver: Option<&str>, maker: &str) -> bool {
    receiver.is_none_or(|receiver| {
        let mut makers = names.entries().iter();
        makers.any(|entry| {
            let plain = entry.receiver.is_none() && entry.name == maker;
            plain && names.given_by(entry) == receiver
        })
    })
}

/// The word with which the chain begins that stands before a place of a call, or that of the variable
/// which it names.
fn maker_of(call: &str, at: usize) -> &str {
    let (mut depth, mut start) = (0_i32, at);
    for (index, letter) in call[..at].char_indices().rev() {
        match letter {
            ')' | ']' => depth += 1,
            '(' | '[' if depth > 0 => depth -= 1,
            _ if depth > 0 || letter == '.' || is_letter(letter) => {}
            _ => break,
        }
        start = index;
    }
    let first = |text: &'_ str| text.find(|letter| !is_letter(letter)).unwrap_or(text.len());
    let word = &call[start..start + first(&call[start..at])];
    let declared = format!("let {word} = ");
    match call.find(&declared) {
        Some(found) => {
            let value = &call[found + declared.len()..];
            &value[..first(value)]
        }
        None => word,
    }
}

pub(super) fn is_letter(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}
