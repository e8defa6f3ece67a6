//! Windows over the editor: mouse and keys, and what this program is.

use egui::{Align2, Context, Grid, RichText, Window};

use crate::ui::actions::{entries, key_text};
use crate::ui::editor::Editor;

/// What the mouse does in the viewport.
const MOUSE: [(&str, &str); 13] = [
    ("Choose an entity", "click; with Ctrl more of them"),
    (
        "Choose by a box",
        "Shift and left drag; with Ctrl more of them",
    ),
    ("Probe a pixel", "click"),
    (
        "Move, rotate, scale",
        "drag a handle; Ctrl snaps, digits give the amount",
    ),
    (
        "Put an entity below another one",
        "drag its row in the list of entities",
    ),
    ("Open a file", "drop it onto the window"),
    ("Orbit", "left drag"),
    ("Look around", "right drag"),
    (
        "Pan",
        "middle drag, or Ctrl and left drag; any drag without perspective",
    ),
    ("Zoom", "wheel"),
    ("Fly", "W A S D, E up, Q down, over the viewport"),
    ("Fly faster", "Shift"),
    ("Move the split", "drag the line between A and B"),
];

/// Draws the windows that are open.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let window = |title: &'static str| {
        Window::new(title)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
    };
    window("Mouse and keys")
        .open(&mut editor.help)
        .show(ctx, |ui| {
            Grid::new("keys")
                .num_columns(2)
                .spacing([28.0, 5.0])
                .show(ui, |ui| {
                    for (what, how) in MOUSE {
                        ui.label(what);
                        ui.label(RichText::new(how).monospace());
                        ui.end_row();
                    }
                    for entry in entries() {
                        let Some(shortcut) = &entry.shortcut else {
                            continue;
                        };
                        ui.label(entry.title());
                        ui.label(RichText::new(key_text(ui.ctx(), shortcut)).monospace());
                        ui.end_row();
                    }
                    ui.label("Choose a favourite pipeline");
                    ui.label(RichText::new("1 to 9").monospace());
                    ui.end_row();
                });
        });
    window("About Lightbench")
        .open(&mut editor.about)
        .show(ctx, |ui| {
            ui.set_max_width(360.0);
            ui.heading(format!("Lightbench {}", env!("CARGO_PKG_VERSION")));
            ui.label(
                "A workbench on which to learn, teach and compare real-time lighting pipelines.",
            );
            ui.add_space(6.0);
            ui.label("Licensed under MIT or Apache-2.0, at your choice.");
            if let Some(project) = editor.workbench.files().project() {
                ui.add_space(6.0);
                ui.label(format!("Project: {}", project.display()));
            }
        });
}
