//! The reference of scene scripts and behaviours.

use std::fmt::Write as _;

use super::calls::{CALLS, OTHER_CALLS};
use super::functions::wrapped;
use crate::names::Entry;
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
            if let Some(example) = example(entry) {
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

/// The first call that shows a function; shorter ones first.
pub(super) fn example(entry: &Entry) -> Option<&'static str> {
    let word = match (entry.property, entry.receiver) {
        (true, _) => format!(".{}", entry.name),
        (false, Some(_)) => format!(".{}(", entry.name),
        (false, None) => format!("{}(", entry.name),
    };
    let shows = |call: &&&str| {
        call.match_indices(&word).any(|(at, _)| {
            let before = call[..at].chars().next_back();
            let after = call[at + word.len()..].chars().next();
            let whole_word = !entry.property || !after.is_some_and(is_letter);
            let own = entry.receiver.is_some()
                || !before.is_some_and(|letter| letter == '.' || is_letter(letter));
            whole_word && own
        })
    };
    let all = CALLS.iter().chain(OTHER_CALLS);
    all.filter(shows).min_by_key(|call| call.len()).copied()
}

pub(super) fn is_letter(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}
