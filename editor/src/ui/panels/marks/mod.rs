//! What is drawn over the picture: a grid, icons, the bounds of what is chosen.

mod grid;
mod icon;
mod icons;
mod shapes;

pub use grid::AXES;
pub use icons::{icon_at, place_of};
pub use shapes::circle_points;

use egui::{Align2, FontId, Stroke, Ui, pos2, vec2};
use serde::{Deserialize, Serialize};

use crate::ui::editor::Editor;
use crate::ui::lens::Lens;
use crate::ui::theme::Palette;
use crate::ui::workbench::extent::bounds_of;
use crate::ui::workbench::viewports::Viewport;

/// Something that is drawn over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A grid in the plane of the ground, or of the picture, and the world's axes.
    Grid,
    /// Where lights and cameras are.
    Icons,
    /// The bounds of what is chosen, and how far a light shines or a camera sees.
    Selection,
    /// The handles by which it is moved.
    Handles,
    /// The edges of triangles.
    Edges,
    /// The normals of vertices.
    Normals,
    /// Edges and normals of what is chosen alone.
    OfChosen,
}

/// What of it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Marks {
    grid: bool,
    icons: bool,
    selection: bool,
    handles: bool,
    edges: bool,
    normals: bool,
    of_chosen: bool,
}

impl Default for Marks {
    fn default() -> Self {
        Self {
            // Lines over all of the picture are for those who place things.
            grid: false,
            icons: true,
            selection: true,
            handles: true,
            edges: false,
            normals: false,
            of_chosen: false,
        }
    }
}

impl Marks {
    fn switch(&mut self, mark: Mark) -> &mut bool {
        match mark {
            Mark::Grid => &mut self.grid,
            Mark::Icons => &mut self.icons,
            Mark::Selection => &mut self.selection,
            Mark::Handles => &mut self.handles,
            Mark::Edges => &mut self.edges,
            Mark::Normals => &mut self.normals,
            Mark::OfChosen => &mut self.of_chosen,
        }
    }

    /// Whether it is shown.
    pub fn has(mut self, mark: Mark) -> bool {
        *self.switch(mark)
    }

    /// Shows it or hides it.
    pub fn toggle(&mut self, mark: Mark) {
        let on = self.switch(mark);
        *on = !*on;
    }
}

/// Draws all that is shown in a viewport.
pub fn show(editor: &Editor, ui: &Ui, lens: &Lens, viewport: Viewport) {
    let Some(scene) = editor.workbench.scenes.scene() else {
        return;
    };
    let painter = ui.painter_at(lens.rect);
    let palette = Palette::of(ui);
    let side = editor
        .workbench
        .camera_of(viewport)
        .flat()
        .map(|flat| flat.side);
    let marks = editor.marks_of(viewport);
    if marks.has(Mark::Grid) {
        grid::show(&painter, lens, side);
    }
    if marks.has(Mark::Icons) {
        icons::show(&painter, lens, scene, &editor.workbench.selection);
    }
    if marks.has(Mark::Selection) {
        let stroke = Stroke::new(1.5, palette.warning);
        for entity in editor.workbench.selection.entities() {
            if let Some((min, max)) = bounds_of(scene, entity) {
                shapes::cuboid(&painter, lens, stroke, min, max);
            }
            icons::reach(
                &painter,
                lens,
                Stroke::new(1.0, palette.warning),
                scene,
                entity,
            );
        }
    }
    if let Some(side) = side {
        let at = lens.rect.left_top() + vec2(10.0, 10.0);
        let font = FontId::proportional(12.0);
        let galley = painter.layout_no_wrap(side.title().to_owned(), font, palette.note_text);
        let place = Align2::LEFT_TOP.anchor_size(pos2(at.x, at.y), galley.size());
        painter.rect_filled(place.expand2(vec2(7.0, 4.0)), 3.0, palette.note_fill);
        painter.galley(place.min, galley, palette.note_text);
    }
}
