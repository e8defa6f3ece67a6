//! What to try first.

use egui::{Align2, Context, RichText, Window};

use crate::ui::actions::Action;
use crate::ui::editor::Editor;
use crate::ui::messages::{message, say, text};

/// Things to try, each with the action of a button, if it has one.
const LINES: [(&str, Option<(&str, Action)>); 5] = [
    (message!("welcome.drag_in_the_picture_to_look"), None),
    (message!("welcome.press_1_to_9_to_draw"), None),
    (message!("welcome.show_in_the_toolbar_draws_the"), None),
    (
        message!("welcome.read_the_script_of_the_scene"),
        Some((message!("welcome.edit_the_script"), Action::EditScene)),
    ),
    (
        message!("welcome.see_what_else_there_is_scenes"),
        Some((message!("welcome.open_the_gallery"), Action::Gallery)),
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
    Window::new(say!("welcome.welcome_to_lightbench"))
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(470.0);
            ui.label(say!("welcome.a_workbench_on_which_to_learn"));
            ui.add_space(6.0);
            for (number, (line, button)) in LINES.iter().enumerate() {
                ui.horizontal_top(|ui| {
                    ui.label(RichText::new(format!("{}", number + 1)).strong());
                    ui.vertical(|ui| {
                        ui.label(text(line));
                        if let Some((title, action)) = button
                            && ui.button(text(title)).clicked()
                        {
                            wanted = Some(*action);
                        }
                    });
                });
            }
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                done = ui.button(say!("welcome.start")).clicked();
                ui.weak(say!("welcome.help_welcome_shows_this_again"));
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
