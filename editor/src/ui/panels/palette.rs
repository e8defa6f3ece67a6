//! All that can be done, by name: actions, scenes and pipelines.

use egui::{Button, Context, Id, Key, Modal, Modifiers, ScrollArea, TextEdit, Ui};

use super::pipelines::{favourites, key_of};
use crate::ui::actions::{Action, entries, key_text};
use crate::ui::editor::Editor;
use crate::ui::messages::say;

/// The palette while it is open.
#[derive(Default)]
pub struct Palette {
    typed: String,
    /// The line that Enter takes.
    at: usize,
}

/// What a line does.
#[derive(Clone, Debug, PartialEq)]
enum Deed {
    Act(Action),
    Scene(String),
    Pipeline(String),
    Lesson(String),
}

/// A line of the palette.
struct Line {
    title: String,
    key: String,
    deed: Deed,
}

/// Everything there is, actions first, then scenes, those of late before the others.
fn all(editor: &Editor, ctx: &Context) -> Vec<Line> {
    let actions = entries()
        .filter(|entry| entry.action != Action::Palette)
        .map(|entry| Line {
            title: entry.title().to_owned(),
            key: entry
                .shortcut
                .map_or_else(String::new, |shortcut| key_text(ctx, &shortcut)),
            deed: Deed::Act(entry.action),
        });
    let library = &editor.workbench.library;
    let favourites = favourites(editor);
    let recent = editor.kept.scenes.iter().map(|name| Line {
        title: say!("palette.recent_scene", name = scene_title(editor, name)),
        key: String::new(),
        deed: Deed::Scene(name.clone()),
    });
    let scenes = library.scenes.iter().map(|entry| Line {
        title: say!("palette.scene", title = entry.title),
        key: String::new(),
        deed: Deed::Scene(entry.name.clone()),
    });
    let pipelines = library.pipelines.iter().map(|entry| Line {
        title: say!("palette.pipeline", title = entry.title),
        key: key_of(&favourites, &entry.name).map_or_else(String::new, |key| key.to_string()),
        deed: Deed::Pipeline(entry.name.clone()),
    });
    let language = editor.lessons.language;
    let lessons = editor.lessons.known().iter().filter_map(|listed| {
        let title = listed.title.as_ref().ok()?.in_language(language);
        Some(Line {
            title: say!("lesson.in_palette", title = title),
            key: String::new(),
            deed: Deed::Lesson(listed.name.clone()),
        })
    });
    actions
        .chain(recent)
        .chain(scenes)
        .chain(pipelines)
        .chain(lessons)
        .collect()
}

/// A scene's title, or its name where the list doesn't have it.
pub fn scene_title(editor: &Editor, name: &str) -> String {
    let entry = editor.workbench.library.scene(name);
    entry.map_or_else(|| name.to_owned(), |entry| entry.title.clone())
}

/// Whether each word that was typed is in a title.
fn fits(title: &str, typed: &str) -> bool {
    let title = title.to_lowercase();
    let mut words = typed.split_whitespace();
    words.all(|word| title.contains(&word.to_lowercase()))
}

/// Draws the palette while it is open, and does what was chosen.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(mut palette) = editor.palette.take() else {
        return;
    };
    let files = editor.workbench.files().clone();
    editor.lessons.list(&files);
    let mut lines = all(editor, ctx);
    lines.retain(|line| fits(&line.title, &palette.typed));
    let press = |key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let last = lines.len().saturating_sub(1);
    let moved = match (press(Key::ArrowDown), press(Key::ArrowUp)) {
        (true, _) => Some((palette.at + 1).min(last)),
        (_, true) => Some(palette.at.saturating_sub(1)),
        _ => None,
    };
    palette.at = moved.unwrap_or(palette.at).min(last);
    let entered = press(Key::Enter).then_some(palette.at);
    let escaped = press(Key::Escape);
    let modal = Modal::new(Id::unique("palette")).show(ctx, |ui| {
        ui.set_width(430.0);
        let label = ui.label(say!("palette.find_an_action_a_scene_or"));
        let field = TextEdit::singleline(&mut palette.typed).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(label.id);
        field.request_focus();
        if field.changed() {
            palette.at = 0;
        }
        list(ui, &lines, palette.at, moved.is_some())
    });
    let chosen = entered.or(modal.inner);
    let deed = chosen
        .and_then(|index| lines.get(index))
        .map(|line| line.deed.clone());
    match deed {
        Some(Deed::Act(action)) => editor.perform(action, ctx),
        Some(Deed::Scene(name)) => editor.open_scene(&name),
        Some(Deed::Lesson(name)) => editor.open_lesson(&name),
        Some(Deed::Pipeline(name)) => editor.workbench.select_pipeline(&name),
        None if escaped || modal.should_close() => {}
        None => editor.palette = Some(palette),
    }
}

/// Draws the lines. Returns the one that was clicked.
fn list(ui: &mut Ui, lines: &[Line], at: usize, follow: bool) -> Option<usize> {
    let mut clicked = None;
    let area = ScrollArea::vertical().max_height(340.0).auto_shrink(false);
    area.show(ui, |ui| {
        if lines.is_empty() {
            ui.weak(say!("palette.nothing_is_called_so"));
        }
        ui.spacing_mut().item_spacing.y = 1.0;
        for (index, line) in lines.iter().enumerate() {
            ui.push_id(index, |ui| {
                let button = Button::selectable(index == at, &line.title)
                    .shortcut_text(&line.key)
                    .min_size(egui::vec2(ui.available_width(), 0.0));
                let response = ui.add(button);
                if response.clicked() {
                    clicked = Some(index);
                }
                if follow && index == at {
                    response.scroll_to_me(None);
                }
            });
        }
    });
    clicked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_counts_in_any_order_and_case() {
        assert!(fits("Grid and axes", "axes gr"));
        assert!(fits("Grid and axes", ""));
        assert!(!fits("Grid and axes", "grid scene"));
    }
}
