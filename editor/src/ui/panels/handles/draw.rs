//! The handles on the screen, and which one is under the pointer.

use egui::{Color32, FontId, Pos2, Rect, Stroke, Ui, vec2};
use lightbench::world::glam::Vec3;

use super::{Frame, Part, Tool};
use crate::ui::lens::Lens;
use crate::ui::panels::marks::{AXES, circle_points};
use crate::ui::theme::Palette;

/// How near the pointer must be to a handle, points of the screen.
const NEAR: f32 = 7.0;

/// The share of a handle next to the middle that belongs to the middle.
const MIDDLE: f32 = 0.18;

/// The line of a handle.
fn line(frame: &Frame, axis: Vec3, lens: &Lens) -> Option<[Pos2; 2]> {
    let along = axis * frame.length;
    lens.line(frame.at + along * MIDDLE, frame.at + along)
}

/// The circle of a handle.
fn circle(frame: &Frame, axis: Vec3, lens: &Lens) -> Vec<Pos2> {
    circle_points(frame.at, axis, frame.length)
        .filter_map(|at| lens.point(at))
        .collect()
}

fn distance(from: Pos2, to: Pos2, at: Pos2) -> f32 {
    let (along, out) = (to - from, at - from);
    let share = (out.dot(along) / along.length_sq().max(1e-6)).clamp(0.0, 1.0);
    (out - along * share).length()
}

/// The handle under a place of the screen.
pub fn part_at(frame: &Frame, tool: Tool, lens: &Lens, at: Pos2) -> Option<Part> {
    let center = lens.point(frame.at)?;
    if tool != Tool::Turn && center.distance(at) < NEAR + 2.0 {
        return Some(Part::Middle);
    }
    let parts = frame.axes.iter().enumerate().filter_map(|(index, axis)| {
        let points = match tool {
            Tool::Turn => circle(frame, *axis, lens),
            Tool::Move | Tool::Scale => line(frame, *axis, lens)?.to_vec(),
        };
        let pairs = points.windows(2);
        let nearest = pairs.map(|pair| distance(pair[0], pair[1], at));
        Some((index, nearest.reduce(f32::min)?))
    });
    parts
        .filter(|(_, distance)| *distance < NEAR)
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(index, _)| Part::Axis(index))
}

/// Draws the handles; the one under the pointer is bright.
pub fn show(ui: &Ui, lens: &Lens, frame: &Frame, tool: Tool, part: Option<Part>) {
    let painter = ui.painter_at(lens.rect);
    let bright = Color32::from_rgb(255, 220, 120);
    let stroke = |of: Part, color: Color32| {
        if part == Some(of) {
            Stroke::new(3.0, bright)
        } else {
            Stroke::new(2.0, color)
        }
    };
    for (index, axis) in frame.axes.iter().enumerate() {
        let stroke = stroke(Part::Axis(index), AXES[index]);
        if tool == Tool::Turn {
            painter.line(circle(frame, *axis, lens), stroke);
            continue;
        }
        let Some([from, to]) = line(frame, *axis, lens) else {
            continue;
        };
        painter.line_segment([from, to], stroke);
        if tool == Tool::Scale {
            let tip = Rect::from_center_size(to, vec2(9.0, 9.0));
            painter.rect_filled(tip, 1.0, stroke.color);
        } else {
            let along = (to - from).normalized() * 10.0;
            let across = along.rot90() * 0.45;
            let corners = vec![to + along, to + across, to - across];
            painter.add(egui::Shape::convex_polygon(
                corners,
                stroke.color,
                Stroke::NONE,
            ));
        }
    }
    if let Some(center) = lens.point(frame.at).filter(|_| tool != Tool::Turn) {
        let stroke = stroke(Part::Middle, Color32::from_gray(235));
        painter.circle_stroke(center, 6.0, stroke);
    }
}

/// Words beside the handles.
pub fn amount(ui: &Ui, lens: &Lens, frame: &Frame, words: &str) {
    let Some(center) = lens.point(frame.at) else {
        return;
    };
    let palette = Palette::of(ui);
    let painter = ui.painter_at(lens.rect);
    let font = FontId::monospace(12.0);
    let width = (lens.rect.width() - 40.0).clamp(80.0, 420.0);
    let galley = painter.layout(words.to_owned(), font, palette.note_text, width);
    let at = center + vec2(16.0, 20.0);
    let most = lens.rect.max - galley.size() - vec2(10.0, 8.0);
    let at = at.min(most).max(lens.rect.min + vec2(10.0, 8.0));
    let place = Rect::from_min_size(at, galley.size());
    painter.rect_filled(place.expand2(vec2(7.0, 4.0)), 3.0, palette.note_fill);
    painter.galley(at, galley, palette.note_text);
}
