//! Handles by which what is chosen is moved, turned and scaled.

mod drag;
mod draw;
mod keys;

use egui::{PointerButton, Pos2, Response, Ui};
use lightbench::world::WorldMatrix;
use lightbench::world::glam::{Mat3, Quat, Vec3};

use super::marks::Mark;
use crate::ui::editor::Editor;
use crate::ui::lens::Lens;
use crate::ui::messages::say;
use crate::ui::workbench::viewports::Viewport;

pub use drag::Drag;

/// What the handles do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Move along axes.
    #[default]
    Move,
    /// Turn about axes.
    Turn,
    /// Scale along axes.
    Scale,
}

impl Tool {
    /// All, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Move, Self::Turn, Self::Scale];

    /// The words for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Move => say!("handles.move"),
            Self::Turn => say!("handles.rotate"),
            Self::Scale => say!("handles.scale"),
        }
    }
}

/// What the handles are, and what is being done with them.
#[derive(Default)]
pub struct Handles {
    /// What they do.
    pub tool: Tool,
    /// Whether their axes are those of the entity that was chosen last.
    pub local: bool,
    /// To what Ctrl snaps.
    pub snap: Snap,
    /// A handle that is being dragged.
    drag: Option<Drag>,
    /// Why what is chosen can't be changed.
    refused: Option<String>,
}

impl Handles {
    /// Whether a handle is being dragged: then keys are for its amount.
    pub fn is_dragged(&self) -> bool {
        self.drag.is_some()
    }
}

/// Steps to which Ctrl snaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snap {
    /// Metres.
    pub distance: f32,
    /// Degrees.
    pub angle: f32,
    /// Share of the size.
    pub scale: f32,
}

impl Default for Snap {
    fn default() -> Self {
        Self {
            distance: 0.25,
            angle: 15.0,
            scale: 0.1,
        }
    }
}

/// One of the handles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Of the axis of that number.
    Axis(usize),
    /// In the middle: across the view, or alike along all axes.
    Middle,
}

/// Where the handles are and how they lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Where they meet.
    pub at: Vec3,
    /// Their directions, of unit length.
    pub axes: [Vec3; 3],
    /// How long they are, metres.
    pub length: f32,
}

/// Length of a handle, points of the screen.
const LENGTH: f32 = 80.0;

/// The handles of what is chosen.
fn frame(editor: &Editor, lens: &Lens) -> Option<Frame> {
    let workbench = &editor.workbench;
    let scene = workbench.scenes.scene()?;
    let matrix: WorldMatrix = scene.world.get(workbench.selection.last()?)?;
    let at = Vec3::from(matrix.matrix.translation);
    lens.point(at)?;
    // Entities are scaled along their own axes: a scale along others would shear them.
    let handles = &editor.viewport.handles;
    let rotation = if handles.local || handles.tool == Tool::Scale {
        matrix.matrix.to_scale_rotation_translation().1
    } else {
        Quat::IDENTITY
    };
    let axes = Mat3::from_quat(rotation);
    Some(Frame {
        at,
        axes: [axes.x_axis, axes.y_axis, axes.z_axis],
        length: LENGTH * lens.metres_per_point(at),
    })
}

/// Lets handles be dragged in a viewport. Returns whether one has the pointer.
pub fn interact(
    editor: &mut Editor,
    ui: &Ui,
    response: &Response,
    lens: &Lens,
    viewport: Viewport,
) -> bool {
    if !editor.marks_of(viewport).has(Mark::Handles) {
        return false;
    }
    if let Some(drag) = &editor.viewport.handles.drag {
        let is_here = drag.viewport == viewport;
        if is_here {
            drag::go_on(editor, ui, response, lens);
        }
        return is_here;
    }
    let (origin, shift) = ui.input(|input| (input.pointer.press_origin(), input.modifiers.shift));
    let begins = response.drag_started_by(PointerButton::Primary) && !shift;
    let Some((frame, at)) = frame(editor, lens).zip(origin.filter(|_| begins)) else {
        return false;
    };
    let Some(part) = draw::part_at(&frame, editor.viewport.handles.tool, lens, at) else {
        return false;
    };
    match Drag::begin(editor, frame, part, at, viewport) {
        Ok(drag) => {
            editor.viewport.handles.refused = None;
            editor.viewport.handles.drag = Some(drag);
            drag::go_on(editor, ui, response, lens);
        }
        Err(why) => editor.viewport.handles.refused = Some(why),
    }
    true
}

/// Draws the handles, and the amount while one is dragged.
pub fn show(editor: &mut Editor, ui: &Ui, lens: &Lens, pointer: Option<Pos2>, viewport: Viewport) {
    if !editor.marks_of(viewport).has(Mark::Handles) {
        return;
    }
    let handles = &editor.viewport.handles;
    let held = handles.drag.as_ref();
    // While one is dragged they stay as they lay at first, but go along.
    let Some(now) = frame(editor, lens) else {
        return;
    };
    let part = match held {
        Some(drag) => Some(drag.part).filter(|_| drag.viewport == viewport),
        None => pointer.and_then(|at| draw::part_at(&now, handles.tool, lens, at)),
    };
    let frame = held.map_or(now, |drag| Frame {
        axes: drag.frame.axes,
        ..now
    });
    draw::show(ui, lens, &frame, handles.tool, part);
    if let Some(drag) = held.filter(|drag| drag.viewport == viewport) {
        draw::amount(ui, lens, &frame, &drag.words(handles.tool));
    }
    if editor.workbench.selection.is_empty() {
        editor.viewport.handles.refused = None;
    }
    if let Some(why) = &editor.viewport.handles.refused {
        draw::amount(ui, lens, &now, why);
    }
}
