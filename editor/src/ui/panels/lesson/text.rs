//! The text of a lesson as widgets.

use egui::{Align, Frame, Image, RichText, TextStyle, Ui, WidgetText};
use lightbench::lab::lesson::{Block, Piece, Run};

use super::{Given, Wish};
use crate::ui::code::tokens::Language;
use crate::ui::lesson::Open;
use crate::ui::lesson::letters::shown;
use crate::ui::lesson::pictures::Shown;
use crate::ui::messages::message;
use crate::ui::panels::code::lines::listing;
use crate::ui::theme::Palette;

/// Points of a letter for which formulas are drawn as large as their files say.
const FORMULA_TEXT: f32 = 16.0;

/// Points of a letter of the text.
pub(super) const BODY: f32 = 13.0;

/// Draws the text, and goes to a place of it.
pub(super) fn show(open: &Open, going: &mut Option<String>, ui: &mut Ui, given: &mut Given) {
    if let Some(why) = &open.no_text {
        ui.label(RichText::new(why).color(Palette::of(ui).error));
    }
    let mut text = Text { open, going, given };
    text.blocks(&open.text, ui);
    // A place that the text does not have is nowhere to go to.
    *text.going = None;
    ui.add_space(40.0);
}

struct Text<'a, 'b> {
    open: &'a Open,
    going: &'a mut Option<String>,
    given: &'a mut Given<'b>,
}

impl Text<'_, '_> {
    fn blocks(&mut self, blocks: &[Block], ui: &mut Ui) {
        for (index, block) in blocks.iter().enumerate() {
            ui.push_id(index, |ui| self.block(block, ui));
        }
    }

    fn block(&mut self, block: &Block, ui: &mut Ui) {
        match block {
            Block::Place(name) => {
                if self.going.as_ref() == Some(name) {
                    ui.scroll_to_cursor(Some(Align::Min));
                    *self.going = None;
                }
            }
            Block::Heading { level, content } => {
                let (above, size) = match level {
                    1 => (0.0, 20.0),
                    2 => (14.0, 17.0),
                    _ => (8.0, 14.5),
                };
                ui.add_space(above);
                self.pieces(content, Some(size), ui);
                ui.add_space(2.0);
            }
            Block::Paragraph(pieces) => {
                self.pieces(pieces, None, ui);
                ui.add_space(4.0);
            }
            Block::List { first, items } => {
                for (index, item) in items.iter().enumerate() {
                    ui.horizontal_top(|ui| {
                        let mark = first.map_or_else(
                            || "•".to_owned(),
                            |first| format!("{}.", first + index as u64),
                        );
                        ui.label(mark);
                        ui.vertical(|ui| {
                            ui.push_id(index, |ui| self.blocks(item, ui));
                        });
                    });
                }
            }
            Block::Code {
                language,
                target,
                text,
            } => self.code(language, target.as_deref(), text, ui),
            Block::Figure { path, alt } => self.figure(path, alt, ui),
            Block::Quote(blocks) => {
                ui.indent("quote", |ui| self.blocks(blocks, ui));
            }
            Block::Table(rows) => {
                let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
                let grid = egui::Grid::new("table").striped(true).num_columns(columns);
                grid.show(ui, |ui| {
                    for (index, row) in rows.iter().enumerate() {
                        for cell in row {
                            // Cells are as wide as what is in them.
                            ui.horizontal(|ui| {
                                ui.spacing_mut().item_spacing.x = 0.0;
                                self.line(cell, (index == 0).then_some(BODY), ui);
                            });
                        }
                        ui.end_row();
                    }
                });
                ui.add_space(4.0);
            }
            Block::Rule => _ = ui.separator(),
        }
    }

    /// A paragraph, or a heading with letters of a size.
    fn pieces(&mut self, pieces: &[Piece], heading: Option<f32>, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = egui::vec2(0.0, 3.0);
            self.line(pieces, heading, ui);
        });
    }

    fn line(&mut self, pieces: &[Piece], heading: Option<f32>, ui: &mut Ui) {
        for piece in pieces {
            match piece {
                Piece::Run(run) => self.run(run, heading, ui),
                Piece::Break => ui.end_row(),
                Piece::Picture { path, alt } => self.picture(path, alt, ui),
            }
        }
    }

    fn run(&mut self, run: &Run, heading: Option<f32>, ui: &mut Ui) {
        let look = |mut text: RichText| {
            if run.strong || heading.is_some() {
                text = text.strong();
            }
            if run.emphasis {
                text = text.italics();
            }
            match run.code {
                true => text.code(),
                false => text,
            }
        };
        let size = heading.unwrap_or(BODY);
        let text = shown(ui, &run.text, size, look);
        match &run.link {
            Some(link) => {
                if ui.link(text).on_hover_text(link).clicked() {
                    *self.given.wish = Some(Wish::Follow(link.clone()));
                }
            }
            None => _ = ui.label(text),
        }
    }

    fn code(&mut self, language: &str, target: Option<&str>, text: &str, ui: &mut Ui) {
        let fill = ui.visuals().extreme_bg_color;
        Frame::new().fill(fill).inner_margin(6).show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.horizontal(|ui| {
                if let Some(target) = target
                    && ui.link(RichText::new(target).small()).clicked()
                {
                    *self.given.wish = Some(Wish::Follow(target.to_owned()));
                }
                let right = egui::Layout::right_to_left(Align::Center);
                ui.with_layout(right, |ui| {
                    let copy = self
                        .given
                        .say(message!("lesson.copy"), message!("lesson.copy_es"));
                    if ui.small_button(copy).clicked() {
                        ui.ctx().copy_text(text.to_owned());
                    }
                });
            });
            let language = match language {
                "rhai" => Language::Rhai,
                "wgsl" => Language::Wgsl,
                _ => Language::Other,
            };
            let job = listing(language, text.trim_end(), ui.visuals().dark_mode);
            // An area of its own to scroll would keep places and links from being scrolled to.
            ui.add(egui::Label::new(job).wrap());
        });
        ui.add_space(6.0);
    }

    fn figure(&mut self, path: &str, alt: &str, ui: &mut Ui) {
        ui.add_space(2.0);
        match self.load(path, ui) {
            Ok(picture) if picture.is_formula => {
                ui.horizontal(|ui| {
                    ui.add_space(16.0);
                    ui.add(image(&picture, alt, ui));
                });
            }
            Ok(picture) => {
                ui.add(image(&picture, alt, ui));
                ui.label(shown_small(ui, alt));
            }
            Err(why) => no_picture(&why, alt, ui),
        }
        ui.add_space(4.0);
    }

    /// A picture between words.
    fn picture(&mut self, path: &str, alt: &str, ui: &mut Ui) {
        match self.load(path, ui) {
            Ok(picture) => _ = ui.add(image(&picture, alt, ui)),
            Err(why) => no_picture(&why, alt, ui),
        }
    }

    fn load(&mut self, path: &str, ui: &Ui) -> Result<Shown, String> {
        let pictures = &mut self.given.panel.pictures;
        pictures.of_lesson(ui.ctx(), &self.open.lesson, path)
    }
}

/// Words below a picture.
fn shown_small(ui: &Ui, text: &str) -> WidgetText {
    shown(ui, text, 11.0, RichText::weak)
}

fn no_picture(why: &str, alt: &str, ui: &mut Ui) {
    let warning = Palette::of(ui).warning;
    let text = shown(ui, alt, BODY, |text| text.color(warning));
    ui.label(text).on_hover_text(why);
}

/// A picture no wider than the panel; a formula in the colour of the text, as large as its letters.
fn image(shown: &Shown, alt: &str, ui: &Ui) -> Image<'static> {
    let image = Image::new(&shown.texture).alt_text(alt);
    let fits = (ui.available_width() / shown.size.x).min(1.0);
    match shown.is_formula {
        true => {
            let body = ui.text_style_height(&TextStyle::Body) / 1.15;
            image
                .fit_to_exact_size(shown.size * (body / FORMULA_TEXT).min(fits))
                .tint(ui.visuals().strong_text_color())
        }
        false => image.fit_to_exact_size(shown.size * fits),
    }
}
