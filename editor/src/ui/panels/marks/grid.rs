//! A grid and the world's axes.

use egui::{Color32, Painter, Stroke};
use lightbench::world::glam::Vec3;

use super::shapes::line;
use crate::ui::lens::Lens;
use crate::ui::workbench::flat::Side;

/// Lines on each side of the middle.
const LINES: i32 = 20;

/// Points of the screen between two lines, at least.
const APART: f32 = 24.0;

/// Colours of the axes x, y and z.
pub const AXES: [Color32; 3] = [
    Color32::from_rgb(214, 82, 74),
    Color32::from_rgb(106, 168, 79),
    Color32::from_rgb(84, 132, 220),
];

/// Draws the grid: in the ground, or across the direction of an orthographic view.
pub fn show(painter: &Painter, lens: &Lens, side: Option<Side>) {
    let [right, up, _] = side.unwrap_or(Side::Top).axes();
    let ahead = right.cross(up);
    let middle = middle(lens, ahead);
    let step = step(lens.metres_per_point(middle) * APART);
    let snapped = |axis: Vec3| axis * (middle.dot(axis) / step).round() * step;
    let center = snapped(right) + snapped(up);
    let reach = step * LINES as f32;
    let thin = Stroke::new(1.0, Color32::from_rgba_unmultiplied(150, 150, 150, 70));
    for index in -LINES..=LINES {
        for (along, across) in [(right, up), (up, right)] {
            let at = center + across * (index as f32 * step);
            line(painter, lens, thin, at - along * reach, at + along * reach);
        }
    }
    for (axis, color) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().zip(AXES) {
        let stroke = Stroke::new(1.5, color);
        line(painter, lens, stroke, -axis * reach, axis * reach);
    }
}

/// What of the plane through the origin is in the middle of the picture, or below the eye where
/// nothing is.
fn middle(lens: &Lens, across: Vec3) -> Vec3 {
    let ray = lens.ray(lens.rect.center());
    let distance = -ray.origin.dot(across) / ray.direction.dot(across);
    let met = ray.origin + ray.direction * distance;
    if distance.is_finite() && distance > 0.0 {
        met - across * met.dot(across)
    } else {
        let eye = lens.view.position();
        eye - across * eye.dot(across)
    }
}

/// A length of 1, 2 or 5 times a power of ten that is no less than `least`.
pub fn step(least: f32) -> f32 {
    let power = 10.0_f32.powf(least.max(1e-6).log10().floor());
    let parts = [1.0, 2.0, 5.0, 10.0].map(|part| part * power);
    parts
        .into_iter()
        .find(|part| *part >= least * 0.999)
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_numbers() {
        for (least, wanted) in [
            (0.03, 0.05),
            (1.0, 1.0),
            (1.1, 2.0),
            (7.0, 10.0),
            (260.0, 500.0),
        ] {
            let step = step(least);
            assert!((step - wanted).abs() < 1e-4 * wanted, "{least}: {step}");
        }
    }
}
