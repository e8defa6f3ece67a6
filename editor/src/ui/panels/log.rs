//! The log panel.

use egui::{Align, Layout, RichText, ScrollArea, Ui};

use crate::ui::editor::Editor;
use crate::ui::theme::Palette;
use crate::ui::workbench::log::Level;

/// Draws the log.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let log = &mut editor.workbench.log;
    let mut clear = false;
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        ui.vertical(|ui| {
            clear = ui.small_button("Clear").clicked();
        });
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            let palette = Palette::of(ui);
            let row = ui.text_style_height(&egui::TextStyle::Monospace) + 3.0;
            ui.spacing_mut().item_spacing.y = 3.0;
            let count = log.lines().len();
            let area = ScrollArea::both().auto_shrink(false).stick_to_bottom(true);
            area.show_rows(ui, row - 3.0, count, |ui, range| {
                for line in log.lines().skip(range.start).take(range.len()) {
                    ui.horizontal(|ui| {
                        ui.label(RichText::new(format!("{:8.2}", line.at)).monospace().weak());
                        let color = match line.level {
                            Level::Info | Level::Script => ui.visuals().text_color(),
                            Level::Warning => palette.warning,
                            Level::Error => palette.error,
                        };
                        if let Some(place) = &line.place {
                            let text = RichText::new(place.to_string()).monospace();
                            ui.label(text.color(palette.accent));
                        }
                        ui.label(RichText::new(&line.text).color(color));
                        if line.count > 1 {
                            ui.label(RichText::new(format!("{} times", line.count)).weak());
                        }
                    });
                }
            });
        });
    });
    if clear {
        log.clear();
    }
}
