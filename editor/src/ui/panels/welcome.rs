//! What to try first.

use egui::{Align2, Context, RichText, Window};

use crate::ui::actions::Action;
use crate::ui::editor::Editor;

/// Things to try, each with the action of a button, if it has one.
const LINES: [(&str, Option<(&str, Action)>); 5] = [
    (
        "Drag in the picture to look around. Click a thing to choose it and to see what each pass \
         does to its pixel.",
        None,
    ),
    (
        "Press 1 to 9 to draw the same scene with another pipeline, and compare what the passes cost.",
        None,
    ),
    (
        "Show in the toolbar draws the work that each pixel makes; the panel Targets shows what lies \
         in any target after any pass.",
        None,
    ),
    (
        "Read the script of the scene and change it: save, and the picture follows.",
        Some(("Edit the script", Action::EditScene)),
    ),
    (
        "See what else there is: scenes, pipelines and small examples.",
        Some(("Open the gallery", Action::Gallery)),
    ),
];

/// Draws the window while it is open.
pub fn show(editor: &mut Editor, ctx: &Context) {
    if !editor.welcome {
        return;
    }
    let mut open = true;
    let mut wanted = None;
    let mut done = false;
    Window::new("Welcome to Lightbench")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(470.0);
            ui.label(
                "A workbench on which to learn, teach and compare real-time lighting pipelines.",
            );
            ui.add_space(6.0);
            for (number, (text, button)) in LINES.iter().enumerate() {
                ui.horizontal_top(|ui| {
                    ui.label(RichText::new(format!("{}", number + 1)).strong());
                    ui.vertical(|ui| {
                        ui.label(*text);
                        if let Some((title, action)) = button
                            && ui.button(*title).clicked()
                        {
                            wanted = Some(*action);
                        }
                    });
                });
            }
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                done = ui.button("Start").clicked();
                ui.weak("Help, Welcome shows this again.");
            });
        });
    editor.welcome = open && !done && wanted.is_none();
    if !editor.welcome {
        // Both say what to try.
        editor.hint = false;
    }
    if let Some(action) = wanted {
        editor.perform(action, ctx);
    }
}
