//! Mouse and keys in a viewport: who gets them, and where they move its camera.

use egui::{Key, PointerButton, Rect, Response, Ui};
use lightbench::script::SceneEvent;
use lightbench::world::glam::{Vec2, Vec3};

use super::select;
use crate::ui::editor::Editor;
use crate::ui::lens::Lens;
use crate::ui::workbench::viewports::Viewport;

/// Radians that a drag over one point turns.
const TURN: f32 = 0.006;

/// Draws a box with Shift, and chooses what is in it. Returns whether it has the pointer.
pub fn select_box(
    editor: &mut Editor,
    ui: &Ui,
    response: &Response,
    lens: &Lens,
    viewport: Viewport,
) -> bool {
    let (modifiers, origin) = ui.input(|input| (input.modifiers, input.pointer.press_origin()));
    if response.drag_started_by(PointerButton::Primary) && modifiers.shift {
        editor.viewport.area = origin.map(|at| (viewport, Rect::from_two_pos(at, at)));
    }
    let Some((_, area)) = editor.viewport.area.filter(|(of, _)| *of == viewport) else {
        return false;
    };
    let corner = ui.input(|input| input.pointer.latest_pos());
    let area = match (origin, corner) {
        (Some(from), Some(to)) => Rect::from_two_pos(from, to),
        _ => area,
    };
    editor.viewport.area = Some((viewport, area));
    if !response.dragged_by(PointerButton::Primary) {
        editor.viewport.area = None;
        select::within(editor, lens, area, modifiers.command, viewport);
    }
    true
}

/// Keys and pointer to the scene's scripts, while the pointer is over a picture.
pub fn listen(editor: &mut Editor, ui: &Ui, response: &Response) {
    let typing = ui.ctx().egui_wants_keyboard_input() || editor.viewport.handles.is_dragged();
    let Some(at) = response.hover_pos().filter(|_| !typing) else {
        return;
    };
    let share = (at - response.rect.min) / response.rect.size();
    let pointer = Some([share.x, share.y]);
    editor.viewport.has_pointer = true;
    let workbench = &mut editor.workbench;
    workbench.scene_has_keys = workbench.scene_wants_keys();
    workbench.happen(SceneEvent::Pointer(pointer));
    ui.input(|input| {
        for event in &input.events {
            if let egui::Event::Key {
                key,
                pressed,
                modifiers,
                ..
            } = event
                && !modifiers.command
            {
                let name = key.name().to_lowercase();
                workbench.happen(if *pressed {
                    SceneEvent::KeyDown(name)
                } else {
                    SceneEvent::KeyUp(name)
                });
            }
        }
    });
}

/// Before the viewports of a frame are drawn.
pub fn begin(editor: &mut Editor) {
    editor.viewport.has_pointer = false;
    editor.viewport.seen = [false; 2];
}

/// After the viewports of a frame were drawn, as far as they can be seen.
pub fn end(editor: &mut Editor) {
    if !editor.viewport.has_pointer {
        editor.workbench.scene_has_keys = false;
        editor.workbench.happen(SceneEvent::Leave);
    }
    let [first, second] = editor.viewport.seen;
    editor.workbench.note_seen(first, second);
}

/// A viewport that somebody presses, or comes to by keys, has the focus from then on.
pub fn take_focus(editor: &mut Editor, response: &Response, viewport: Viewport) {
    editor.viewport.seen[viewport as usize] = true;
    if response.is_pointer_button_down_on() || response.gained_focus() {
        editor.workbench.set_focus(viewport);
    }
}

/// Mouse and keys to the camera of a viewport, which has the focus then.
pub fn steer(editor: &mut Editor, ui: &Ui, response: &Response, viewport: Viewport) {
    let before = editor.workbench.camera_of(viewport).view();
    move_camera(editor, ui, response, viewport);
    if editor.workbench.camera_of(viewport).view() != before {
        editor.workbench.set_focus(viewport);
    }
}

fn move_camera(editor: &mut Editor, ui: &Ui, response: &Response, viewport: Viewport) {
    let camera = editor.workbench.camera_of_mut(viewport);
    let drag = response.drag_delta();
    let drag = Vec2::new(drag.x, drag.y);
    let height = response.rect.height().max(1.0);
    let shift = ui.input(|input| input.modifiers.shift);
    let control = ui.input(|input| input.modifiers.command);
    let by = |button| response.dragged_by(button) && drag != Vec2::ZERO;
    let is_flat = camera.flat().is_some();
    let turns = by(PointerButton::Primary) || by(PointerButton::Secondary);
    if by(PointerButton::Middle) || by(PointerButton::Primary) && control || is_flat && turns {
        camera.pan(drag / height);
    } else if by(PointerButton::Primary) {
        camera.orbit(-drag * TURN);
    } else if by(PointerButton::Secondary) {
        camera.look(-drag * TURN);
    }
    if !response.hovered() && !response.dragged() {
        return;
    }
    let (scroll, elapsed) = ui.input(|input| (input.smooth_scroll_delta().y, input.stable_dt));
    if scroll != 0.0 {
        camera.zoom(scroll / 40.0);
    }
    if ui.ctx().egui_wants_keyboard_input() || editor.workbench.scene_has_keys {
        return;
    }
    let direction = ui.input(|input| {
        if input.modifiers.command || input.modifiers.alt {
            return Vec3::ZERO;
        }
        let axis = |minus, plus| f32::from(input.key_down(plus)) - f32::from(input.key_down(minus));
        Vec3::new(
            axis(Key::A, Key::D),
            axis(Key::Q, Key::E),
            axis(Key::W, Key::S),
        )
    });
    if direction != Vec3::ZERO {
        let faster = if shift { 4.0 } else { 1.0 };
        // A frame that took long must not throw the camera far.
        editor
            .workbench
            .camera_of_mut(viewport)
            .fly(direction, elapsed.min(0.1) * faster);
        ui.ctx().request_repaint();
    }
}
