//! Tangent frames for normal maps.
//!
//! Method: Lengyel, "Computing tangent space basis vectors for an arbitrary
//! mesh" (2001), with the sum at a vertex weighted by the triangle's angle
//! there, so that it does not depend on how a face was cut into triangles.

use glam::{Vec3, Vec4};

use crate::Mesh;

/// Direction of u and handedness on one triangle.
struct Frame {
    tangent: Vec3,
    mirrored: bool,
}

impl Mesh {
    /// Computes `tangents` from positions, normals and texture coordinates.
    ///
    /// A vertex between a mirrored and an unmirrored part of the picture can't
    /// have one frame for both: it is doubled, which appends to all attribute
    /// arrays. Where the texture coordinates give no direction, the tangent is
    /// any unit vector at right angles to the normal.
    pub fn recompute_tangents(&mut self) {
        let frames: Vec<Option<Frame>> = self
            .triangles()
            .map(|corners| self.triangle_frame(corners))
            .collect();

        self.split_mirrored(&frames);
        let mut sums = vec![Vec3::ZERO; self.positions.len()];
        let mut hands = vec![1.0; self.positions.len()];
        for (corners, frame) in self.triangles().zip(&frames) {
            let Some(frame) = frame else { continue };
            let positions = corners.map(|corner| self.positions[corner].as_dvec3());
            for (at, &vertex) in corners.iter().enumerate() {
                let normal = self.normals[vertex];
                let tangent = frame.tangent.reject_from_normalized(normal);
                let to_next = positions[(at + 1) % 3] - positions[at];
                let to_last = positions[(at + 2) % 3] - positions[at];
                let angle = to_next.angle_between(to_last);
                if angle.is_finite() {
                    sums[vertex] += tangent.normalize_or_zero() * angle as f32;
                }
                if frame.mirrored {
                    hands[vertex] = -1.0;
                }
            }
        }

        self.tangents.clear();
        self.tangents
            .extend(
                sums.iter()
                    .zip(&self.normals)
                    .zip(&hands)
                    .map(|((sum, normal), &hand)| {
                        let sum = sum.reject_from_normalized(*normal);
                        let tangent = sum.try_normalize().unwrap_or_else(|| {
                            normal
                                .try_normalize()
                                .unwrap_or(Vec3::Y)
                                .any_orthonormal_vector()
                        });
                        Vec4::from((tangent, hand))
                    }),
            );
    }

    fn triangle_frame(&self, corners: [usize; 3]) -> Option<Frame> {
        // Products of tiny edges and texture coordinates vanish in single precision.
        let [a, b, c] = corners.map(|corner| self.positions[corner].as_dvec3());
        let [uv_a, uv_b, uv_c] = corners.map(|corner| self.uvs[corner].as_dvec2());
        let (edge_1, edge_2) = (b - a, c - a);
        let (uv_1, uv_2) = (uv_b - uv_a, uv_c - uv_a);
        // Twice the signed area in the picture. With v downwards it is negative
        // for a triangle that is seen from the front and not mirrored.
        let area = uv_1.perp_dot(uv_2);
        let tangent = (edge_1 * uv_2.y - edge_2 * uv_1.y) * area.signum();
        if area == 0.0 {
            return None;
        }
        Some(Frame {
            tangent: tangent.try_normalize()?.as_vec3(),
            mirrored: area > 0.0,
        })
    }

    /// Gives the mirrored triangles their own copies of the vertices that
    /// they share with unmirrored ones.
    fn split_mirrored(&mut self, frames: &[Option<Frame>]) {
        const PLAIN: u8 = 1;
        const MIRRORED: u8 = 2;
        let side = |frame: &Option<Frame>| match frame {
            Some(frame) if frame.mirrored => MIRRORED,
            Some(_) => PLAIN,
            None => 0,
        };
        let mut used = vec![0_u8; self.positions.len()];
        for (corners, frame) in self.triangles().zip(frames) {
            for vertex in corners {
                used[vertex] |= side(frame);
            }
        }
        if !used.contains(&(PLAIN | MIRRORED)) {
            return;
        }
        let mut copies = vec![u32::MAX; self.positions.len()];
        for (triangle, frame) in frames.iter().enumerate() {
            if side(frame) != MIRRORED {
                continue;
            }
            for at in triangle * 3..triangle * 3 + 3 {
                let vertex = self.indices[at] as usize;
                if used[vertex] != PLAIN | MIRRORED {
                    continue;
                }
                if copies[vertex] == u32::MAX {
                    copies[vertex] = self.positions.len() as u32;
                    self.positions.push(self.positions[vertex]);
                    self.normals.push(self.normals[vertex]);
                    self.uvs.push(self.uvs[vertex]);
                }
                self.indices[at] = copies[vertex];
            }
        }
    }
}
