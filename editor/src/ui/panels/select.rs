//! Choosing entities in the viewport: by a click, with Ctrl more of them, by a box.

use egui::{Pos2, Rect, Stroke, StrokeKind, Ui};
use lightbench::script::Scene;
use lightbench::world::{Camera, Entity, Light, MeshRenderer};

use super::marks::{Mark, icon_at, place_of};
use crate::ui::editor::Editor;
use crate::ui::lens::Lens;
use crate::ui::theme::Palette;
use crate::ui::workbench::extent::bounds_of;
use crate::ui::workbench::structure::is_locked;
use crate::ui::workbench::viewports::Viewport;

/// Chooses what is under a place; nothing there chooses none. With `more` what was chosen stays.
pub fn click(editor: &mut Editor, lens: &Lens, at: Pos2, more: bool, viewport: Viewport) {
    let icons = editor.marks_of(viewport).has(Mark::Icons);
    let workbench = &mut editor.workbench;
    let Some(scene) = workbench.scenes.scene() else {
        return;
    };
    let is_free = |entity: Entity| !is_locked(&scene.world, entity);
    let icon = icons.then(|| icon_at(scene, lens, at)).flatten();
    let under = icon.or_else(|| {
        let hit = scene.pick_among(lens.ray(at), is_free);
        hit.map(|hit| hit.entity)
    });
    match (under, more) {
        (Some(entity), true) => workbench.selection.toggle(scene, entity),
        (Some(entity), false) => workbench.selection.set(scene, [entity]),
        (None, false) => workbench.selection.clear(),
        (None, true) => {}
    }
}

/// Chooses everything whose middle is in a box. With `more` what was chosen stays.
pub fn within(editor: &mut Editor, lens: &Lens, area: Rect, more: bool, viewport: Viewport) {
    let icons = editor.marks_of(viewport).has(Mark::Icons);
    let workbench = &mut editor.workbench;
    let Some(scene) = workbench.scenes.scene() else {
        return;
    };
    let found = inside(scene, lens, area, icons);
    if !more {
        workbench.selection.clear();
    }
    workbench.selection.add(scene, found);
}

fn inside(scene: &Scene, lens: &Lens, area: Rect, icons: bool) -> Vec<Entity> {
    let world = &scene.world;
    let renderers = world.columns::<MeshRenderer>();
    let visible = renderers.slices().visible;
    let meshes = renderers.entities().iter().zip(visible.iter());
    let meshes = meshes
        .filter(|(_, visible)| **visible)
        .filter_map(|(entity, _)| {
            let (min, max) = bounds_of(scene, *entity)?;
            Some((*entity, (min + max) * 0.5))
        });
    let lights = world.columns::<Light>().entities().iter();
    let marked = lights.chain(world.columns::<Camera>().entities());
    let marked = marked
        .filter(|_| icons)
        .filter_map(|entity| Some((*entity, place_of(scene, *entity)?)));
    let all = meshes.chain(marked);
    all.filter(|(entity, _)| !is_locked(world, *entity))
        .filter(|(_, at)| lens.point(*at).is_some_and(|place| area.contains(place)))
        .map(|(entity, _)| entity)
        .collect()
}

/// Draws the box that is being drawn.
pub fn show(ui: &Ui, lens: &Lens, area: Rect) {
    let color = Palette::of(ui).accent;
    let painter = ui.painter_at(lens.rect);
    painter.rect_filled(area, 0.0, color.gamma_multiply(0.15));
    painter.rect_stroke(area, 0.0, Stroke::new(1.0, color), StrokeKind::Middle);
}
