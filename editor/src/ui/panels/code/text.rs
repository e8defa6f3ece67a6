//! The text field of a file: line numbers, the text, and what compilers say about its lines.

use std::ops::Range;
use std::sync::Arc;

use egui::text::{CCursor, CCursorRange};
use egui::text_edit::{TextEditOutput, TextEditState};
use egui::{
    Align, Align2, Color32, Event, Frame, Galley, Id, Key, Modifiers, Rangef, Rect, RichText,
    ScrollArea, Shape, Stroke, TextBuffer, TextEdit, Ui, pos2, vec2,
};

use super::lines::{Lines, font};
use crate::ui::code::Spot;
use crate::ui::code::document::Document;
use crate::ui::code::search::{byte_of, byte_of_place, letters_before};
use crate::ui::code::tokens::Language;
use crate::ui::code::typing::{self, Edit};
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Something that is wrong with a line of the text as it is now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// From 1.
    pub line: usize,
    /// From 1; 0 where it is the whole line.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// The way out.
    pub hint: Option<String>,
}

/// What is shown with a text.
pub struct Shown<'a> {
    /// What is wrong with it.
    pub marks: &'a [Mark],
    /// What a person searches for, in bytes.
    pub found: &'a [Range<usize>],
    /// What is to be chosen and brought into sight, in bytes.
    pub go: Option<Range<usize>>,
    /// Whether the text gets the keys.
    pub focus: bool,
}

/// The text field.
#[derive(Default)]
pub struct TextField {
    lines: Lines,
    /// The file that was shown last.
    path: String,
    /// How high the field was: the caret stays in sight where that changes.
    height: f32,
    /// The letters that are chosen, for who acts on them.
    pub chosen: Range<usize>,
    /// Whether the field had the keys.
    pub has_keys: bool,
}

/// The name under which egui keeps caret and undo of a file.
fn id_of(document: &Document) -> Id {
    Id::unique(("code", &document.path))
}

/// The bytes of a place.
pub fn range_of(text: &str, spot: Spot) -> Range<usize> {
    let at = byte_of_place(text, spot.line, spot.column);
    at..at
}

impl TextField {
    /// Draws the field in what is left of the panel.
    pub fn show(&mut self, ui: &mut Ui, document: &mut Document, shown: &Shown) {
        let id = id_of(document);
        let language = Language::of(&document.path);
        let editable = !document.is_shipped();
        let has_keys = ui.memory(|memory| memory.has_focus(id));
        let wrote = editable && has_keys && line_keys(ui, document, id, language);
        if self.path != document.path {
            self.path.clone_from(&document.path);
            self.chosen = chosen_letters(ui, id);
        }
        if let Some(range) = &shown.go {
            let letters = |byte| letters_before(&document.text, byte);
            self.chosen = letters(range.start)..letters(range.end);
            choose(ui, id, self.chosen.clone());
        }
        if shown.focus {
            ui.memory_mut(|memory| memory.request_focus(id));
        }

        let whole = self.lines.lay_out(ui, language, &document.text);
        let digits = whole.rows.len().to_string().len().max(3) as f32;
        let letter = ui.fonts_mut(|fonts| fonts.glyph_width(&font(), '0'));
        let area = ui.available_rect_before_wrap();
        let gutter = Rect::from_min_size(area.min, vec2((digits + 2.0) * letter, area.height()));
        let field = Rect::from_min_max(pos2(gutter.right(), area.top()), area.max);
        ui.painter()
            .rect_filled(area, 2.0, ui.visuals().extreme_bg_color);
        let mut inner = ui.new_child(egui::UiBuilder::new().max_rect(field).id_salt("text"));
        inner.set_clip_rect(field.intersect(ui.clip_rect()));
        let scroll = ScrollArea::both()
            .id_salt(id)
            .auto_shrink(false)
            .show(&mut inner, |ui| {
                let behind = ui.painter().add(Shape::Noop);
                let output = self.edit(ui, document, id, language, &whole);
                ui.ctx()
                    .accesskit_node_builder(id, |node| node.set_label(document.path.as_str()));
                let shapes = backgrounds(ui, &output, shown, &self.chosen);
                ui.painter().set(behind, shapes);
                marks(ui, &output, document, shown.marks);
                let follows = wrote || self.height != area.height();
                if let Some(range) = output.cursor_range.filter(|_| follows) {
                    let caret = output.galley.pos_from_cursor(range.primary);
                    ui.scroll_to_rect(caret.translate(output.galley_pos.to_vec2()), None);
                }
                if let Some(range) = &shown.go {
                    let caret = CCursor::new(letters_before(&document.text, range.start));
                    let place = output.galley.pos_from_cursor(caret);
                    // The beginning of the line stays in sight where its place is near.
                    let width = ui.clip_rect().width();
                    let x_range = if place.right() + 40.0 < width {
                        Rangef::new(0.0, width)
                    } else {
                        place.x_range().expand(40.0)
                    };
                    let place = Rect::from_x_y_ranges(x_range, place.y_range());
                    let place = place.translate(output.galley_pos.to_vec2());
                    ui.scroll_to_rect(place, Some(Align::Center));
                }
                (output.galley, output.galley_pos)
            });
        self.height = area.height();
        let (galley, at) = scroll.inner;
        numbers(ui, gutter, &galley, at.y, shown.marks);
        ui.advance_cursor_after_rect(area);
    }

    fn edit(
        &mut self,
        ui: &mut Ui,
        document: &mut Document,
        id: Id,
        language: Language,
        whole: &Galley,
    ) -> TextEditOutput {
        let width = whole.size().x + 60.0;
        let height = ui.available_height();
        let editable = !document.is_shipped();
        let lines = &mut self.lines;
        let mut layouter =
            |ui: &Ui, text: &dyn TextBuffer, _: f32| lines.lay_out(ui, language, text.as_str());
        let mut fixed = document.text.as_str();
        let text: &mut dyn TextBuffer = if editable {
            &mut document.text
        } else {
            &mut fixed
        };
        let output = TextEdit::multiline(text)
            .id(id)
            .font(font())
            .frame(Frame::NONE)
            .desired_width(f32::INFINITY)
            .min_size(vec2(width, height))
            .lock_focus(true)
            .cursor_at_end(false)
            .layouter(&mut layouter)
            .show(ui);
        if output.response.changed() {
            document.touch();
        }
        self.has_keys = output.response.has_focus();
        if let Some(range) = output.cursor_range {
            let letters = range.as_sorted_char_range();
            self.chosen = letters.start.0..letters.end.0;
        }
        output
    }
}

/// Enter and Tab write more than one letter. Each takes its turn among the letters that were typed
/// since the last frame.
fn longer_letters(ui: &Ui, text: &str, chosen: &Range<usize>) {
    let mut before = typing::line_before(text, chosen.start).to_owned();
    ui.input_mut(|input| {
        for event in &mut input.events {
            let written = match event {
                Event::Text(letters) => {
                    before.push_str(letters);
                    continue;
                }
                Event::Key {
                    key,
                    pressed: true,
                    modifiers,
                    ..
                } if modifiers.is_none() => match key {
                    Key::Enter => typing::line_break(&before),
                    Key::Tab => typing::blanks(&before),
                    _ => continue,
                },
                _ => continue,
            };
            let start = written.rfind('\n').map(|at| at + 1);
            match start {
                Some(start) => written[start..].clone_into(&mut before),
                None => before.push_str(&written),
            }
            // The field takes a bare line's end from the key alone.
            if written != "\n" {
                *event = Event::Text(written);
            }
        }
    });
}

/// Keys that change whole lines. Returns whether one was pressed.
fn line_keys(ui: &Ui, document: &mut Document, id: Id, language: Language) -> bool {
    let press = |modifiers, key| ui.input_mut(|input| input.consume_key(modifiers, key));
    let chosen = chosen_letters(ui, id);
    let text = &document.text;
    let edit = if press(Modifiers::SHIFT, Key::Tab) {
        typing::outdent(text, &chosen)
    } else if typing::has_lines(text, &chosen) && press(Modifiers::NONE, Key::Tab) {
        typing::indent(text, &chosen)
    } else if press(Modifiers::COMMAND, Key::Slash) {
        typing::toggle_comment(text, &chosen, language.comment())
    } else {
        longer_letters(ui, text, &chosen);
        return false;
    };
    write(ui, document, id, &edit);
    true
}

/// The letters that a field has chosen, in order.
fn chosen_letters(ui: &Ui, id: Id) -> Range<usize> {
    let state = TextEditState::load(ui.ctx(), id);
    let range = state.and_then(|state| state.cursor.char_range());
    let letters = range.unwrap_or_default().as_sorted_char_range();
    letters.start.0..letters.end.0
}

/// Makes a change that can be taken back as what is typed.
fn write(ui: &Ui, document: &mut Document, id: Id, edit: &Edit) {
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    let mut undoer = state.undoer();
    let before = state.cursor.char_range().unwrap_or_default();
    undoer.add_undo(&(before, document.text.clone()));
    state.set_undoer(undoer);
    edit.apply(&mut document.text);
    document.touch();
    let chosen = range_of_letters(&edit.chosen);
    state.cursor.set_char_range(Some(chosen));
    state.store(ui.ctx(), id);
}

fn range_of_letters(letters: &Range<usize>) -> CCursorRange {
    CCursorRange::two(CCursor::new(letters.start), CCursor::new(letters.end))
}

/// Chooses letters of a field.
fn choose(ui: &Ui, id: Id, letters: Range<usize>) {
    let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
    state
        .cursor
        .set_char_range(Some(range_of_letters(&letters)));
    state.store(ui.ctx(), id);
}

/// The rows of a galley that can be seen.
fn rows_in_sight(galley: &Galley, top: f32, clip: Rect) -> Range<usize> {
    let rows = &galley.rows;
    let first = rows.partition_point(|row| top + row.pos.y + row.size.y < clip.top());
    let last = rows.partition_point(|row| top + row.pos.y < clip.bottom());
    first..last
}

/// Behind the text: the line of the caret, lines with mistakes, and what was found.
fn backgrounds(ui: &Ui, output: &TextEditOutput, shown: &Shown, chosen: &Range<usize>) -> Shape {
    let palette = Palette::of(ui);
    let clip = ui.clip_rect();
    let (galley, at) = (&output.galley, output.galley_pos);
    let mut shapes = Vec::new();
    let band = |row: usize| {
        let row = galley.rows.get(row)?;
        let top = at.y + row.pos.y;
        let whole =
            Rect::from_min_max(pos2(clip.left(), top), pos2(clip.right(), top + row.size.y));
        clip.intersects(whole).then_some(whole)
    };
    if let Some(range) = output.cursor_range.filter(|_| output.response.has_focus()) {
        let row = galley.layout_from_cursor(range.primary).row;
        let faint = ui.visuals().faint_bg_color;
        shapes.extend(band(row).map(|rect| Shape::rect_filled(rect, 0.0, faint)));
    }
    for mark in shown.marks {
        let fill = palette.error.gamma_multiply(0.14);
        let rect = band(mark.line.saturating_sub(1));
        shapes.extend(rect.map(|rect| Shape::rect_filled(rect, 0.0, fill)));
    }
    let sight = rows_in_sight(galley, at.y, clip);
    let text = galley.job.text.as_str();
    let (from, to) = bytes_of_rows(text, &sight);
    let first = shown.found.partition_point(|found| found.end < from);
    for found in shown.found[first..]
        .iter()
        .take_while(|found| found.start < to)
    {
        let letters = letters_before(text, found.start)..letters_before(text, found.end);
        let is_chosen = letters == *chosen;
        let strength = if is_chosen { 0.6 } else { 0.25 };
        let fill = palette.warning.gamma_multiply(strength);
        let place = |letter| galley.pos_from_cursor(CCursor::new(letter));
        let (start, end) = (place(letters.start), place(letters.end));
        let rect = Rect::from_min_max(start.left_top(), end.right_bottom());
        shapes.push(Shape::rect_filled(rect.translate(at.to_vec2()), 1.0, fill));
    }
    Shape::Vec(shapes)
}

/// The bytes of some lines.
fn bytes_of_rows(text: &str, rows: &Range<usize>) -> (usize, usize) {
    let mut ends = text.match_indices('\n').map(|(at, _)| at + 1);
    let from = match rows.start {
        0 => 0,
        start => ends.nth(start - 1).unwrap_or(text.len()),
    };
    let to = match rows.len() {
        0 => from,
        length => ends.nth(length - 1).unwrap_or(text.len()),
    };
    (from, to)
}

/// Over the text: what is wrong is underlined, and said behind the line.
fn marks(ui: &Ui, output: &TextEditOutput, document: &Document, marks: &[Mark]) {
    let palette = Palette::of(ui);
    let (galley, at) = (&output.galley, output.galley_pos);
    let hovered = output.response.hover_pos();
    let mut told_at: Vec<usize> = Vec::new();
    for mark in marks {
        let Some(row) = galley.rows.get(mark.line.saturating_sub(1)) else {
            continue;
        };
        let rect = row.rect().translate(at.to_vec2());
        if !ui.clip_rect().intersects(rect.expand(2.0)) {
            continue;
        }
        let word = wrong_letters(&row.text(), mark.column);
        let x = |letter: usize| rect.left() + row.x_offset(letter.into());
        let (left, right) = (x(word.start), x(word.end).max(x(word.start) + 6.0));
        ui.painter()
            .add(wave(left, right, rect.bottom() - 1.0, palette.error));
        if !told_at.contains(&mark.line) {
            told_at.push(mark.line);
            let place = pos2(rect.right().max(right) + 22.0, rect.center().y);
            ui.painter().text(
                place,
                Align2::LEFT_CENTER,
                &mark.message,
                egui::FontId::proportional(12.0),
                palette.error,
            );
        }
        let over = hovered.is_some_and(|pointer| rect.y_range().contains(pointer.y));
        if over {
            output.response.show_tooltip_ui(|ui| {
                ui.label(RichText::new(&mark.message).color(palette.error));
                if let Some(hint) = &mark.hint {
                    ui.label(RichText::new(hint).italics());
                }
                if document.is_unsaved() {
                    ui.label(RichText::new(say!("code.said_of_the_text_that_was")).weak());
                }
            });
        }
    }
}

/// The letters of a line that a mistake is about: the word at its column, or all that is written.
fn wrong_letters(line: &str, column: usize) -> Range<usize> {
    let letters: Vec<char> = line.chars().collect();
    let first = letters.iter().take_while(|c| c.is_whitespace()).count();
    let Some(start) = column.checked_sub(1).filter(|start| *start < letters.len()) else {
        return first..letters.len();
    };
    let is_word = |c: &&char| c.is_alphanumeric() || **c == '_';
    let length = letters[start..].iter().take_while(is_word).count();
    start..start + length.max(1)
}

fn wave(left: f32, right: f32, y: f32, color: Color32) -> Shape {
    let count = ((right - left) / 2.5).ceil().max(1.0) as usize;
    let point = |i: usize| {
        let x = (left + 2.5 * i as f32).min(right);
        pos2(
            x,
            if i.is_multiple_of(2) {
                y + 1.2
            } else {
                y - 1.2
            },
        )
    };
    Shape::line((0..=count).map(point).collect(), Stroke::new(1.2, color))
}

/// The numbers of the lines, those with mistakes in red.
fn numbers(ui: &Ui, gutter: Rect, galley: &Arc<Galley>, top: f32, marks: &[Mark]) {
    let palette = Palette::of(ui);
    let painter = ui.painter_at(gutter);
    for row in rows_in_sight(galley, top, gutter) {
        let line = row + 1;
        let wrong = marks.iter().any(|mark| mark.line == line);
        let color = if wrong {
            palette.error
        } else {
            ui.visuals().weak_text_color()
        };
        let placed = &galley.rows[row];
        let y = top + placed.pos.y + 0.5 * placed.size.y;
        painter.text(
            pos2(gutter.right() - 9.0, y),
            Align2::RIGHT_CENTER,
            line.to_string(),
            font(),
            color,
        );
    }
}

/// Line and column, from 1, of a letter.
pub fn line_and_column(text: &str, letter: usize) -> (usize, usize) {
    let before = &text[..byte_of(text, letter)];
    let line = before.matches('\n').count() + 1;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (line, before[start..].chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_is_about_the_word_at_its_column() {
        assert_eq!(wrong_letters("  let ä1 = x;", 7), 6..8);
        assert_eq!(
            wrong_letters("  let a = x;", 9),
            8..9,
            "a sign is one letter"
        );
        assert_eq!(wrong_letters("  let a;  ", 0), 2..10);
        assert_eq!(wrong_letters("ab", 99), 0..2);
        assert_eq!(wrong_letters("", 1), 0..0);
    }

    #[test]
    fn rows_and_bytes() {
        let text = "a\nbc\n\nd";
        assert_eq!(bytes_of_rows(text, &(0..1)), (0, 2));
        assert_eq!(bytes_of_rows(text, &(1..3)), (2, 6));
        assert_eq!(bytes_of_rows(text, &(3..9)), (6, 7));
        assert_eq!(bytes_of_rows(text, &(2..2)), (5, 5));
        assert_eq!(line_and_column(text, 4), (2, 3));
        assert_eq!(line_and_column(text, 0), (1, 1));
    }
}
