//! Some fields of one component of one entity, for panels that show no more.

use egui::Ui;
use lightbench::script::overlays::{field_path, line};
use lightbench::world::{ComponentKind, Entity, Value};

use super::field::{Done, Row};
use super::{name_of, tell};
use crate::ui::editor::Editor;

/// What somebody did to a field.
pub struct Changed {
    path: &'static str,
    value: Value,
    done: Done,
}

/// Draws the fields of some names.
pub fn rows(
    editor: &Editor,
    ui: &mut Ui,
    entity: Entity,
    kind: ComponentKind,
    names: &[&str],
) -> Option<Changed> {
    let workbench = &editor.workbench;
    let scene = workbench.scenes.scene()?;
    let name = name_of(scene, entity);
    let refused = scene.keeps_by_name(entity).err();
    let overlays = workbench.overlays_now();
    let mut changed = None;
    for (index, info) in kind.info().fields.iter().enumerate() {
        let path = field_path(kind, info).filter(|_| names.contains(&info.name));
        let (Some(path), Some(value)) = (path, scene.world.field_at(entity, kind, index)) else {
            continue;
        };
        let row = Row {
            scene,
            kind,
            info,
            path,
            value: &value,
            differs: false,
            overlay: overlays.and_then(|overlays| overlays.get(&name, path)),
            refused: refused.as_deref(),
        };
        if let Some(done) = ui.push_id((entity, path), |ui| row.show(ui)).inner {
            changed = Some(Changed { path, value, done });
        }
    }
    changed
}

/// Does what somebody did.
pub fn grant(editor: &mut Editor, ui: &Ui, entity: Entity, changed: Changed) {
    let workbench = &mut editor.workbench;
    let Changed { path, value, done } = changed;
    let name = workbench.scenes.scene().map(|scene| name_of(scene, entity));
    let Some(name) = name else {
        return;
    };
    match done {
        Done::Set(value) => {
            let result = workbench.set_field(entity, path, value);
            tell(editor, result);
        }
        Done::Reset => workbench.reset_field(&name, path),
        Done::Copy => {
            if let Some(line) = line(&name, path, &value) {
                ui.ctx().copy_text(line);
            }
        }
        Done::Asset(_) => {}
    }
}
