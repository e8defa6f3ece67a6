//! The report of what is on the screen: the button, how far it is, and where it is.

use egui::{DragValue, OpenUrl, ProgressBar, RichText, Ui};

use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Draws the button, or how far the report is.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    if let Some((share, label)) = workbench.reporting.progress() {
        ui.add(ProgressBar::new(share).text(label));
        ui.horizontal_wrapped(|ui| {
            if ui.button(say!("compare.stop_the_report")).clicked() {
                workbench.reporting.cancel();
            }
            let text = say!("compare.whatever_the_computer_does_meanwhile_is");
            ui.label(RichText::new(text).small().weak());
        });
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let about = say!("compare.measures_what_is_on_the_screen");
        if ui
            .button(say!("compare.report_of_what_is_on_screen"))
            .on_hover_text(about)
            .clicked()
        {
            begin(editor);
        }
        let effort = &mut editor.workbench.reporting.effort;
        let label = ui.label(say!("compare.processes"));
        ui.add(DragValue::new(&mut effort.processes).range(1..=100))
            .labelled_by(label.id)
            .on_hover_text(say!("compare.five_are_the_least_for_a"));
        let label = ui.label(say!("compare.seconds"));
        ui.add(
            DragValue::new(&mut effort.seconds)
                .range(0.1..=3600.0)
                .speed(0.1),
        )
        .labelled_by(label.id)
        .on_hover_text(say!("compare.for_each_pipeline_over_all_processes"));
    });
    match editor.workbench.reporting.last() {
        None => {}
        Some(Ok(report)) => {
            let page = report.page.display().to_string();
            ui.horizontal_wrapped(|ui| {
                if ui.button(say!("compare.open_the_report")).clicked() {
                    ui.ctx().open_url(OpenUrl::new_tab(address(&page)));
                }
                if ui.button(say!("compare.copy_its_path")).clicked() {
                    ui.ctx().copy_text(page.clone());
                }
                ui.label(RichText::new(page).monospace().small());
            });
        }
        Some(Err(error)) => {
            let text = say!("compare.no_report", error = error);
            ui.label(RichText::new(text).color(Palette::of(ui).error));
        }
    }
}

/// Begins a report; where there can be none, the log says why.
pub fn begin(editor: &mut Editor) {
    if let Err(error) = editor.workbench.report() {
        editor.workbench.log.error(error.clone());
        editor.workbench.reporting.refuse(error);
    }
}

/// The address of a file for a browser.
fn address(path: &str) -> String {
    let mut address = "file://".to_owned();
    if !path.starts_with('/') {
        address.push('/');
    }
    for byte in path.replace('\\', "/").bytes() {
        let plain = byte.is_ascii_alphanumeric() || b"/-_.~:".contains(&byte);
        if plain {
            address.push(char::from(byte));
        } else {
            address.push_str(&format!("%{byte:02X}"));
        }
    }
    address
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_become_addresses() {
        assert_eq!(address("/a b/ü.html"), "file:///a%20b/%C3%BC.html");
        assert_eq!(address("C:\\x\\y.html"), "file:///C:/x/y.html");
    }
}
