//! Shapes from a profile turned around an axis or drawn along one.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3, Vec4};

use super::flat::add_cells;
use super::{count, length};
use crate::Mesh;

/// A point of a profile: distance from the axis, height, and the outward
/// normal in the same plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProfilePoint {
    pub(super) at: Vec2,
    pub(super) normal: Vec2,
}

/// The outline of a turned shape, from its bottom to its top: x is the
/// distance from the axis, y the height, and the outside is to the right of
/// the way. It is made of parts; within a part the surface is smooth, between
/// parts it has an edge.
#[derive(Clone, Debug, Default)]
pub struct Profile {
    pub(super) parts: Vec<Vec<ProfilePoint>>,
}

impl Profile {
    /// An empty profile.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a straight part.
    #[must_use]
    pub fn line(mut self, from: Vec2, to: Vec2) -> Self {
        let normal = outward(to - from);
        self.parts.push(vec![
            ProfilePoint { at: from, normal },
            ProfilePoint { at: to, normal },
        ]);
        self
    }

    /// Adds a part of a circle between two angles (radians, 0 towards +x,
    /// counter-clockwise); bulging out where the angle grows, a hollow where
    /// it falls.
    #[must_use]
    pub fn arc(mut self, center: Vec2, radius: f32, from: f32, to: f32, steps: u32) -> Self {
        let steps = count(steps, 1);
        let side = if to < from { -1.0 } else { 1.0 };
        let point = |step: u32| {
            let direction = Vec2::from_angle(from + (to - from) * step as f32 / steps as f32);
            ProfilePoint {
                at: center + radius * direction,
                normal: side * direction,
            }
        };
        self.parts.push((0..=steps).map(point).collect());
        self
    }

    /// Adds a smooth part through the points of a function of 0 to 1.
    #[must_use]
    pub fn curve(mut self, steps: u32, point: impl Fn(f32) -> Vec2) -> Self {
        let steps = count(steps, 1);
        let at = |step: u32| point(step as f32 / steps as f32);
        // A slope over a part of a step: accurate, and clear of rounding.
        let reach = 0.1 / steps as f32;
        let part = (0..=steps).map(|step| {
            let t = step as f32 / steps as f32;
            let way = point((t + reach).min(1.0)) - point((t - reach).max(0.0));
            ProfilePoint {
                at: at(step),
                normal: outward(way),
            }
        });
        self.parts.push(part.collect());
        self
    }

    /// Adds the line through some points. Where it bends by less than `crease`
    /// (radians) the surface is smooth, elsewhere it has an edge. Points that
    /// repeat the one before are left out.
    #[must_use]
    pub fn outline(mut self, points: &[Vec2], crease: f32) -> Self {
        let mut points = points.to_vec();
        points.dedup();
        let normals: Vec<Vec2> = points
            .windows(2)
            .map(|pair| outward(pair[1] - pair[0]))
            .collect();
        let mut part = Vec::new();
        for (step, &normal) in normals.iter().enumerate() {
            if part.is_empty() {
                let at = points[step];
                part.push(ProfilePoint { at, normal });
            }
            let at = points[step + 1];
            match normals.get(step + 1) {
                Some(&next) if normal.angle_to(next).abs() < crease => {
                    let normal = (normal + next).normalize_or(normal);
                    part.push(ProfilePoint { at, normal });
                }
                _ => {
                    part.push(ProfilePoint { at, normal });
                    self.parts.push(std::mem::take(&mut part));
                }
            }
        }
        self
    }

    /// Length along the profile, without gaps between parts.
    #[must_use]
    pub fn length(&self) -> f32 {
        let steps = self.parts.iter().flat_map(|part| part.windows(2));
        steps.map(|pair| pair[0].at.distance(pair[1].at)).sum()
    }
}

/// To the right of a way.
fn outward(way: Vec2) -> Vec2 {
    Vec2::new(way.y, -way.x).normalize_or(Vec2::X)
}

/// A profile turned once around the y axis in `segments` (3 to 1024) steps.
/// `uv_scale` is how much u grows around and v along the whole of it.
#[must_use]
pub fn revolve(profile: &Profile, segments: u32, uv_scale: Vec2) -> Mesh {
    let segments = count(segments, 3);
    let whole = profile.length().max(f32::MIN_POSITIVE);
    let mut mesh = Mesh::default();
    let mut along = 0.0;
    for part in &profile.parts {
        let mut rows = Vec::with_capacity(part.len());
        for (row, point) in part.iter().enumerate() {
            if row > 0 {
                along += point.at.distance(part[row - 1].at);
            }
            let v = uv_scale.y * (1.0 - along / whole);
            let start = mesh.positions.len() as u32;
            let pole = point.at.x <= 0.0;
            rows.push(Row { start, pole });
            // At a pole each triangle has its own vertex, in its middle.
            let (columns, shift) = if pole {
                (segments, 0.5)
            } else {
                (segments + 1, 0.0)
            };
            for column in 0..columns {
                let turn = (column as f32 + shift) / segments as f32;
                add_ring_vertex(&mut mesh, *point, turn, v, uv_scale.x);
            }
        }
        for pair in rows.windows(2) {
            join_rows(&mut mesh, &pair[0], &pair[1], segments);
        }
    }
    mesh
}

/// A profile drawn along the x axis, `along` metres around the origin, as a
/// plasterer draws a template along a wall: what is distance from the axis for
/// [`revolve`] is here distance from the wall, towards +z. Open behind and at
/// both ends, which lie in walls. Two that meet in an inner corner pass through
/// each other, and their mitre comes by itself. Texture coordinates in metres.
#[must_use]
pub fn extrude(profile: &Profile, along: f32) -> Mesh {
    let along = length(along);
    let whole = profile.length();
    let mut mesh = Mesh::default().named("moulding");
    let mut risen = 0.0;
    for part in &profile.parts {
        let first = mesh.positions.len() as u32;
        for (row, point) in part.iter().enumerate() {
            if row > 0 {
                risen += point.at.distance(part[row - 1].at);
            }
            for x in [-0.5 * along, 0.5 * along] {
                mesh.positions.push(Vec3::new(x, point.at.y, point.at.x));
                mesh.normals
                    .push(Vec3::new(0.0, point.normal.y, point.normal.x));
                mesh.tangents.push(Vec4::new(1.0, 0.0, 0.0, 1.0));
                mesh.uvs.push(Vec2::new(x, whole - risen));
            }
        }
        add_cells(&mut mesh, first, 1, part.len().saturating_sub(1) as u32);
    }
    mesh
}

/// A ring of vertices, or the copies of a pole.
struct Row {
    start: u32,
    pole: bool,
}

/// A vertex at a share of the turn. The turn goes from +x by −z, which is to
/// the right as seen from outside.
fn add_ring_vertex(mesh: &mut Mesh, point: ProfilePoint, turn: f32, v: f32, u_scale: f32) {
    // The last column is exactly the first one.
    let angle = if turn == 1.0 { 0.0 } else { turn * TAU };
    let (sin, cos) = angle.sin_cos();
    let turned = |r: f32, y: f32| Vec3::new(r * cos, y, -r * sin);
    mesh.positions.push(turned(point.at.x.max(0.0), point.at.y));
    mesh.normals.push(turned(point.normal.x, point.normal.y));
    mesh.uvs.push(Vec2::new(turn * u_scale, v));
    mesh.tangents.push(Vec4::new(-sin, 0.0, -cos, 1.0));
}

fn join_rows(mesh: &mut Mesh, lower: &Row, upper: &Row, segments: u32) {
    for column in 0..segments {
        let (a, d) = (lower.start + column, upper.start + column);
        if !lower.pole {
            mesh.indices
                .extend([a, a + 1, if upper.pole { d } else { d + 1 }]);
        }
        if !upper.pole {
            mesh.indices.extend([a, d + 1, d]);
        }
    }
}
