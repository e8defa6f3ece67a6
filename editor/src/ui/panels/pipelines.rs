//! All pipelines: what each is for, and the keys of the favourites.

use egui::{Button, Label, RichText, ScrollArea, Ui};

use super::widgets::combo_of;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Number keys.
pub const KEYS: usize = 9;

/// The pipelines of the nine number keys: those that somebody chose, and the first of the list for keys
/// that nobody gave away.
pub fn favourites(editor: &Editor) -> [Option<String>; KEYS] {
    let kept = &editor.kept.favourites;
    let all = &editor.workbench.library.pipelines;
    std::array::from_fn(|index| {
        if let Some(name) = kept.get(&(index + 1)) {
            return Some(name.clone());
        }
        // What has a key of its own needs no other.
        let first = all.get(index).map(|entry| entry.name.clone());
        first.filter(|name| !kept.values().any(|known| known == name))
    })
}

/// The number key of a pipeline, from 1.
pub fn key_of(favourites: &[Option<String>; KEYS], name: &str) -> Option<usize> {
    let has = |favourite: &Option<String>| favourite.as_deref() == Some(name);
    favourites.iter().position(has).map(|index| index + 1)
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let favourites = favourites(editor);
    let workbench = &editor.workbench;
    let selected = workbench.pipelines.selected().to_owned();
    let mut wanted = None;
    let mut given = None;
    ui.label(RichText::new(say!("pipelines.keys_and_go_back_and_on")).weak());
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for entry in &workbench.library.pipelines {
            let key = key_of(&favourites, &entry.name);
            ui.horizontal(|ui| {
                let shown = key.map_or_else(|| " ".to_owned(), |key| key.to_string());
                let label = say!("pipelines.key_of", title = entry.title);
                combo_of(ui, &label, &shown, 34.0, |ui| {
                    for number in 1..=KEYS {
                        let text = number.to_string();
                        if ui.selectable_label(key == Some(number), text).clicked() {
                            given = Some((number, entry.name.clone()));
                        }
                    }
                })
                .on_hover_text(say!("pipelines.the_number_key_that_chooses_it"));
                let mut text = RichText::new(&entry.title);
                if entry.problem.is_some() {
                    text = text.color(Palette::of(ui).error);
                }
                if ui
                    .add(Button::selectable(entry.name == selected, text))
                    .clicked()
                {
                    wanted = Some(entry.name.clone());
                }
            });
            let about = match &entry.problem {
                Some(problem) => problem.to_string(),
                None => workbench.library.purpose(&entry.name).to_owned(),
            };
            ui.indent(&entry.name, |ui| {
                ui.add(Label::new(RichText::new(about).weak()).wrap());
            });
        }
    });
    if let Some(name) = wanted {
        editor.workbench.select_pipeline(&name);
    }
    if let Some((key, name)) = given {
        let before = editor.kept.favourites.clone();
        let kept = editor.kept.give_key(key, &name);
        editor.tell_if_not_kept(kept);
        let after = editor.kept.favourites.clone();
        editor.workbench.note_number_keys(key, &name, before, after);
    }
}

impl Editor {
    /// Gives number keys to pipelines as they had them, where that was taken back or done again.
    pub(in crate::ui) fn take_number_keys(&mut self) {
        if let Some(keys) = self.workbench.undo.take_number_keys() {
            let kept = self.kept.give_keys(keys);
            self.tell_if_not_kept(kept);
        }
    }
}
