//! What was done, as lines of scripts.

use egui::{RichText, ScrollArea, Ui};

use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::history::Deed;

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let history = &mut editor.workbench.history;
    let count = history.deeds().len();
    if count == 0 {
        let text = say!("actions.what_you_change_in_the_editor");
        ui.label(RichText::new(text).weak());
        return;
    }
    let mut clear = false;
    ui.horizontal(|ui| {
        if ui.small_button(say!("actions.copy_all")).clicked() {
            let all: Vec<String> = history.deeds().map(Deed::copied).collect();
            ui.ctx().copy_text(all.join("\n"));
        }
        clear = ui.small_button(say!("actions.clear")).clicked();
    });
    let palette = Palette::of(ui);
    let row = ui.spacing().interact_size.y;
    let area = ScrollArea::both().auto_shrink(false).stick_to_bottom(true);
    ui.spacing_mut().item_spacing.y = 1.0;
    area.show_rows(ui, row, count, |ui, range| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        for (index, deed) in history
            .deeds()
            .enumerate()
            .skip(range.start)
            .take(range.len())
        {
            ui.push_id(index, |ui| {
                ui.horizontal(|ui| {
                    ui.set_height(row);
                    if ui.small_button(say!("actions.copy")).clicked() {
                        ui.ctx().copy_text(deed.copied());
                    }
                    let about = format!("{}: {}", deed.script.name(), deed.what);
                    ui.label(RichText::new(about).color(palette.accent));
                    ui.label(RichText::new(&deed.line).monospace());
                });
            });
        }
    });
    if clear {
        history.clear();
    }
}
