//! The entities of the scene: a list, and the fields of what is chosen, to be changed by hand.

mod field;
mod heading;
mod list;
mod several;
mod switches;

use egui::{RichText, ScrollArea, Ui};
use lightbench::script::overlays::{field_path, line};
use lightbench::world::reflect::Role;
use lightbench::world::{ComponentKind, Entity, Name, Value};

use crate::ui::actions::Action;
use crate::ui::editor::Editor;
use crate::ui::layout::Panel;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::structure::{is_locked, is_shown};
pub use field::sentence;
use list::{Choice, Deed, Rows};

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct EntitiesPanel {
    rows: Rows,
    /// What is wrong with the last change.
    refused: Option<String>,
    /// Whether the field of the name is to be typed into.
    rename: bool,
}

/// What somebody asked for.
enum Wish {
    Set {
        path: &'static str,
        kind: ComponentKind,
        field: usize,
        from: Value,
        to: Value,
    },
    /// Of the entities of these names one field, or all.
    Reset(Vec<String>, Option<String>),
    ResetAll,
    Copy(String),
    Rename(String),
    Add(ComponentKind),
    Drop(ComponentKind),
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut wish = None;
    over_all(editor, ui, &mut wish);
    let workbench = &mut editor.workbench;
    let panel = &mut editor.entities;
    let Some(scene) = workbench.scenes.scene() else {
        ui.label(RichText::new(say!("entities.the_scene_is_not_loaded_yet")).weak());
        return;
    };
    let swaps = workbench.scenes.swaps();
    panel.rows.refresh(&scene.world, swaps);
    workbench.selection.refresh(scene, swaps);
    let height = (ui.available_height() * 0.3).max(60.0);
    let deed = panel.rows.show(ui, scene, &workbench.selection, height);
    if let Some(deed) = deed {
        do_in_list(editor, deed);
    }
    ui.separator();
    let chosen: Vec<Entity> = editor.workbench.selection.entities().collect();
    if chosen.len() > 1 {
        let mut text = say!(
            "entities.entities_are_chosen_these_are_the",
            chosen = chosen.len()
        );
        if chosen.len() > several::COMPARED {
            text += say!("entities.it_is_not_looked_whether_the");
        }
        ui.label(RichText::new(text).weak());
    }
    // Once for all: with many chosen it walks all names.
    let scene = editor.workbench.scenes.scene();
    let refused = scene.and_then(|scene| scene.keep_names(&chosen).err());
    let refused = refused.as_deref();
    heading::show(editor, ui, &chosen, refused, &mut wish);
    let scroll = ScrollArea::vertical().id_salt("fields").auto_shrink(false);
    scroll.show(ui, |ui| {
        if chosen.is_empty() {
            let text = say!("entities.choose_an_entity_to_see_its");
            ui.label(RichText::new(text).weak());
        } else {
            components(editor, ui, &chosen, refused, &mut wish);
        }
        waiting(editor, ui, &mut wish);
    });
    if let Some(wish) = wish {
        grant(editor, ui, wish);
    }
}

/// Does what a menu or a key asks for of what is chosen.
pub fn perform(editor: &mut Editor, action: Action) {
    let workbench = &mut editor.workbench;
    let chosen: Vec<Entity> = workbench.selection.entities().collect();
    let world = workbench.scenes.scene().map(|scene| &scene.world);
    let result = match action {
        Action::Create(kind) => workbench.create(kind),
        Action::Duplicate => workbench.duplicate_chosen(),
        Action::Delete => workbench.delete_chosen(),
        Action::Detach => workbench.put_below(&chosen, None),
        Action::Hide => {
            let shown = world.is_some_and(|world| {
                let mut all = chosen.iter();
                all.any(|entity| is_shown(world, *entity) == Some(true))
            });
            workbench.show_entities(&chosen, !shown)
        }
        Action::Lock => {
            let free = world.is_some_and(|world| chosen.iter().any(|e| !is_locked(world, *e)));
            workbench.lock_entities(&chosen, free)
        }
        Action::Rename if !chosen.is_empty() => {
            editor.entities.rename = true;
            editor.show(Panel::Entities);
            return;
        }
        _ => Ok(()),
    };
    tell(editor, result);
}

/// Says what could not be done, in the panel and, where that is hidden, in the log.
fn tell(editor: &mut Editor, result: Result<(), String>) {
    if let Err(why) = &result {
        editor.workbench.log.error(sentence(why));
    }
    editor.entities.refused = result.err();
}

fn do_in_list(editor: &mut Editor, deed: Deed) {
    let workbench = &mut editor.workbench;
    let Some(scene) = workbench.scenes.scene() else {
        return;
    };
    // What is chosen goes along with the one that was clicked.
    let together = |entity: Entity| -> Vec<Entity> {
        match workbench.selection.contains(entity) {
            true => workbench.selection.entities().collect(),
            false => vec![entity],
        }
    };
    let result = match deed {
        Deed::Choose(entity, how) => {
            let selection = &mut workbench.selection;
            match how {
                Choice::Only => selection.set(scene, [entity]),
                Choice::Toggle => selection.toggle(scene, entity),
                Choice::UpTo => {
                    let rows = editor.entities.rows.between(selection.last(), entity);
                    selection.add(scene, rows);
                }
            }
            Ok(())
        }
        Deed::Rename(entity) => {
            workbench.selection.set(scene, [entity]);
            editor.entities.rename = true;
            Ok(())
        }
        Deed::Show(entity, on) => {
            let all = together(entity);
            workbench.show_entities(&all, on)
        }
        Deed::Lock(entity, on) => {
            let all = together(entity);
            workbench.lock_entities(&all, on)
        }
        Deed::Put(entities, to) => workbench.put_below(&entities, to),
    };
    tell(editor, result);
}

fn grant(editor: &mut Editor, ui: &Ui, wish: Wish) {
    let workbench = &mut editor.workbench;
    let result = match wish {
        Wish::Set {
            path,
            kind,
            field,
            from,
            to,
        } => {
            let Some(scene) = workbench.scenes.scene() else {
                return;
            };
            let chosen: Vec<Entity> = workbench.selection.entities().collect();
            let fields = chosen.iter().filter_map(|entity| {
                let own = scene.world.field_at(*entity, kind, field)?;
                let value = several::carried_over(&from, &to, &own);
                Some((*entity, path, value))
            });
            let fields: Vec<(Entity, &str, Value)> = fields.collect();
            let what = match chosen.as_slice() {
                [one] => say!("entities.field_of", path = path, one = name_of(scene, *one)),
                all => say!("entities.field_of_entities", path = path, all = all.len()),
            };
            let result = workbench.set_fields(&what, &fields);
            // While a slider is dragged the same would stand in the log many times.
            editor.entities.refused = result.err();
            return;
        }
        Wish::Reset(names, path) => {
            workbench.reset_fields(&names, path.as_deref());
            Ok(())
        }
        Wish::ResetAll => {
            workbench.reset_all_fields();
            Ok(())
        }
        Wish::Copy(text) => {
            ui.ctx().copy_text(text);
            Ok(())
        }
        Wish::Rename(name) => workbench.rename_chosen(&name),
        Wish::Add(kind) => workbench.add_component(kind),
        Wish::Drop(kind) => workbench.drop_component(kind),
    };
    tell(editor, result);
}

/// What concerns all that was changed by hand.
fn over_all(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let overlays = editor.workbench.overlays_now();
    let count = overlays.map_or(0, |overlays| overlays.iter().count());
    let edits = overlays.map_or(0, |overlays| overlays.edits().len());
    ui.horizontal_wrapped(|ui| {
        if count == 0 && edits == 0 {
            // In the same place, so that nothing moves under who drags the first field.
            ui.label(RichText::new(say!("entities.no_field_is_changed_by_hand")).weak());
            return;
        }
        let mut text = match count {
            1 => say!("entities.one_field_changed_by_hand").to_owned(),
            _ => say!("entities.fields_changed_by_hand", count = count),
        };
        match edits {
            0 => {}
            1 => text += say!("entities.the_structure_once"),
            _ => text += &say!("entities.the_structure_times", edits = edits),
        }
        ui.label(text);
        let about = say!("entities.lines_for_the_end_of_the");
        if ui
            .small_button(say!("entities.copy_all_as_script"))
            .on_hover_text(about)
            .clicked()
        {
            *wish = Some(Wish::Copy(editor.workbench.overlay_lines()));
        }
        if ui.small_button(say!("entities.reset_all")).clicked() {
            *wish = Some(Wish::ResetAll);
        }
    });
}

fn name_of(scene: &lightbench::script::Scene, entity: Entity) -> String {
    let name: Option<Name> = scene.world.get(entity);
    name.map_or_else(String::new, |name| name.text)
}

/// The components that all have, with all their fields.
fn components(
    editor: &Editor,
    ui: &mut Ui,
    chosen: &[Entity],
    refused: Option<&str>,
    wish: &mut Option<Wish>,
) {
    let workbench = &editor.workbench;
    let (Some(scene), Some(&last)) = (workbench.scenes.scene(), chosen.last()) else {
        return;
    };
    let names: Vec<String> = chosen.iter().map(|e| name_of(scene, *e)).collect();
    let name = name_of(scene, last);
    for kind in scene.world.components_of(last) {
        let info = kind.info();
        let has = |entity: &Entity| scene.world.has_component(*entity, kind);
        if info.role == Role::Hidden || !chosen.iter().all(has) {
            continue;
        }
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            ui.label(RichText::new(info.name).color(Palette::of(ui).accent))
                .on_hover_text(field::one_line(info.doc));
            if !info.hidden() && kind != ComponentKind::Name {
                let button = ui.small_button(say!("entities.remove"));
                let label = say!("entities.remove_component", name = info.name);
                button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
                if button.clicked() {
                    *wish = Some(Wish::Drop(kind));
                }
            }
        });
        for (index, field) in info.fields.iter().enumerate() {
            let (Some(path), Some(value)) = (
                field_path(kind, field),
                scene.world.field_at(last, kind, index),
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
                differs: several::differ(scene, chosen, kind, index, &value),
                overlay: overlays.and_then(|overlays| overlays.get(&name, path)),
                refused,
            };
            match ui.push_id((last, path), |ui| row.show(ui)).inner {
                None => {}
                Some(field::Done::Set(to)) => {
                    *wish = Some(Wish::Set {
                        path,
                        kind,
                        field: index,
                        from: value,
                        to,
                    });
                }
                Some(field::Done::Reset) => {
                    *wish = Some(Wish::Reset(names.clone(), Some(path.to_owned())));
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
    let mut edits = overlays.edits().filter(|(_, waits)| *waits).peekable();
    if all.peek().is_none() && edits.peek().is_none() {
        return;
    }
    ui.add_space(8.0);
    ui.label(RichText::new(say!("entities.waiting")).strong())
        .on_hover_text(say!("entities.changed_by_hand_but_the_entity"));
    for (edit, _) in edits {
        ui.label(edit.words());
    }
    for (entity, path, overlay) in all {
        ui.push_id((entity, path), |ui| {
            ui.horizontal(|ui| {
                ui.label(format!("{entity}: {path}"));
                ui.label(RichText::new(field::text_of(&overlay.value)).monospace());
                if ui.small_button(say!("entities.forget")).clicked() {
                    let names = vec![entity.to_owned()];
                    *wish = Some(Wish::Reset(names, Some(path.to_owned())));
                }
            });
        });
    }
}
