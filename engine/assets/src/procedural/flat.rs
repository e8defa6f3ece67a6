//! Shapes with flat faces.

use glam::{UVec2, Vec2, Vec3, Vec4};

use super::{count, length};
use crate::Mesh;

/// A horizontal rectangle around the origin, facing up. `size` is along x and
/// z, `subdivisions` (1 to 1024 each) cuts it into that many cells. Texture
/// coordinates in metres from the corner at −x, −z.
#[must_use]
pub fn plane(size: Vec2, subdivisions: UVec2) -> Mesh {
    let size = Vec3::new(length(size.x), 0.0, length(size.y));
    let mut mesh = Mesh::default().named("plane");
    let corner = Vec3::new(-size.x, 0.0, size.z) / 2.0;
    add_face(
        &mut mesh,
        corner,
        Vec3::X * size.x,
        -Vec3::Z * size.z,
        subdivisions,
    );
    mesh
}

/// A box around the origin with edges along the axes. Texture coordinates in
/// metres on each face.
#[must_use]
pub fn cuboid(size: Vec3) -> Mesh {
    let size = Vec3::from_array(size.to_array().map(length));
    let mut mesh = Mesh::default().named("box");
    // Right and up as seen from outside; their cross product is the normal.
    for (right, up) in [
        (Vec3::X, Vec3::Y),
        (-Vec3::X, Vec3::Y),
        (-Vec3::Z, Vec3::Y),
        (Vec3::Z, Vec3::Y),
        (Vec3::X, -Vec3::Z),
        (Vec3::X, Vec3::Z),
    ] {
        let corner = (right.cross(up) - right - up) * size / 2.0;
        add_face(&mut mesh, corner, right * size, up * size, UVec2::ONE);
    }
    mesh
}

/// Adds a rectangle from its lower left corner and its two edges, as seen from
/// the front, with texture coordinates in metres.
fn add_face(mesh: &mut Mesh, corner: Vec3, right: Vec3, up: Vec3, cells: UVec2) {
    let (columns, rows) = (count(cells.x, 1), count(cells.y, 1));
    let normal = right.cross(up).normalize_or(Vec3::Y);
    let tangent = right.normalize_or(normal.any_orthonormal_vector());
    let size = Vec2::new(right.length(), up.length());
    let first = mesh.positions.len() as u32;
    for row in 0..=rows {
        for column in 0..=columns {
            let at = Vec2::new(column as f32 / columns as f32, row as f32 / rows as f32);
            mesh.positions.push(corner + right * at.x + up * at.y);
            mesh.normals.push(normal);
            mesh.uvs.push(Vec2::new(at.x, 1.0 - at.y) * size);
            mesh.tangents.push(Vec4::from((tangent, 1.0)));
        }
    }
    add_cells(mesh, first, columns, rows);
}

/// Adds the triangles of a grid of vertices, given row by row from the lower
/// left.
pub(super) fn add_cells(mesh: &mut Mesh, first: u32, columns: u32, rows: u32) {
    for row in 0..rows {
        for column in 0..columns {
            let a = first + row * (columns + 1) + column;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            mesh.indices.extend([a, b, c, a, c, d]);
        }
    }
}

/// [`add_cells`] without the triangles that have shrunk to a line or a point.
pub(super) fn add_cells_with_area(mesh: &mut Mesh, first: u32, columns: u32, rows: u32) {
    let before = mesh.indices.len();
    add_cells(mesh, first, columns, rows);
    let cells = mesh.indices.split_off(before);
    mesh.indices.extend(
        cells
            .chunks_exact(3)
            .filter(|corner| {
                let [a, b, c] = [0, 1, 2].map(|at| mesh.positions[corner[at] as usize]);
                (b - a).cross(c - a) != Vec3::ZERO
            })
            .flatten(),
    );
}
