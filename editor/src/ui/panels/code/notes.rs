//! What there is to decide about a file, above its text.

use egui::{CornerRadius, Frame, Margin, RichText, ScrollArea, Stroke, Ui};

use crate::ui::code::Code;
use crate::ui::code::difference::{Side, compare};
use crate::ui::code::document::{Document, Outside};
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Lines around a change that are shown with it.
const AROUND: usize = 3;

/// What a person decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Go on with the text in the editor.
    Mine,
    /// Go on with the text of the file.
    Theirs,
    /// Bring a shipped file into the project.
    Copy,
    /// Make or open a project.
    Project,
    /// Open a text that a crash has left.
    Restore(usize),
    /// Throw it away.
    ThrowAway(usize),
}

fn frame(ui: &Ui, urgent: bool) -> Frame {
    let palette = Palette::of(ui);
    let (fill, line) = if urgent {
        (palette.error_fill, palette.error)
    } else {
        (ui.visuals().faint_bg_color, palette.accent)
    };
    Frame::new()
        .fill(fill)
        .stroke(Stroke::new(1.0, line))
        .corner_radius(CornerRadius::same(3))
        .inner_margin(Margin::symmetric(8, 5))
}

/// Texts that a crash has left.
pub fn offers(code: &Code, ui: &mut Ui) -> Option<Choice> {
    if code.offered.is_empty() {
        return None;
    }
    let mut choice = None;
    frame(ui, false).show(ui, |ui| {
        ui.label(say!("code.these_texts_were_not_saved_when"));
        for (index, draft) in code.offered.iter().enumerate() {
            ui.push_id(index, |ui| {
                ui.horizontal_wrapped(|ui| {
                    if ui.button(say!("code.open_the_text")).clicked() {
                        choice = Some(Choice::Restore(index));
                    }
                    if ui.button(say!("code.throw_it_away")).clicked() {
                        choice = Some(Choice::ThrowAway(index));
                    }
                    ui.label(RichText::new(&draft.path).monospace());
                });
            });
        }
    });
    choice
}

/// What there is to say about a file. `comparing` shows both texts of a conflict.
pub fn show(
    document: &Document,
    has_project: bool,
    comparing: &mut bool,
    ui: &mut Ui,
) -> Option<Choice> {
    let mut choice = None;
    if document.is_shipped() {
        frame(ui, false).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(say!("code.this_file_is_part_of_the"));
                if has_project {
                    if ui
                        .button(say!("code.copy_into_the_project_to_edit"))
                        .clicked()
                    {
                        choice = Some(Choice::Copy);
                    }
                } else if ui.button(say!("code.open_a_project_to_edit_it")).clicked() {
                    choice = Some(Choice::Project);
                }
            });
        });
    }
    match &document.outside {
        Some(outside) => choice = choice.or(conflict(document, outside, comparing, ui)),
        None => *comparing = false,
    }
    if let Some(failure) = &document.failure {
        frame(ui, true).show(ui, |ui| {
            let text = say!("code.not_saved", failure = failure);
            ui.label(RichText::new(text).color(Palette::of(ui).error));
        });
    }
    choice
}

fn conflict(
    document: &Document,
    outside: &Outside,
    comparing: &mut bool,
    ui: &mut Ui,
) -> Option<Choice> {
    let mut choice = None;
    frame(ui, true).show(ui, |ui| {
        let (text, theirs) = match outside {
            Outside::Changed(_) => (
                say!("code.the_file_was_changed_outside_and"),
                say!("code.take_theirs"),
            ),
            Outside::Deleted => (
                say!("code.the_file_was_deleted_or_moved"),
                say!("code.close_it"),
            ),
        };
        ui.label(text);
        ui.horizontal_wrapped(|ui| {
            if ui.button(say!("code.keep_mine")).clicked() {
                choice = Some(Choice::Mine);
            }
            if ui.button(theirs).clicked() {
                choice = Some(Choice::Theirs);
            }
            if matches!(outside, Outside::Changed(_)) {
                ui.toggle_value(comparing, say!("code.see_both"));
            }
        });
        if let (true, Outside::Changed(theirs)) = (*comparing, outside) {
            both(&document.text, theirs, ui);
        }
    });
    choice
}

/// Lines that differ, with some around them.
fn both(mine: &str, theirs: &str, ui: &mut Ui) {
    let palette = Palette::of(ui);
    let lines = compare(theirs, mine);
    let mut shown = vec![false; lines.len()];
    for (index, (side, _)) in lines.iter().enumerate() {
        if *side != Side::Both {
            let end = (index + AROUND + 1).min(lines.len());
            shown[index.saturating_sub(AROUND)..end].fill(true);
        }
    }
    let mut rows: Vec<Option<(Side, &str)>> = Vec::new();
    for (line, shown) in lines.iter().zip(shown) {
        if shown {
            rows.push(Some(*line));
        } else if rows.last().is_some_and(Option::is_some) {
            rows.push(None);
        }
    }
    ui.horizontal(|ui| {
        ui.label(RichText::new(say!("code.mine")).color(palette.gpu));
        ui.label(RichText::new(say!("code.theirs")).color(palette.cpu));
    });
    let height = ui.text_style_height(&egui::TextStyle::Monospace);
    let most = (ui.available_height() * 0.5).max(80.0);
    let area = ScrollArea::both()
        .id_salt("both")
        .max_height(most)
        .auto_shrink([false, true]);
    ui.spacing_mut().item_spacing.y = 1.0;
    area.show_rows(ui, height, rows.len(), |ui, range| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        for row in &rows[range] {
            let (sign, line, color) = match row {
                Some((Side::Both, line)) => (' ', *line, ui.visuals().text_color()),
                Some((Side::First, line)) => ('-', *line, palette.cpu),
                Some((Side::Second, line)) => ('+', *line, palette.gpu),
                None => (' ', "…", ui.visuals().weak_text_color()),
            };
            let text = RichText::new(format!("{sign} {line}")).monospace();
            ui.label(text.color(color));
        }
    });
}
