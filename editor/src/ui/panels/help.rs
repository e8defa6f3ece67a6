//! Windows over the editor: mouse and keys, and what this program is.

use egui::{Align2, Context, Grid, RichText, Window};

use crate::ui::actions::{entries, key_text};
use crate::ui::editor::Editor;
use crate::ui::messages::{message, say, text};

/// What the mouse does in the viewport.
const MOUSE: [(&str, &str); 13] = [
    (
        message!("help.choose_an_entity"),
        message!("help.click_with_ctrl_more_of_them"),
    ),
    (
        message!("help.choose_by_a_box"),
        message!("help.shift_and_left_drag_with_ctrl"),
    ),
    (message!("help.probe_a_pixel"), message!("help.click")),
    (
        message!("help.move_rotate_scale"),
        message!("help.drag_a_handle_ctrl_snaps_digits"),
    ),
    (
        message!("help.put_an_entity_below_another_one"),
        message!("help.drag_its_row_in_the_list"),
    ),
    (
        message!("help.open_a_file"),
        message!("help.drop_it_onto_the_window"),
    ),
    (message!("help.orbit"), message!("help.left_drag")),
    (message!("help.look_around"), message!("help.right_drag")),
    (
        message!("help.pan"),
        message!("help.middle_drag_or_ctrl_and_left"),
    ),
    (message!("help.zoom"), message!("help.wheel")),
    (message!("help.fly"), message!("help.w_a_s_d_e_up")),
    (message!("help.fly_faster"), message!("help.shift")),
    (
        message!("help.move_the_split"),
        message!("help.drag_the_line_between_a_and"),
    ),
];

/// Draws the windows that are open.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let window = |title: &'static str| {
        Window::new(title)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
    };
    window(say!("help.mouse_and_keys"))
        .open(&mut editor.help)
        .show(ctx, |ui| {
            Grid::new("keys")
                .num_columns(2)
                .spacing([28.0, 5.0])
                .show(ui, |ui| {
                    for (what, how) in MOUSE {
                        ui.label(text(what));
                        ui.label(RichText::new(text(how)).monospace());
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
                    ui.label(say!("help.choose_a_favourite_pipeline"));
                    ui.label(RichText::new(say!("help.number_keys")).monospace());
                    ui.end_row();
                });
        });
    window(say!("help.about_lightbench"))
        .open(&mut editor.about)
        .show(ctx, |ui| {
            ui.set_max_width(360.0);
            ui.heading(say!("help.version", version = env!("CARGO_PKG_VERSION")));
            ui.label(say!("help.a_workbench_on_which_to_learn"));
            ui.add_space(6.0);
            ui.label(say!("help.licences"));
            if let Some(project) = editor.workbench.files().project() {
                ui.add_space(6.0);
                ui.label(say!("help.project", project = project.display()));
            }
        });
}
