//! A piece of wall with a round opening at its foot.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::flat::add_cells_with_area;
use super::{count, length};
use crate::Mesh;

/// The wall above and beside an [`Arch`](super::Arch): a slab in the plane of
/// x and y that stands on the springing line y = 0, with its depth along z and
/// a half-round opening in the middle of its foot. Side by side such pieces
/// make an arcade. Closed on all sides; texture coordinates in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArchedWall {
    /// Along x: the distance from column to column.
    pub width: f32,
    /// From the springing line to the top; at least the radius.
    pub height: f32,
    /// Thickness of the wall, along z.
    pub depth: f32,
    /// Of the opening, at most half the width.
    pub radius: f32,
    /// Straight pieces that the opening is made of, 2 to 1024.
    pub segments: u32,
}

impl Default for ArchedWall {
    fn default() -> Self {
        Self {
            width: 3.0,
            height: 2.0,
            depth: 0.45,
            radius: 1.2,
            segments: 36,
        }
    }
}

impl ArchedWall {
    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let half = Vec2::new(0.5 * length(self.width), length(self.height));
        let radius = length(self.radius).min(half.x).min(half.y);
        let front = 0.5 * length(self.depth);
        let angles = self.angles(half);
        let inner = angles.iter().map(|&angle| radius * direction(angle));
        let inner: Vec<Vec2> = inner.collect();
        let outer = angles
            .iter()
            .map(|&angle| on_outline(direction(angle), half));
        let mut outer: Vec<Vec2> = outer.collect();

        let mut mesh = Mesh::default().named("arched wall");
        add_front_and_back(&mut mesh, &inner, &outer, front);
        // The underside of the opening looks at its middle.
        add_ribbon(&mut mesh, &inner, front, |at| -at.normalize_or(Vec2::Y));
        // The outline, edge by edge, so that each has its own normal.
        let corner = |x: f32| {
            let corner = Vec2::new(x, half.y);
            outer.iter().position(|&at| at == corner).unwrap_or(0)
        };
        let (right, left) = (corner(half.x), corner(-half.x));
        outer.reverse();
        let last = outer.len() - 1;
        let (right, left) = (last - right, last - left);
        add_ribbon(&mut mesh, &outer[..=left], front, |_| -Vec2::X);
        add_ribbon(&mut mesh, &outer[left..=right], front, |_| Vec2::Y);
        add_ribbon(&mut mesh, &outer[right..], front, |_| Vec2::X);
        // Both feet.
        for [from, to] in [[half.x, radius], [-radius, -half.x]] {
            let foot = [from, to].map(|x| Vec2::new(x, 0.0));
            add_ribbon(&mut mesh, &foot, front, |_| -Vec2::Y);
        }
        mesh
    }

    /// Angles from +x to −x at which the front is cut: evenly, and through both
    /// upper corners.
    fn angles(&self, half: Vec2) -> Vec<f32> {
        let segments = count(self.segments, 2);
        let corner = half.y.atan2(half.x);
        let mut angles: Vec<f32> = (0..=segments)
            .map(|step| PI * step as f32 / segments as f32)
            .collect();
        // An even cut close to a corner gives way to it: no slivers.
        let apart = 0.25 * PI / segments as f32;
        angles.retain(|&angle| {
            let ends = angle == 0.0 || angle == PI;
            ends || ((angle - corner).abs() > apart && (PI - angle - corner).abs() > apart)
        });
        if corner > 0.0 {
            angles.extend([corner, PI - corner]);
        }
        angles.sort_by(f32::total_cmp);
        angles.dedup();
        angles
    }
}

/// As [`Vec2::from_angle`], but exactly level at both ends.
fn direction(angle: f32) -> Vec2 {
    if angle == 0.0 {
        Vec2::X
    } else if angle == PI {
        -Vec2::X
    } else {
        Vec2::from_angle(angle)
    }
}

/// Where a ray from the middle of the foot meets the outline.
fn on_outline(direction: Vec2, half: Vec2) -> Vec2 {
    let reach = |extent: f32, along: f32| {
        if along.abs() > f32::MIN_POSITIVE {
            extent / along.abs()
        } else {
            f32::INFINITY
        }
    };
    let to_side = reach(half.x, direction.x);
    let to_top = reach(half.y, direction.y);
    let met = direction * to_side.min(to_top);
    // Exactly on the outline, whatever the rounding.
    if (to_side - to_top).abs() <= 1e-5 * to_side {
        Vec2::new(half.x.copysign(direction.x), half.y)
    } else if to_side < to_top {
        Vec2::new(half.x.copysign(direction.x), met.y)
    } else {
        Vec2::new(met.x, half.y)
    }
}

/// The two faces of the wall, between the opening and the outline.
fn add_front_and_back(mesh: &mut Mesh, inner: &[Vec2], outer: &[Vec2], front: f32) {
    for side in [1.0, -1.0] {
        let first = mesh.positions.len() as u32;
        for row in [inner, outer] {
            // The angle falls to the right as seen from the front.
            for step in 0..row.len() {
                let at = row[if side > 0.0 {
                    row.len() - 1 - step
                } else {
                    step
                }];
                mesh.positions.push(at.extend(side * front));
                mesh.normals.push(Vec3::Z * side);
                mesh.tangents.push((Vec3::X * side).extend(1.0));
                mesh.uvs.push(Vec2::new(side * at.x, -at.y));
            }
        }
        add_cells_with_area(mesh, first, inner.len() as u32 - 1, 1);
    }
}

/// A strip as deep as the wall along a line whose outside is to the left.
fn add_ribbon(mesh: &mut Mesh, line: &[Vec2], front: f32, normal: impl Fn(Vec2) -> Vec2) {
    let first = mesh.positions.len() as u32;
    for z in [front, -front] {
        let mut along = 0.0;
        for (step, &at) in line.iter().enumerate() {
            if step > 0 {
                along += at.distance(line[step - 1]);
            }
            let normal = normal(at);
            mesh.positions.push(at.extend(z));
            mesh.normals.push(normal.extend(0.0));
            mesh.tangents.push((-normal.perp()).extend(0.0).extend(1.0));
            mesh.uvs.push(Vec2::new(along, z));
        }
    }
    add_cells_with_area(mesh, first, line.len() as u32 - 1, 1);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_opening_is_cut_out_of_the_slab() {
        // The corners lie at 45 degrees, where one of the even cuts is.
        let wall = ArchedWall {
            width: 4.0,
            ..ArchedWall::default()
        };
        let mesh = wall.mesh();
        // A block less half of a regular polygon of 72 sides.
        let polygon = 0.5 * 72.0 * (2.0 * std::f64::consts::PI / 72.0).sin() * 1.44;
        let volume = (4.0 * 2.0 - 0.5 * polygon) * 0.45;
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-5);
        let bounds = mesh.bounds();
        assert!((bounds.half_extents - Vec3::new(2.0, 1.0, 0.225)).length() < 1e-6);
        assert!((bounds.center - Vec3::Y).length() < 1e-6);
    }

    #[test]
    fn neighbours_meet_without_a_gap() {
        // Whatever the cut, the sides are exactly half the width away.
        for (width, height) in [(3.0, 2.0), (1.6, 4.0), (2.5, 1.25), (7.0, 1.3)] {
            let wall = ArchedWall {
                width,
                height,
                radius: 0.7,
                ..ArchedWall::default()
            };
            let mesh = wall.mesh();
            let outside = mesh.positions.iter().filter(|at| {
                let on_side = at.x.abs() == 0.5 * width;
                let on_level = at.y == height || at.y == 0.0;
                let on_opening = (at.truncate().length() - 0.7).abs() < 1e-5;
                !(on_side || on_level || on_opening)
            });
            assert_eq!(outside.count(), 0, "{width} x {height}");
            for corner in [-0.5 * width, 0.5 * width] {
                let top = Vec2::new(corner, height);
                assert!(mesh.positions.iter().any(|at| at.truncate() == top));
            }
        }
    }
}
