//! The references of experiments and of the checks of lessons.

use crate::experiment::{check_names, experiment_names};
use crate::names::{Entry, Names};

use super::functions::wrapped;

/// The page, as Markdown.
#[must_use]
pub fn experiments() -> String {
    let mut text = String::from(
        "# Experiments: looking into frames from scripts\n\n\
         <!-- Written by `lightbench docs experiments`. Change the texts in engine/script/src \
         instead. -->\n\n",
    );
    text += include_str!("prose/experiments.txt");
    text.push_str(&sections(&experiment_names()));
    text
}

/// The reference of the checks of lessons, as Markdown.
#[must_use]
pub fn checks() -> String {
    let mut text = String::from(
        "# Checks of lessons: judging what was handed in\n\n\
         <!-- Written by `lightbench docs checks`. Change the texts in engine/script/src instead. -->\n\n",
    );
    text += include_str!("prose/checks.txt");
    text.push_str(&sections(&check_names()));
    text
}

/// All functions under their headings.
fn sections(names: &Names) -> String {
    let mut text = String::new();
    let mut section = "";
    let mut entries = names
        .entries()
        .iter()
        .filter(|entry| !entry.section.is_empty())
        .peekable();
    while let Some(entry) = entries.next() {
        if entry.section != section {
            section = entry.section;
            text += &format!("\n## {section}\n");
        }
        let mut forms = vec![form(entry)];
        while let Some(next) = entries.next_if(|next| is_form(entry, next)) {
            forms.push(form(next));
        }
        text += &format!("\n### {}\n\n{}", forms.join(", "), wrapped(entry.about));
    }
    text
}

/// Whether both are forms of one function.
fn is_form(one: &Entry, other: &Entry) -> bool {
    (one.receiver, &one.name, one.about) == (other.receiver, &other.name, other.about)
}

/// A form with what it belongs to before the dot, as in `frame.width`.
fn form(entry: &Entry) -> String {
    format!("`{}{}`", entry.receiver.unwrap_or_default(), entry.form())
}
