//! Cylinder, cone and torus.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec4};

use super::flat::add_cells;
use super::{Profile, count, length, revolve};
use crate::Mesh;

/// An upright closed cylinder around the origin. Texture coordinates 0 to 1:
/// once around the side, and a disc of the picture on each end.
#[must_use]
pub fn cylinder(radius: f32, height: f32, segments: u32) -> Mesh {
    frustum(length(radius), length(radius), length(height), segments).named("cylinder")
}

/// An upright closed cone around the origin: its tip is half the height above,
/// its base half below. Texture coordinates 0 to 1 as for [`cylinder`].
#[must_use]
pub fn cone(radius: f32, height: f32, segments: u32) -> Mesh {
    frustum(length(radius), 0.0, length(height), segments).named("cone")
}

fn frustum(bottom: f32, top: f32, height: f32, segments: u32) -> Mesh {
    let half = height / 2.0;
    let side = Profile::new().line(Vec2::new(bottom, -half), Vec2::new(top, half));
    let mut mesh = revolve(&side, segments, Vec2::ONE);
    add_disc(&mut mesh, bottom, -half, segments, -1.0);
    if top > 0.0 {
        add_disc(&mut mesh, top, half, segments, 1.0);
    }
    mesh
}

/// Adds a level disc that faces up (`side` 1) or down (−1).
fn add_disc(mesh: &mut Mesh, radius: f32, height: f32, segments: u32, side: f32) {
    let segments = count(segments, 3);
    let first = mesh.positions.len() as u32;
    for step in 0..segments {
        let (sin, cos) = (step as f32 * TAU / segments as f32).sin_cos();
        mesh.positions
            .push(Vec3::new(radius * cos, height, -radius * sin));
        mesh.normals.push(Vec3::Y * side);
        mesh.uvs
            .push(Vec2::new(0.5 + 0.5 * cos, 0.5 - 0.5 * side * sin));
        mesh.tangents.push(Vec4::new(1.0, 0.0, 0.0, 1.0));
    }
    for step in 2..segments {
        let (b, c) = (first + step - 1, first + step);
        mesh.indices.extend(if side > 0.0 {
            [first, b, c]
        } else {
            [first, c, b]
        });
    }
}

/// A ring around the y axis: `radius` to the middle of the tube, whose own
/// radius is `tube`. `segments` go around the axis, `sides` around the tube.
/// Texture coordinates 0 to 1, once around each way.
#[must_use]
pub fn torus(radius: f32, tube: f32, segments: u32, sides: u32) -> Mesh {
    let (radius, tube) = (length(radius), length(tube));
    let (segments, sides) = (count(segments, 3), count(sides, 3));
    let mut mesh = Mesh::default().named("torus");
    for row in 0..=sides {
        // From the inside by the bottom and the outside to the top.
        let along = row as f32 / sides as f32;
        let (rise, out) = ((row % sides) as f32 * TAU / sides as f32).sin_cos();
        let (rise, out) = (-rise, -out);
        for column in 0..=segments {
            let turn = column as f32 / segments as f32;
            let (sin, cos) = ((column % segments) as f32 * TAU / segments as f32).sin_cos();
            let r = radius + tube * out;
            mesh.positions
                .push(Vec3::new(r * cos, tube * rise, -r * sin));
            mesh.normals.push(Vec3::new(out * cos, rise, -out * sin));
            mesh.uvs.push(Vec2::new(turn, 1.0 - along));
            mesh.tangents.push(Vec4::new(-sin, 0.0, -cos, 1.0));
        }
    }
    add_cells(&mut mesh, 0, segments, sides);
    mesh
}
