//! The log panel.

use egui::{Rect, RichText, ScrollArea, Ui, pos2};

use super::widgets;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::log::Level;

/// Draws the log.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let log = &mut editor.workbench.log;
    let mut clear = false;
    let mut wanted = None;
    let corner = ui.max_rect().right_top();
    let button = Rect::from_min_max(
        pos2(corner.x - 58.0, corner.y),
        pos2(corner.x, corner.y + 20.0),
    );
    let palette = Palette::of(ui);
    let row = ui.text_style_height(&egui::TextStyle::Body);
    ui.spacing_mut().item_spacing.y = 3.0;
    // Rows are as high as is reckoned with, so that the last can be scrolled to.
    ui.spacing_mut().interact_size.y = row;
    let count = log.lines().len();
    let area = ScrollArea::both().auto_shrink(false).stick_to_bottom(true);
    // A row more, so that the bar at the bottom covers nothing that can be clicked.
    area.show_rows(ui, row, count + 1, |ui, range| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        for line in log.lines().skip(range.start).take(range.len()) {
            ui.horizontal(|ui| {
                ui.set_height(row);
                ui.label(RichText::new(format!("{:8.2}", line.at)).monospace().weak());
                let color = match line.level {
                    Level::Info | Level::Script => ui.visuals().text_color(),
                    Level::Warning => palette.warning,
                    Level::Error => palette.error,
                };
                if let Some(place) = &line.place
                    && widgets::place(ui, place, palette.accent)
                {
                    wanted = Some(place.clone());
                }
                ui.label(RichText::new(&line.text).color(color));
                if line.count > 1 {
                    ui.label(RichText::new(say!("log.times", count = line.count)).weak());
                }
            });
        }
    });
    if count > 0 {
        clear = ui
            .put(button, egui::Button::new(say!("log.clear")).small())
            .clicked();
    }
    if clear {
        log.clear();
    }
    if let Some(place) = wanted {
        editor.go_to(&place);
    }
}
