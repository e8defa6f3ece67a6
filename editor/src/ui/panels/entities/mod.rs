//! The entities of the scene: a list, and the fields of one, to be changed by hand.

mod field;
mod list;

use egui::{RichText, ScrollArea, Ui};
use lightbench::script::overlays::{field_path, line};
use lightbench::world::reflect::Role;
use lightbench::world::{Entity, Name};

use crate::ui::editor::Editor;
use crate::ui::theme::Palette;
use list::{Choice, Rows};

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct EntitiesPanel {
    rows: Rows,
    /// What is wrong with the last change.
    refused: Option<String>,
}

/// What somebody asked for.
enum Wish {
    Set(&'static str, lightbench::world::Value),
    Reset(String, String),
    ResetEntity(String),
    ResetAll,
    Copy(String),
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut wish = None;
    over_all(editor, ui, &mut wish);
    let workbench = &mut editor.workbench;
    let panel = &mut editor.entities;
    let Some(scene) = workbench.scenes.scene() else {
        ui.label(RichText::new("The scene is not loaded yet.").weak());
        return;
    };
    let swaps = workbench.scenes.swaps();
    panel.rows.refresh(&scene.world, swaps);
    let selection = &mut workbench.selection;
    selection.refresh(scene, swaps);
    let height = (ui.available_height() * 0.3).max(60.0);
    if let Some((entity, how)) = panel.rows.show(ui, scene, selection, height) {
        panel.refused = None;
        match how {
            Choice::Only => selection.set(scene, [entity]),
            Choice::Toggle => selection.toggle(scene, entity),
            Choice::UpTo => selection.add(scene, panel.rows.between(selection.last(), entity)),
        }
    }
    ui.separator();
    let selected = selection.last();
    if selection.len() > 1 {
        let text = format!(
            "{} entities are chosen; these are the fields of the last.",
            selection.len()
        );
        ui.label(RichText::new(text).weak());
    }
    if let Some(entity) = selected {
        heading(editor, ui, entity, &mut wish);
    }
    let scroll = ScrollArea::vertical().id_salt("fields").auto_shrink(false);
    scroll.show(ui, |ui| {
        if let Some(entity) = selected {
            components(editor, ui, entity, &mut wish);
        } else {
            let text = "Choose an entity to see its components and to change them by hand.";
            ui.label(RichText::new(text).weak());
        }
        waiting(editor, ui, &mut wish);
    });
    if let Some(wish) = wish {
        grant(editor, ui, wish);
    }
}

fn grant(editor: &mut Editor, ui: &Ui, wish: Wish) {
    let workbench = &mut editor.workbench;
    match wish {
        Wish::Set(path, value) => {
            let Some(entity) = workbench.selection.last() else {
                return;
            };
            let result = workbench.set_field(entity, path, value);
            editor.entities.refused = result.err();
        }
        Wish::Reset(entity, path) => workbench.reset_field(&entity, &path),
        Wish::ResetEntity(entity) => workbench.reset_entity(&entity),
        Wish::ResetAll => workbench.reset_all_fields(),
        Wish::Copy(text) => ui.ctx().copy_text(text),
    }
}

/// What concerns all that was changed by hand.
fn over_all(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let overlays = editor.workbench.overlays_now();
    let count = overlays.map_or(0, |overlays| overlays.iter().count());
    ui.horizontal_wrapped(|ui| {
        if count == 0 {
            // In the same place, so that nothing moves under who drags the first field.
            ui.label(RichText::new("No field is changed by hand").weak());
            return;
        }
        let fields = if count == 1 { "field" } else { "fields" };
        ui.label(format!("{count} {fields} changed by hand"));
        let about = "Lines for the end of the scene's script that do the same";
        if ui
            .small_button("Copy all as script")
            .on_hover_text(about)
            .clicked()
        {
            *wish = Some(Wish::Copy(editor.workbench.overlay_lines()));
        }
        if ui.small_button("Reset all").clicked() {
            *wish = Some(Wish::ResetAll);
        }
    });
}

/// The entity's name, and why it can't be changed.
fn heading(editor: &Editor, ui: &mut Ui, entity: Entity, wish: &mut Option<Wish>) {
    let workbench = &editor.workbench;
    let Some(scene) = workbench.scenes.scene() else {
        return;
    };
    let name = name_of(scene, entity);
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(list::title(&name, entity)).strong());
        let overlays = workbench.overlays_now();
        let changed = overlays.is_some_and(|overlays| overlays.iter().any(|(e, ..)| e == name));
        if changed && ui.small_button("Reset entity").clicked() {
            *wish = Some(Wish::ResetEntity(name));
        }
    });
    if let Err(why) = scene.keeps_by_name(entity) {
        ui.label(RichText::new(field::sentence(&why)).color(Palette::of(ui).warning));
    }
    if let Some(refused) = &editor.entities.refused {
        ui.label(RichText::new(field::sentence(refused)).color(Palette::of(ui).error));
    }
}

fn name_of(scene: &lightbench::script::Scene, entity: Entity) -> String {
    let name: Option<Name> = scene.world.get(entity);
    name.map_or_else(String::new, |name| name.text)
}

/// The components of an entity with all their fields.
fn components(editor: &Editor, ui: &mut Ui, entity: Entity, wish: &mut Option<Wish>) {
    let workbench = &editor.workbench;
    let Some(scene) = workbench.scenes.scene() else {
        return;
    };
    let keeps = scene.keeps_by_name(entity);
    let name = name_of(scene, entity);
    for kind in scene.world.components_of(entity) {
        let info = kind.info();
        if info.role == Role::Hidden {
            continue;
        }
        ui.add_space(4.0);
        ui.label(RichText::new(info.name).color(Palette::of(ui).accent))
            .on_hover_text(field::one_line(info.doc));
        for (index, field) in info.fields.iter().enumerate() {
            let (Some(path), Some(value)) = (
                field_path(kind, field),
                scene.world.field_at(entity, kind, index),
            ) else {
                continue;
            };
            let overlays = workbench.overlays_now();
            let row = field::Row {
                scene,
                kind,
                info: field,
                path,
                value: &value,
                overlay: overlays.and_then(|overlays| overlays.get(&name, path)),
                refused: keeps.as_ref().err().map(String::as_str),
            };
            match ui.push_id((entity, path), |ui| row.show(ui)).inner {
                None => {}
                Some(field::Done::Set(value)) => *wish = Some(Wish::Set(path, value)),
                Some(field::Done::Reset) => {
                    *wish = Some(Wish::Reset(name.clone(), path.to_owned()));
                }
                Some(field::Done::Copy) => {
                    *wish = line(&name, path, &value).map(Wish::Copy);
                }
            }
        }
    }
}

/// What was changed on entities that are not there.
fn waiting(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let Some(overlays) = editor.workbench.overlays_now() else {
        return;
    };
    let mut all = overlays.waiting().peekable();
    if all.peek().is_none() {
        return;
    }
    ui.add_space(8.0);
    ui.label(RichText::new("Waiting").strong()).on_hover_text(
        "Changed by hand, but the entity or its component is not there. The change is laid on when it \
         comes back.",
    );
    for (entity, path, overlay) in all {
        ui.push_id((entity, path), |ui| {
            ui.horizontal(|ui| {
                ui.label(format!("{entity}: {path}"));
                ui.label(RichText::new(field::text_of(&overlay.value)).monospace());
                if ui.small_button("Forget").clicked() {
                    *wish = Some(Wish::Reset(entity.to_owned(), path.to_owned()));
                }
            });
        });
    }
}
