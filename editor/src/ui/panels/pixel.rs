//! What each pass did to one pixel.

use egui::{RichText, ScrollArea, Ui};
use egui_extras::{Column, TableBuilder};

use super::pixel_light;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::probing::Probing;

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let ready = workbench.picture_ready();
    ui.horizontal_wrapped(|ui| {
        let find = ui.add_enabled(ready, egui::Button::new(say!("pixel.find_invalid_numbers")));
        let find = find.on_hover_text(say!("pixel.names_the_first_pass_that_leaves"));
        if find.clicked() {
            workbench.find_invalid();
        }
        if let Some((x, y)) = workbench.probing.pixel {
            ui.label(RichText::new(say!("pixel.pixel", x = x, y = y)).monospace());
            if ui.button(say!("pixel.read_again")).clicked() {
                workbench.probe_again();
            }
        }
        if workbench.probing.is_waiting() {
            ui.spinner();
        }
    });
    pixel_light::choose(editor, ui);
    let workbench = &editor.workbench;
    let probing = &workbench.probing;
    let other = workbench.pipelines.shown() != Some(probing.pipeline.as_str());
    if other || probing.values.is_empty() && probing.invalid.is_none() {
        let text = say!("pixel.click_a_pixel_of_the_picture");
        ui.label(RichText::new(text).weak());
        return;
    }
    if let Some(text) = &probing.invalid {
        ui.label(text);
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        pixel_light::show(editor, ui);
        values(editor, ui);
    });
}

/// What each pass did to each target.
fn values(editor: &Editor, ui: &mut Ui) {
    let probing = &editor.workbench.probing;
    let palette = Palette::of(ui);
    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
    let row = ui.text_style_height(&egui::TextStyle::Monospace) + 3.0;
    ScrollArea::horizontal().id_salt("values").show(ui, |ui| {
        table(ui, probing, palette, row);
    });
}

fn table(ui: &mut Ui, probing: &Probing, palette: Palette, row: f32) {
    let table = TableBuilder::new(ui)
        .striped(true)
        .vscroll(false)
        .columns(Column::auto().at_least(70.0), 4);
    let table = table.header(row, |mut header| {
        for title in [
            say!("pixel.pass"),
            say!("pixel.target"),
            say!("pixel.before"),
            say!("pixel.after"),
        ] {
            header.col(|ui| {
                ui.strong(title);
            });
        }
    });
    table.body(|body| {
        body.rows(row, probing.values.len(), |mut line| {
            let written = &probing.values[line.index()];
            line.col(|ui| {
                ui.label(&written.pass);
            });
            line.col(|ui| {
                ui.label(RichText::new(&written.target).monospace());
            });
            let before = written
                .before
                .as_deref()
                .unwrap_or(say!("pixel.not_written_yet"));
            let same = written.before.as_ref() == Some(&written.after);
            line.col(|ui| {
                ui.label(RichText::new(before).monospace().weak());
            });
            line.col(|ui| {
                let mut text = RichText::new(&written.after).monospace();
                if !written.is_finite {
                    text = text.color(palette.error);
                } else if same {
                    text = text.weak();
                }
                ui.label(text);
            });
        });
    });
}
