//! Finding words in the file, and going to a line.

use std::ops::Range;

use egui::{Key, Modifiers, TextEdit, Ui};

use crate::ui::code::Spot;
use crate::ui::code::document::Document;
use crate::ui::code::search::{byte_of, find_all};
use crate::ui::messages::say;

/// What the places found were found in.
#[derive(PartialEq, Eq)]
struct Made {
    path: String,
    edits: u64,
    wanted: String,
    match_case: bool,
}

/// The bars for words and for a line.
#[derive(Default)]
pub struct Find {
    /// Whether words are searched for.
    pub is_open: bool,
    wanted: String,
    match_case: bool,
    made: Option<Made>,
    found: Vec<Range<usize>>,
    /// Which of them was gone to last.
    at: usize,
    /// What is typed as the line to go to.
    line: Option<String>,
    /// A field that opened gets the keys.
    focus: bool,
    /// Whether one of the fields had the keys.
    pub has_keys: bool,
}

/// What a bar asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Choose these bytes; the field of the bar keeps the keys.
    Choose(Range<usize>),
    /// Go there and go on typing.
    Go(Spot),
    /// Go on typing.
    Back,
}

impl Find {
    /// Opens the bar for words, with the word that is chosen.
    pub fn open(&mut self, document: &Document, chosen: &Range<usize>) {
        let text = &document.text;
        let word = &text[byte_of(text, chosen.start)..byte_of(text, chosen.end)];
        if !word.is_empty() && !word.contains('\n') {
            word.clone_into(&mut self.wanted);
        }
        self.is_open = true;
        self.focus = true;
    }

    /// Opens the bar for a line.
    pub fn open_line(&mut self) {
        self.line = Some(String::new());
        self.focus = true;
    }

    /// What was found.
    pub fn found(&self) -> &[Range<usize>] {
        if self.is_open { &self.found } else { &[] }
    }

    /// Goes to the next place behind a byte, or to the one before it, around the ends.
    pub fn step(&mut self, from: usize, forwards: bool) -> Option<Wish> {
        let count = self.found.len();
        if count == 0 {
            return None;
        }
        let behind = self.found.partition_point(|found| found.start < from);
        self.at = if forwards {
            behind % count
        } else {
            (behind + count - 1) % count
        };
        Some(Wish::Choose(self.found[self.at].clone()))
    }

    /// Draws the bars that are open. `chosen` are the letters chosen in the text.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        document: &Document,
        chosen: &Range<usize>,
    ) -> Option<Wish> {
        self.has_keys = false;
        let mut wish = None;
        if self.line.is_some() {
            wish = self.show_line(ui, document);
        }
        if self.is_open {
            self.refresh(document);
            wish = wish.or(self.show_words(ui, document, chosen));
        }
        wish
    }

    fn refresh(&mut self, document: &Document) {
        let made = Made {
            path: document.path.clone(),
            edits: document.edits(),
            wanted: self.wanted.clone(),
            match_case: self.match_case,
        };
        if self.made.as_ref() != Some(&made) {
            self.found = find_all(&document.text, &self.wanted, self.match_case);
            self.at = self.at.min(self.found.len().saturating_sub(1));
            self.made = Some(made);
        }
    }

    fn show_words(
        &mut self,
        ui: &mut Ui,
        document: &Document,
        chosen: &Range<usize>,
    ) -> Option<Wish> {
        let mut wish = None;
        ui.horizontal(|ui| {
            let label = ui.label(say!("code.find"));
            let field = TextEdit::singleline(&mut self.wanted).desired_width(150.0);
            let field = ui.add(field).labelled_by(label.id);
            if std::mem::take(&mut self.focus) {
                field.request_focus();
            }
            self.has_keys |= field.has_focus();
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let escaped = (field.lost_focus() || field.has_focus())
                && ui.input(|input| input.key_pressed(Key::Escape));
            let case = ui.checkbox(&mut self.match_case, say!("code.case"));
            if field.changed() || case.changed() {
                self.refresh(document);
            }
            let shift = ui.input(|input| input.modifiers.shift);
            let from = byte_of(&document.text, chosen.start);
            let behind = byte_of(&document.text, chosen.end);
            let previous = ui.button(say!("code.previous")).clicked();
            let next = ui.button(say!("code.next")).clicked();
            if field.changed() {
                // What is typed is looked for from where the caret is.
                wish = self.step(from, true);
            } else if next || entered && !shift {
                wish = self.step(behind, true);
            } else if previous || entered {
                wish = self.step(from, false);
            }
            if entered {
                field.request_focus();
            }
            let count = self.found.len();
            ui.weak(match count {
                _ if self.wanted.is_empty() => String::new(),
                0 => say!("code.not_found").to_owned(),
                count => say!("code.of", at = self.at + 1, count = count),
            });
            if ui.small_button(say!("code.close")).clicked() || escaped {
                self.is_open = false;
                self.has_keys = false;
                wish = Some(Wish::Back);
            }
        });
        wish
    }

    fn show_line(&mut self, ui: &mut Ui, document: &Document) -> Option<Wish> {
        let typed = self.line.as_mut()?;
        let mut wish = None;
        ui.horizontal(|ui| {
            let label = ui.label(say!("code.go_to_line"));
            let field = TextEdit::singleline(typed).desired_width(70.0);
            let field = ui.add(field).labelled_by(label.id);
            if std::mem::take(&mut self.focus) {
                field.request_focus();
            }
            self.has_keys |= field.has_focus();
            let lines = document.text.matches('\n').count() + 1;
            ui.weak(say!("code.lines_to", lines = lines));
            let press = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
            if field.lost_focus() || field.has_focus() {
                if press(Key::Enter) {
                    let line = typed.trim().parse().ok();
                    let spot = line.map(|line: usize| Spot {
                        line: line.clamp(1, lines),
                        column: 1,
                    });
                    wish = Some(spot.map_or(Wish::Back, Wish::Go));
                } else if press(Key::Escape) || field.lost_focus() {
                    wish = Some(Wish::Back);
                }
            }
        });
        if wish.is_some() {
            self.line = None;
            self.has_keys = false;
        }
        wish
    }
}
