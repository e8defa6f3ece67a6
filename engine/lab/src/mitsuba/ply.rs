//! Meshes as binary PLY files (Turk 1994, "The PLY Polygon File Format").

use lightbench_assets::Mesh;

/// The bytes of a mesh's file: positions, normals, texture coordinates, and triangles.
pub fn encode(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n\
         property float nx\nproperty float ny\nproperty float nz\n\
         property float u\nproperty float v\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        mesh.vertex_count(),
        mesh.triangle_count()
    )
    .into_bytes();
    let vertices = mesh.positions.iter().zip(&mesh.normals).zip(&mesh.uvs);
    for ((position, normal), uv) in vertices {
        let values = [position.to_array(), normal.to_array()];
        for value in values.as_flattened().iter().chain(&uv.to_array()) {
            bytes.extend(value.to_le_bytes());
        }
    }
    for corners in mesh.indices.chunks_exact(3) {
        bytes.push(3);
        for corner in corners {
            bytes.extend(corner.to_le_bytes());
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec3, Vec4};

    #[test]
    fn a_triangle_becomes_a_header_and_its_bytes() {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
            tangents: vec![Vec4::X; 3],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        };
        let bytes = encode(&mesh);
        let header = String::from_utf8_lossy(&bytes[..bytes.len() - 3 * 32 - 13]).into_owned();
        assert!(
            header.starts_with("ply\n") && header.ends_with("end_header\n"),
            "{header}"
        );
        assert!(header.contains("element vertex 3\n") && header.contains("element face 1\n"));
        let number = |at: usize| {
            let at = header.len() + 4 * at;
            f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
        };
        // The second vertex: x, y, z, its normal, its coordinates.
        let second = [8, 9, 10, 11, 12, 13, 14, 15].map(number);
        assert_eq!(second, [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
        assert_eq!(
            bytes[bytes.len() - 13..],
            [3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]
        );
    }
}
