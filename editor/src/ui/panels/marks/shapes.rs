//! Lines in the world.

use std::f32::consts::TAU;

use egui::{Painter, Stroke};
use lightbench::world::glam::Vec3;

use crate::ui::lens::Lens;

/// Lines of which a circle consists.
const PARTS: u32 = 48;

/// A line between two points of the world.
pub fn line(painter: &Painter, lens: &Lens, stroke: Stroke, from: Vec3, to: Vec3) {
    if let Some(ends) = lens.line(from, to) {
        painter.line_segment(ends, stroke);
    }
}

/// The edges of a box along the world's axes.
pub fn cuboid(painter: &Painter, lens: &Lens, stroke: Stroke, min: Vec3, max: Vec3) {
    let corner = |bits: u32| {
        let part = |axis: usize| match bits >> axis & 1 {
            0 => min[axis],
            _ => max[axis],
        };
        Vec3::new(part(0), part(1), part(2))
    };
    for from in 0..8_u32 {
        for axis in 0..3 {
            let to = from | 1 << axis;
            if to != from {
                line(painter, lens, stroke, corner(from), corner(to));
            }
        }
    }
}

/// Points of a circle across an axis, the first one again at the end.
pub fn circle_points(center: Vec3, axis: Vec3, radius: f32) -> impl Iterator<Item = Vec3> {
    let (u, v) = axis.normalize_or(Vec3::Z).any_orthonormal_pair();
    (0..=PARTS).map(move |part| {
        let (sin, cos) = (part as f32 / PARTS as f32 * TAU).sin_cos();
        center + (u * cos + v * sin) * radius
    })
}

/// A circle across an axis.
pub fn circle(
    painter: &Painter,
    lens: &Lens,
    stroke: Stroke,
    center: Vec3,
    axis: Vec3,
    radius: f32,
) {
    let mut points = circle_points(center, axis, radius);
    let Some(mut from) = points.next() else {
        return;
    };
    for to in points {
        line(painter, lens, stroke, from, to);
        from = to;
    }
}
