//! What each pass did to one pixel.

use egui::{RichText, ScrollArea, Ui};
use egui_extras::{Column, TableBuilder};

use super::pixel_light;
use crate::ui::editor::Editor;
use crate::ui::theme::Palette;
use crate::ui::workbench::probing::Probing;

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let ready = workbench.picture_ready();
    ui.horizontal_wrapped(|ui| {
        let find = ui.add_enabled(ready, egui::Button::new("Find invalid numbers"));
        let find = find.on_hover_text(
            "Names the first pass that leaves a value which is no number, or infinite.",
        );
        if find.clicked() {
            workbench.find_invalid();
        }
        if let Some((x, y)) = workbench.probing.pixel {
            ui.label(RichText::new(format!("Pixel {x}, {y}")).monospace());
            if ui.button("Read again").clicked() {
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
        let text = "Click a pixel of the picture to see what each pass does to it.";
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
        for title in ["Pass", "Target", "Before", "After"] {
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
            let before = written.before.as_deref().unwrap_or("not written yet");
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
