//! What was changed by hand, step by step. A click goes to the state after a step.

use egui::{RichText, ScrollArea, Ui};

use crate::ui::actions::Action;
use crate::ui::editor::Editor;
use crate::ui::messages::say;

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let undo = &editor.workbench.undo;
    let (done, all) = (undo.done().len(), undo.done().len() + undo.undone().len());
    if all == 0 {
        let text = say!("history.what_you_change_by_hand_appears");
        ui.label(RichText::new(text).weak());
        return;
    }
    let mut wanted = None;
    ui.horizontal(|ui| {
        for (title, action, enabled) in [
            (say!("history.undo"), Action::Undo, done > 0),
            (say!("history.redo"), Action::Redo, done < all),
        ] {
            ui.add_enabled_ui(enabled, |ui| {
                if ui.small_button(title).clicked() {
                    let ctx = ui.ctx().clone();
                    editor.perform(action, &ctx);
                }
            });
        }
    });
    let undo = &editor.workbench.undo;
    let done = undo.done().len();
    let row = ui.spacing().interact_size.y;
    let area = ScrollArea::vertical()
        .auto_shrink(false)
        .stick_to_bottom(true);
    ui.spacing_mut().item_spacing.y = 1.0;
    area.show_rows(ui, row, all + 1, |ui, range| {
        for count in range {
            let title = match count.checked_sub(1) {
                None => say!("history.as_the_script_has_it"),
                Some(index) if index < done => &undo.done()[index].what,
                Some(index) => &undo.undone()[all - 1 - index].what,
            };
            let mut text = RichText::new(title);
            if count > done {
                text = text.weak();
            }
            ui.push_id(count, |ui| {
                if ui.selectable_label(count == done, text).clicked() {
                    wanted = Some(count);
                }
            });
        }
    });
    if let Some(count) = wanted {
        editor.workbench.go_to_step(count);
    }
}
