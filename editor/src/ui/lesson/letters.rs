//! Letters that the editor's fonts do not have: those that stand raised or lowered, as in `xⁿ` and `aᵢ`.
//! They are drawn as small letters in their place.

use egui::text::LayoutJob;
use egui::{Align, FontSelection, RichText, Ui, WidgetText};

/// Raised letters, each before the letter that it is.
const RAISED: &str =
    "ᵃaᵇbᶜcᵈdᵉeᶠfᵍgʰhⁱiʲjᵏkˡlᵐmⁿnᵒoᵖpʳrˢsᵗtᵘuᵛvʷwˣxʸyᶻzᴬAᴮBᴰDᴱEᴴHᴵIᴶJᴷKᴸLᴹMᴺNᴼOᴾPᴿRᵀTᵁUᵂW⁻-⁺+";
/// Lowered letters, each before the letter that it is.
const LOWERED: &str = "ₐaₑeₕhᵢiⱼjₖkₗlₘmₙnₒoₚpᵣrₛsₜtᵤuᵥvₓx";
/// How large they are beside the others.
pub const SMALLER: f32 = 0.74;

/// Where letters stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// On the line.
    Line,
    /// Above.
    Raised,
    /// Below.
    Lowered,
}

impl Level {
    /// The same for who lays out text.
    pub fn align(self) -> Align {
        match self {
            Self::Line | Self::Lowered => Align::BOTTOM,
            Self::Raised => Align::TOP,
        }
    }
}

fn letter(c: char) -> (char, Level) {
    let plain = |pairs: &str| {
        let mut letters = pairs.chars();
        letters.find(|known| *known == c)?;
        letters.next()
    };
    // No letter of the alphabet is looked for: it would be found as what another one is.
    if c.is_ascii() {
        return (c, Level::Line);
    }
    let raised = plain(RAISED).map(|plain| (plain, Level::Raised));
    let lowered = || plain(LOWERED).map(|plain| (plain, Level::Lowered));
    raised.or_else(lowered).unwrap_or((c, Level::Line))
}

/// A text in parts that stand on one level.
pub fn parts(text: &str) -> Vec<(String, Level)> {
    let mut parts: Vec<(String, Level)> = Vec::new();
    for (plain, level) in text.chars().map(letter) {
        match parts.last_mut() {
            Some((last, known)) if *known == level => last.push(plain),
            _ => parts.push((plain.to_string(), level)),
        }
    }
    parts
}

/// A text as a widget shows it. `look` gives it its looks, with letters of a size.
pub fn shown(ui: &Ui, text: &str, size: f32, look: impl Fn(RichText) -> RichText) -> WidgetText {
    let parts = parts(text);
    if parts.iter().all(|(_, level)| *level == Level::Line) {
        return look(RichText::new(text).size(size)).into();
    }
    let mut job = LayoutJob::default();
    for (part, level) in parts {
        let size = if level == Level::Line {
            size
        } else {
            size * SMALLER
        };
        let part = look(RichText::new(part).size(size));
        let font = FontSelection::Default;
        part.append_to(&mut job, ui.style(), font, level.align());
    }
    job.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn raised_and_lowered_letters_are_told_apart() {
        let part = |text: &str, level| (text.to_owned(), level);
        assert_eq!(
            parts("k (N·H)ⁿ Eᵢₓ²"),
            [
                part("k (N·H)", Level::Line),
                part("n", Level::Raised),
                part(" E", Level::Line),
                part("ix", Level::Lowered),
                part("²", Level::Line),
            ]
        );
        assert_eq!(parts("nax"), [part("nax", Level::Line)]);
        assert!(parts("").is_empty());
    }
}
