//! Says where and what a composer's error is, in the words of the file that a person wrote.

use naga_oil::compose::{Composer, ComposerError, ComposerErrorInner};

use super::declarations::Listings;
use super::imports::unknown_module;
use super::tokens::{is_word, tokens};
use super::{syntax, undecorate, validity};
use crate::problem::{Place, Problem};

/// The composer numbers bytes in the composed text: the top bits name the module.
const POSITION_BITS: u32 = 21;

/// What is needed to explain an error.
pub(super) struct Explainer<'a> {
    pub composer: &'a Composer,
    /// The files of the shader, as they were written.
    pub listings: &'a Listings,
    /// The names of all modules.
    pub modules: &'a [&'a str],
    /// The module as it was composed, where that went well but the result is not valid.
    pub composed: Option<&'a naga::Module>,
}

impl Explainer<'_> {
    /// Explains an error.
    pub fn explain(&self, error: &ComposerError) -> Problem {
        let source = error.source.source(self.composer);
        let path = error.source.path(self.composer).as_str();
        let path = if path.is_empty() {
            self.listings.shader().path.as_str()
        } else {
            path
        };
        let file = File {
            path,
            composed: &source,
            offset: error.source.offset(),
            listings: self.listings,
        };
        let problem = match &error.inner {
            ComposerErrorInner::WgslParseError(parse) => syntax::explain(parse, &file),
            ComposerErrorInner::ShaderValidationError(invalid)
            | ComposerErrorInner::HeaderValidationError(invalid) => {
                let place = file.innermost(invalid.spans().map(|(span, _)| *span));
                let context = validity::Context {
                    module: self.composed,
                    listings: self.listings,
                    place: place.unwrap_or_else(|| Place::file(path)),
                };
                context.explain(invalid.as_inner())
            }
            ComposerErrorInner::ImportNotFound(name, at) => {
                unknown_module(name, file.place(*at), self.modules)
            }
            ComposerErrorInner::ImportParseError(message, at) => Problem::new(
                file.place(*at),
                format!("this import can't be read: {message}"),
            ),
            ComposerErrorInner::InvalidIdentifier { original, at } => {
                let name = undecorate(original);
                let listing = self.listings.of_path(path);
                let tokens = listing.map(|listing| tokens(&listing.active));
                let written = tokens.iter().flatten().find(|token| token.text == name);
                let written = written.map(|token| Place::new(path, token.line, token.column));
                let place = || {
                    at.to_range()
                        .and_then(|span| file.composed_place(span.start))
                };
                Problem::new(
                    written.or_else(place).unwrap_or_else(|| Place::file(path)),
                    format!("`{name}` can't be a name in a module"),
                )
                .with_hint(
                    "members of structures in shaders/lib must not end in a digit or an \
                     underscore, and no name there may be a word of the language",
                )
            }
            ComposerErrorInner::InvalidWgslDirective {
                directive,
                position,
                ..
            } => Problem::new(
                Place::new(path, *position as u32 + 1, 1),
                format!("`{}` can't be read", directive.trim()),
            ),
            ComposerErrorInner::DecorationInSource(range) => Problem::new(
                file.place(range.start),
                "a name in this file is one that only the program makes",
            )
            .with_hint("choose a name without `X_naga`"),
            ComposerErrorInner::OverrideNotVirtual { name, pos } => Problem::new(
                file.place(*pos),
                format!("`{name}` can't be replaced: its module does not call it virtual"),
            ),
            _ => Problem::new(
                Place::file(path),
                "this file can't be composed with its imports",
            ),
        };
        self.with_source(problem)
    }

    /// Adds the line of the file.
    pub fn with_source(&self, problem: Problem) -> Problem {
        let listing = self.listings.of_path(&problem.place.file);
        match listing.map(|listing| listing.text.clone()) {
            Some(text) => problem.with_source(&text),
            None => problem,
        }
    }
}

/// The file of an error: as it was written, and as the composer rewrote it.
pub(super) struct File<'a> {
    pub path: &'a str,
    /// The composer's version: lines are the same, but names are decorated.
    composed: &'a str,
    /// Where the file begins in the text that was parsed.
    offset: usize,
    pub listings: &'a Listings,
}

impl File<'_> {
    /// The place of a byte of the composer's version.
    fn place(&self, byte: usize) -> Place {
        let written = self.listings.of_path(self.path);
        let written = written.map_or(self.composed, |listing| listing.text.as_str());
        written_place(self.path, self.composed, written, byte)
    }

    /// The place of a byte of the text that was parsed, if it belongs to this file.
    pub fn composed_place(&self, byte: usize) -> Option<Place> {
        let local = (byte & ((1 << POSITION_BITS) - 1)).checked_sub(self.offset)?;
        (local <= self.composed.len()).then(|| self.place(local))
    }

    /// The text of the composer's version that a span covers.
    pub fn quoted(&self, span: &std::ops::Range<usize>) -> Option<&str> {
        let local = |byte: usize| (byte & ((1 << POSITION_BITS) - 1)).checked_sub(self.offset);
        self.composed.get(local(span.start)?..local(span.end)?)
    }

    /// The place of the last of some spans: that of the expression, not of the function around it
    /// or of what it uses.
    fn innermost(&self, spans: impl Iterator<Item = naga::Span>) -> Option<Place> {
        let spans: Vec<_> = spans.map(|span| span.to_range()).collect();
        // The composer tells about the file of the last span; others may lie in other files.
        let module = spans.last()?.as_ref()?.start >> POSITION_BITS;
        spans
            .into_iter()
            .flatten()
            .filter(|span| span.start >> POSITION_BITS == module)
            .filter_map(|span| Some((span.clone(), self.composed_place(span.start)?)))
            // Arguments are declared before the body in which they are misused.
            .max_by_key(|(span, _)| (span.start, std::cmp::Reverse(span.len())))
            .map(|(_, place)| place)
    }
}

/// The place in a file of a byte in the composer's version of it, in which lines are the same but
/// names are decorated: the same word of the same line, counted from the line's beginning.
fn written_place(file: &str, composed: &str, written: &str, byte: usize) -> Place {
    let place = place_of(file, composed, byte);
    let line = |text: &'_ str| {
        text.lines()
            .nth(place.line as usize - 1)
            .unwrap_or("")
            .to_owned()
    };
    let (composed, written) = (line(composed), line(written));
    if composed == written {
        return place;
    }
    let before: String = composed.chars().take(place.column as usize - 1).collect();
    let token: String = composed
        .chars()
        .skip(place.column as usize - 1)
        .take_while(|&c| is_word(c))
        .collect();
    let (before, token) = (undecorate(&before), undecorate(&token));
    let words = |text: &str| -> Vec<usize> {
        text.match_indices(token.as_str())
            .filter(|(at, _)| {
                !text[..*at].ends_with(is_word) && !text[*at + token.len()..].starts_with(is_word)
            })
            .map(|(at, _)| at)
            .collect()
    };
    let column = if token.is_empty() {
        before.chars().count().min(written.chars().count())
    } else {
        let at = words(&written).get(words(&before).len()).copied();
        at.map_or(before.chars().count(), |at| written[..at].chars().count())
    };
    Place::new(file, place.line, column as u32 + 1)
}

/// Line and column of a byte.
fn place_of(file: &str, text: &str, byte: usize) -> Place {
    let byte = (0..=byte.min(text.len()))
        .rev()
        .find(|&b| text.is_char_boundary(b))
        .unwrap_or(0);
    let before = &text[..byte];
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    Place::new(file, line as u32, column as u32)
}
