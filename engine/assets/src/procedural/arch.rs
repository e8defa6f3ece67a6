//! A masonry arch.

use std::f32::consts::PI;

use glam::{UVec2, Vec2, Vec3};

use super::flat::add_cells_with_area;
use super::{count, length};
use crate::Mesh;

/// A round arch in the plane of x and y, standing on the springing line y = 0,
/// with its depth along z. It is built as masons build it, of wedges
/// (voussoirs) with recessed joints of mortar between them; without joints it
/// is one smooth ring. Texture coordinates in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arch {
    /// Half the clear width below the arch, to the inner curve (intrados).
    pub inner_radius: f32,
    /// To the outer curve (extrados).
    pub outer_radius: f32,
    /// Thickness of the wall, along z.
    pub depth: f32,
    /// Angle that the arch spans, up to a full ring, radians.
    pub span: f32,
    /// Number of wedges, 1 to 1024. An odd one gives a keystone.
    pub voussoirs: u32,
    /// Straight pieces that the curve of one wedge is made of, 1 to 1024.
    pub segments: u32,
    /// Width and depth of the joints; 0 for none.
    pub joint: f32,
}

impl Default for Arch {
    fn default() -> Self {
        Self {
            inner_radius: 1.0,
            outer_radius: 1.35,
            depth: 0.5,
            span: PI,
            voussoirs: 13,
            segments: 3,
            joint: 0.02,
        }
    }
}

/// A part of a ring: a wedge, or the mortar behind all of them.
struct Wedge {
    inner: f32,
    outer: f32,
    /// Half the depth.
    front: f32,
    /// Angles from +x, growing towards +y.
    from: f32,
    to: f32,
    segments: u32,
    /// Whether the ends are seen.
    ends: bool,
}

impl Arch {
    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let inner = length(self.inner_radius);
        let outer = length(self.outer_radius).max(inner);
        let depth = length(self.depth);
        let span = length(self.span).min(2.0 * PI);
        let voussoirs = count(self.voussoirs, 1);
        let segments = count(self.segments, 1)
            .min(super::MAX_SEGMENTS / voussoirs)
            .max(1);
        // A joint may take a quarter of the stone at most.
        let joint = length(self.joint)
            .min((outer - inner) / 4.0)
            .min(depth / 4.0);

        let mut mesh = Mesh::default().named("arch");
        let start = (PI - span) / 2.0;
        let whole = Wedge {
            inner,
            outer,
            front: depth / 2.0,
            from: start,
            to: start + span,
            segments: segments * voussoirs,
            ends: span < 2.0 * PI,
        };
        if joint <= 0.0 || voussoirs == 1 {
            whole.add_to(&mut mesh);
            return mesh;
        }
        Wedge {
            inner: inner + joint,
            outer: outer - joint,
            front: whole.front - joint,
            ..whole
        }
        .add_to(&mut mesh);
        let angle = span / voussoirs as f32;
        // Half of the joint's width at the inner curve, as an angle.
        let gap = (0.5 * joint / inner.max(joint)).min(angle / 4.0);
        for stone in 0..voussoirs {
            let from = start + angle * stone as f32;
            Wedge {
                from: if stone == 0 && whole.ends {
                    from
                } else {
                    from + gap
                },
                to: from + angle
                    - if stone + 1 == voussoirs && whole.ends {
                        0.0
                    } else {
                        gap
                    },
                segments,
                ends: true,
                ..whole
            }
            .add_to(&mut mesh);
        }
        mesh
    }
}

/// A vertex before it is put into the arrays of a mesh.
struct Vertex {
    position: Vec3,
    normal: Vec3,
    tangent: Vec3,
    uv: Vec2,
}

impl Wedge {
    /// Adds the six faces, each a grid of (x to the right, y up), both 0 to 1,
    /// as it is seen from outside.
    fn add_to(&self, mesh: &mut Mesh) {
        let (inner, outer, front) = (self.inner, self.outer, self.front);
        let around = UVec2::new(self.segments, 1);
        let angle = |t: f32| self.from + (self.to - self.from) * t;
        let radius = |t: f32| inner + (outer - inner) * t;
        let z = |t: f32| front * (2.0 * t - 1.0);

        // Outer and inner curve: the angle falls to the right.
        for (radius, side) in [(outer, 1.0), (inner, -1.0)] {
            let face = |x: f32, y: f32| {
                let angle = angle(1.0 - x);
                let out = Vec2::from_angle(angle);
                let z = -side * z(y);
                Vertex {
                    position: (out * radius).extend(z),
                    normal: out.extend(0.0) * side,
                    tangent: -out.perp().extend(0.0),
                    uv: Vec2::new(-angle * radius, side * z),
                }
            };
            if radius > 0.0 {
                add_grid(mesh, around, face);
            }
        }
        // Front and back of the wall.
        for side in [1.0, -1.0] {
            let face = |x: f32, y: f32| {
                let angle = angle(if side > 0.0 { 1.0 - x } else { x });
                let at = Vec2::from_angle(angle) * radius(y);
                Vertex {
                    position: at.extend(side * front),
                    normal: Vec3::Z * side,
                    tangent: Vec3::X * side,
                    uv: Vec2::new(side * at.x, -at.y),
                }
            };
            add_grid(mesh, around, face);
        }
        // Both ends.
        if self.ends {
            for (end, side) in [(0.0, -1.0), (1.0, 1.0)] {
                let out = Vec2::from_angle(angle(end));
                let face = |x: f32, y: f32| Vertex {
                    position: (out * radius(y)).extend(side * z(x)),
                    normal: out.perp().extend(0.0) * side,
                    tangent: Vec3::Z * side,
                    uv: Vec2::new(z(x), -radius(y)),
                };
                add_grid(mesh, UVec2::ONE, face);
            }
        }
    }
}

fn add_grid(mesh: &mut Mesh, cells: UVec2, vertex: impl Fn(f32, f32) -> Vertex) {
    let first = mesh.positions.len() as u32;
    for row in 0..=cells.y {
        for column in 0..=cells.x {
            let x = column as f32 / cells.x as f32;
            let vertex = vertex(x, row as f32 / cells.y as f32);
            mesh.positions.push(vertex.position);
            mesh.normals.push(vertex.normal);
            mesh.tangents.push(vertex.tangent.extend(1.0));
            mesh.uvs.push(vertex.uv);
        }
    }
    // Where the inner radius is 0, half of the triangles shrink to a line.
    add_cells_with_area(mesh, first, cells.x, cells.y);
}
