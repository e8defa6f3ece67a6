//! The status bar: who draws, how much, how fast.

use egui::{Align, Label, Layout, RichText, Ui};

use super::widgets;
use crate::ui::editor::Editor;
use crate::ui::theme::Palette;

/// Draws the status bar.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut wanted = None;
    let workbench = &editor.workbench;
    let summary = &workbench.gpu().summary;
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let gpu = workbench.timings.gpu_ms.median();
            let cpu = workbench.timings.cpu_ms.median();
            let mono = |text: String| Label::new(RichText::new(text).monospace()).selectable(false);
            ui.add(mono(format!("CPU {:>7} ms", widgets::ms(cpu))));
            ui.add(mono(format!("GPU {:>7} ms", widgets::ms(gpu))))
                .on_hover_text("The whole frame, median of the last frames at this size.");
            if let Some((width, height)) = workbench.drawn_size() {
                ui.add(mono(format!("{width} x {height}")));
            }
            ui.separator();
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let count = workbench.problems().count();
                if let Some(first) = workbench.problems().next() {
                    let text = match count {
                        1 => "1 mistake:".to_owned(),
                        count => format!("{count} mistakes:"),
                    };
                    let color = Palette::of(ui).error;
                    ui.label(RichText::new(text).color(color));
                    if widgets::place(ui, &first.place, color) {
                        wanted = Some(first.place.clone());
                    }
                    ui.separator();
                }
                let text = format!(
                    "{} · {} · {}",
                    summary.name, summary.backend, summary.driver_info
                );
                ui.add(Label::new(text).truncate()).on_hover_ui(|ui| {
                    ui.label(format!(
                        "Driver: {} {}",
                        summary.driver, summary.driver_info
                    ));
                    for missing in &summary.missing {
                        ui.label(format!("Not there: {missing}"));
                    }
                });
                if summary.software {
                    let text = "software driver: times are not those of a graphics card";
                    ui.add(
                        Label::new(RichText::new(text).color(Palette::of(ui).warning)).truncate(),
                    );
                }
            });
        });
    });
    if let Some(place) = wanted {
        editor.go_to(&place);
    }
}
