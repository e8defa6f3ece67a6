//! The menu bar: the table of actions, drawn.

use egui::{Button, MenuBar, Ui};

use crate::ui::actions::{Action, Entry, key_text};
use crate::ui::editor::Editor;
use crate::ui::layout;
use crate::ui::menus::MENUS;
use crate::ui::messages::say;
use crate::ui::messages::{message, text};
use crate::ui::panels::palette::scene_title;
use crate::ui::panels::pipelines::{favourites, key_of};

/// Draws the menu bar.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    MenuBar::new().ui(ui, |ui| {
        for (menu, groups) in &MENUS {
            ui.menu_button(text(menu), |ui| {
                ui.set_min_width(230.0);
                if *menu == message!("menu.pipeline") {
                    pipelines(editor, ui);
                }
                if *menu == message!("menu.file") {
                    scenes_of_late(editor, ui);
                }
                for (index, group) in groups.iter().enumerate() {
                    if index > 0 {
                        ui.separator();
                    }
                    match own_menu(group) {
                        Some(title) => _ = ui.menu_button(title, |ui| entries(editor, ui, group)),
                        None => entries(editor, ui, group),
                    }
                }
            });
        }
    });
}

/// The title of the menu of its own in which a group lies, where it does: so many panels are there that with
/// them a menu would be higher than small windows.
fn own_menu(group: &[Entry]) -> Option<&'static str> {
    let switches_panel = |entry: &Entry| matches!(entry.action, Action::Toggle(_));
    let mut all = group.iter();
    all.all(switches_panel).then(|| say!("menu.panels"))
}

/// Draws the entries of a group.
fn entries(editor: &mut Editor, ui: &mut Ui, group: &[Entry]) {
    for entry in group {
        let mark = match entry.action {
            Action::Toggle(panel) => layout::is_visible(&editor.layout, panel),
            Action::Tool(tool) => editor.viewport.handles.tool == tool,
            Action::LocalAxes => editor.viewport.handles.local,
            Action::Mark(mark) => editor.marks_of(editor.workbench.focus()).has(mark),
            Action::Compare(action) => action.is_in_force(&editor.workbench),
            _ => false,
        };
        let mut button = Button::new(entry.title()).selected(mark);
        if let Some(shortcut) = &entry.shortcut {
            button = button.shortcut_text(key_text(ui.ctx(), shortcut));
        }
        if ui.add(button).clicked() {
            let ctx = ui.ctx().clone();
            editor.perform(entry.action, &ctx);
            ui.close();
        }
    }
}

/// The scenes that were shown last.
fn scenes_of_late(editor: &mut Editor, ui: &mut Ui) {
    let mut wanted = None;
    ui.menu_button(say!("menu.recent_scenes"), |ui| {
        for name in &editor.kept.scenes {
            if ui.button(scene_title(editor, name)).clicked() {
                wanted = Some(name.clone());
            }
        }
    });
    ui.separator();
    if let Some(name) = wanted {
        editor.open_scene(&name);
        ui.close();
    }
}

/// All pipelines with the keys of the favourites.
fn pipelines(editor: &mut Editor, ui: &mut Ui) {
    let selected = editor.workbench.pipelines.selected().to_owned();
    let favourites = favourites(editor);
    let mut wanted = None;
    for entry in &editor.workbench.library.pipelines {
        let mut button = Button::new(&entry.title).selected(entry.name == selected);
        if let Some(key) = key_of(&favourites, &entry.name) {
            button = button.shortcut_text(key.to_string());
        }
        let response = ui.add(button);
        if response.clicked() {
            wanted = Some(entry.name.clone());
            ui.close();
        }
        if !entry.description.is_empty() {
            response.on_hover_text(&entry.description);
        }
    }
    ui.separator();
    if let Some(name) = wanted {
        editor.workbench.select_pipeline(&name);
    }
}
