//! What was done, step by step, and what was looked at. A click goes to the state after a step, or to a view.

use egui::{RichText, ScrollArea, Ui};

use crate::ui::actions::{Action, shortcut_text};
use crate::ui::editor::Editor;
use crate::ui::messages::say;

/// The most of the panel's height that views have; steps have the rest.
const SHARE: f32 = 0.4;

/// From this width on views stand beside the steps.
const WIDE: f32 = 420.0;

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let whole = ui.available_height();
    if ui.available_width() >= WIDE {
        ui.columns(2, |columns| {
            steps(editor, &mut columns[0], whole);
            views(editor, &mut columns[1]);
        });
        return;
    }
    let row = ui.spacing().interact_size.y + 1.0;
    let wanted = (editor.workbench.views.all().len() + 2) as f32 * row;
    let rest = whole - wanted.min(whole * SHARE);
    ui.push_id("steps", |ui| steps(editor, ui, rest));
    ui.separator();
    ui.push_id("views", |ui| views(editor, ui));
}

/// What was done.
fn steps(editor: &mut Editor, ui: &mut Ui, height: f32) {
    let undo = &editor.workbench.undo;
    let (done, all) = (undo.done().len(), undo.done().len() + undo.undone().len());
    let waits = undo.is_waiting();
    ui.horizontal(|ui| {
        ui.label(RichText::new(say!("history.changes")).strong());
        buttons(
            editor,
            ui,
            [
                (say!("action.undo"), Action::Undo, done > 0),
                (say!("action.redo"), Action::Redo, done < all),
            ],
        );
        if waits {
            ui.spinner();
        }
    });
    if all == 0 {
        ui.label(RichText::new(say!("history.no_changes")).weak());
    }
    let undo = &editor.workbench.undo;
    let done = undo.done().len();
    let title = |count: usize| match count.checked_sub(1) {
        None => say!("history.beginning"),
        Some(index) if index < done => &undo.done()[index].what,
        Some(index) => &undo.undone()[all - 1 - index].what,
    };
    let wanted = list(ui, height, (all + 1, done), title);
    if let Some(count) = wanted {
        editor.workbench.go_to_step(count);
    }
}

/// What was looked at.
fn views(editor: &mut Editor, ui: &mut Ui) {
    let views = &editor.workbench.views;
    let (at, all) = (views.at(), views.all().len());
    ui.horizontal(|ui| {
        ui.label(RichText::new(say!("history.views")).strong());
        buttons(
            editor,
            ui,
            [
                (say!("action.view_back"), Action::ViewBack, at > 0),
                (say!("action.view_forth"), Action::ViewForth, at + 1 < all),
            ],
        );
    });
    let views = &editor.workbench.views;
    let title = |index: usize| match index {
        0 => say!("history.first_view"),
        _ => views.all()[index].what.as_str(),
    };
    let wanted = list(ui, f32::INFINITY, (all, views.at()), title);
    if let Some(index) = wanted {
        editor.workbench.go_to_view(index);
    }
}

fn buttons(editor: &mut Editor, ui: &mut Ui, all: [(&str, Action, bool); 2]) {
    for (title, action, enabled) in all {
        ui.add_enabled_ui(enabled, |ui| {
            let mut button = ui.small_button(title);
            if let Some(key) = shortcut_text(ui.ctx(), action) {
                button = button.on_hover_text(key);
            }
            if button.clicked() {
                let ctx = ui.ctx().clone();
                editor.perform(action, &ctx);
            }
        });
    }
}

/// Rows of which one is the present one; those after it are weak. Gives the row that was clicked.
fn list<'a>(
    ui: &mut Ui,
    height: f32,
    (count, at): (usize, usize),
    title: impl Fn(usize) -> &'a str,
) -> Option<usize> {
    let mut wanted = None;
    let row = ui.spacing().interact_size.y;
    let area = ScrollArea::vertical()
        .auto_shrink(false)
        .max_height((height - row * 2.0).max(row * 2.0))
        .stick_to_bottom(true);
    ui.spacing_mut().item_spacing.y = 1.0;
    area.show_rows(ui, row, count, |ui, range| {
        for index in range {
            let mut text = RichText::new(title(index));
            if index > at {
                text = text.weak();
            }
            ui.push_id(index, |ui| {
                if ui.selectable_label(index == at, text).clicked() {
                    wanted = Some(index);
                }
            });
        }
    });
    wanted
}
