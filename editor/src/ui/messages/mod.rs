//! The catalogue of messages: all text of the window is in `editor/messages/en.toml`, by key.
//!
//! [`say!`] gives the text of a key, and fills in what the text names in braces; [`message!`] marks a key
//! that is looked up later with [`text`], as in tables of actions. Whoever translates the editor writes
//! one file, and whoever reads code sees what is said by its key. Errors of the engine, which the command
//! line tells too, and documents that the editor writes have their words where they arise.

#[cfg(test)]
mod tests;

use std::collections::HashMap;
use std::fmt::{Display, Write as _};
use std::sync::LazyLock;

/// The English messages.
const ENGLISH: &str = include_str!("../../../messages/en.toml");

static CATALOGUE: LazyLock<HashMap<String, String>> =
    LazyLock::new(|| read(ENGLISH).unwrap_or_default());

/// The text of a key, `say!("menu.file")`, or one with values filled in, `say!("log.saved", file = path)`.
macro_rules! say {
    ($key:literal) => {
        $crate::ui::messages::text($key)
    };
    ($key:literal, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::ui::messages::filled($key, &[$((stringify!($name), &$value)),+])
    };
}

/// A key whose text is looked up later, with [`text`].
macro_rules! message {
    ($key:literal) => {
        $key
    };
}

pub(crate) use {message, say};

/// The text of a key. A key without a text is shown itself; a test finds it before.
#[must_use]
pub fn text(key: &'static str) -> &'static str {
    CATALOGUE.get(key).map_or(key, String::as_str)
}

/// The text of a key, with values in place of the names in braces.
#[must_use]
pub fn filled(key: &'static str, values: &[(&str, &dyn Display)]) -> String {
    fill(text(key), values)
}

fn fill(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut rest = text;
    let mut whole = String::with_capacity(rest.len());
    while let Some((before, after)) = rest.split_once('{') {
        whole.push_str(before);
        let (name, next) = after.split_once('}').unwrap_or((after, ""));
        if let Some((_, value)) = values.iter().find(|(known, _)| *known == name) {
            // Writing to a string fails only where the value's own `Display` does.
            let _ = write!(whole, "{value}");
        }
        rest = next;
    }
    whole.push_str(rest);
    whole
}

/// Reads a catalogue: texts by `section.name`.
fn read(catalogue: &str) -> Result<HashMap<String, String>, toml::de::Error> {
    let sections: HashMap<String, HashMap<String, String>> = toml::from_str(catalogue)?;
    let texts = sections.into_iter().flat_map(|(section, texts)| {
        texts
            .into_iter()
            .map(move |(name, text)| (format!("{section}.{name}"), text))
    });
    Ok(texts.collect())
}
