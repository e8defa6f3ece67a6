//! What stands over the fields: the name, what components could be added, and what can't be done.

use std::collections::HashSet;

use egui::{RichText, TextEdit, Ui};
use lightbench::world::{ComponentKind, Entity};

use super::{Wish, field, list, name_of};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Draws the name and what concerns all fields of what is chosen.
pub fn show(
    editor: &mut Editor,
    ui: &mut Ui,
    chosen: &[Entity],
    why_not: Option<&str>,
    wish: &mut Option<Wish>,
) {
    let Some(&last) = chosen.last() else {
        return;
    };
    let focus = std::mem::take(&mut editor.entities.rename);
    let workbench = &editor.workbench;
    let Some(scene) = workbench.scenes.scene() else {
        return;
    };
    let name = name_of(scene, last);
    ui.horizontal(|ui| {
        let label = ui.label(say!("entities.name"));
        let id = ui.scope_id().with(("name", last));
        let kept: Option<String> = ui.data(|data| data.get_temp(id));
        let mut typed = kept.unwrap_or_else(|| name.clone());
        let hint = list::title(&name, last);
        let field = TextEdit::singleline(&mut typed)
            .hint_text(hint)
            .desired_width(150.0);
        let response = ui.add(field).labelled_by(label.id);
        if focus {
            response.request_focus();
        }
        if response.has_focus() {
            // Half a word is none: it counts when the field is left.
            ui.data_mut(|data| data.insert_temp(id, typed));
        } else {
            ui.data_mut(|data| data.remove_temp::<String>(id));
            let given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
            if response.lost_focus() && typed != name && !given_up {
                *wish = Some(Wish::Rename(typed));
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.menu_button(say!("entities.add_component"), |ui| {
            for kind in addable() {
                let lacks = |entity: &Entity| !scene.world.has_component(*entity, kind);
                if chosen.iter().any(lacks) && ui.button(kind.info().name).clicked() {
                    *wish = Some(Wish::Add(kind));
                    ui.close();
                }
            }
        });
        let overlays = workbench.overlays_now();
        let names: HashSet<String> = chosen.iter().map(|e| name_of(scene, *e)).collect();
        let changed = overlays.is_some_and(|overlays| {
            let mut all = overlays.iter();
            all.any(|(entity, ..)| names.contains(entity))
        });
        if changed && ui.small_button(say!("entities.reset_entity")).clicked() {
            *wish = Some(Wish::Reset(names.into_iter().collect(), None));
        }
    });
    if let Some(why) = why_not {
        ui.label(RichText::new(field::sentence(why)).color(Palette::of(ui).warning));
    }
    if let Some(refused) = &editor.entities.refused {
        ui.label(RichText::new(field::sentence(refused)).color(Palette::of(ui).error));
    }
}

/// Components that people may give to entities.
fn addable() -> impl Iterator<Item = ComponentKind> {
    let all = ComponentKind::ALL.iter().copied();
    all.filter(|kind| {
        let others = [ComponentKind::Name, ComponentKind::ClipVolume];
        !kind.info().hidden() && !others.contains(kind)
    })
}
