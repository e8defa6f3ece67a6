//! The status bar: who draws, how much, how fast.

use egui::{Align, Label, Layout, RichText, Ui};

use super::widgets;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
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
            ui.add(mono(say!(
                "status.cpu_ms",
                cpu = format_args!("{:>7}", widgets::ms(cpu))
            )));
            ui.add(mono(say!(
                "status.gpu_ms",
                gpu = format_args!("{:>7}", widgets::ms(gpu))
            )))
            .on_hover_text(say!("status.the_whole_frame_median_of_the"));
            if let Some((width, height)) = workbench.drawn_size() {
                ui.add(mono(format!("{width} x {height}")));
            }
            ui.separator();
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let count = workbench.problems().count();
                if let Some(first) = workbench.problems().next() {
                    let text = match count {
                        1 => say!("status.one_mistake").to_owned(),
                        count => say!("status.mistakes", count = count),
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
                    ui.label(say!(
                        "status.driver",
                        driver = summary.driver,
                        driver_info = summary.driver_info
                    ));
                    for missing in &summary.missing {
                        ui.label(say!("status.not_there", missing = missing));
                    }
                });
                if summary.software {
                    let text = say!("status.software_driver_times_are_not_those");
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
