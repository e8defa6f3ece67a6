//! Triangle meshes, one array per vertex attribute.

use glam::{Affine3A, Mat3, Vec2, Vec3, Vec4};
use lightbench_world::MeshBounds;
use thiserror::Error;

use crate::Digest;
use crate::digest::Hasher;

/// A list of triangles over shared vertices.
///
/// The attribute arrays have equal lengths; every three entries of `indices`
/// are a triangle, counter-clockwise as seen from its front. Positions have
/// their own array because many passes (depth, shadows, culling) need nothing
/// else.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Name in the scene. Need not be unique.
    pub name: String,
    /// Metres, in the mesh's own space.
    pub positions: Vec<Vec3>,
    /// Unit length, out of the front.
    pub normals: Vec<Vec3>,
    /// Origin at the top left of the picture, v downwards.
    pub uvs: Vec<Vec2>,
    /// Unit direction in which u grows, at right angles to the normal, and in
    /// `w` the handedness: `w * normal.cross(tangent)` points up the picture.
    pub tangents: Vec<Vec4>,
    /// Three vertices per triangle.
    pub indices: Vec<u32>,
}

/// Why a mesh can't be drawn.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MeshError {
    /// Attribute arrays of different lengths.
    #[error(
        "mesh `{name}`: {positions} positions, {normals} normals, {uvs} texture coordinates and \
         {tangents} tangents; the counts must be equal"
    )]
    Lengths {
        /// The mesh.
        name: String,
        /// Count of positions.
        positions: usize,
        /// Count of normals.
        normals: usize,
        /// Count of texture coordinates.
        uvs: usize,
        /// Count of tangents.
        tangents: usize,
    },
    /// An index list that is no list of triangles.
    #[error("mesh `{name}`: {count} indices; a list of triangles has a multiple of three")]
    IndexCount {
        /// The mesh.
        name: String,
        /// Count of indices.
        count: usize,
    },
    /// An index without a vertex.
    #[error("mesh `{name}`: index {index} in a mesh of {vertices} vertices")]
    IndexRange {
        /// The mesh.
        name: String,
        /// The first wrong index.
        index: u32,
        /// Count of vertices.
        vertices: usize,
    },
    /// A coordinate that is infinite or no number.
    #[error("mesh `{name}`: vertex {vertex} has a coordinate that is infinite or not a number")]
    NotFinite {
        /// The mesh.
        name: String,
        /// The first such vertex.
        vertex: usize,
    },
}

impl Mesh {
    /// The same mesh with a name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// Bytes of all arrays together.
    #[must_use]
    pub fn byte_count(&self) -> usize {
        let vertex = size_of::<Vec3>() * 2 + size_of::<Vec2>() + size_of::<Vec4>();
        self.positions.len() * vertex + size_of_val(self.indices.as_slice())
    }

    /// A digest of the name and of every bit of the arrays.
    pub(crate) fn digest(&self) -> Digest {
        let mut hasher = Hasher::default();
        let mut numbers = |numbers: &[f32]| {
            let mut bytes = [0; 16];
            for (bytes, number) in bytes.chunks_exact_mut(4).zip(numbers) {
                bytes.copy_from_slice(&number.to_le_bytes());
            }
            hasher.add(&bytes[..4 * numbers.len()]);
        };
        self.positions.iter().for_each(|v| numbers(&v.to_array()));
        self.normals.iter().for_each(|v| numbers(&v.to_array()));
        self.uvs.iter().for_each(|v| numbers(&v.to_array()));
        self.tangents.iter().for_each(|v| numbers(&v.to_array()));
        self.indices
            .iter()
            .for_each(|index| hasher.add(&index.to_le_bytes()));
        // The lengths, so that what ends one array can't begin the next.
        for length in [
            self.positions.len(),
            self.normals.len(),
            self.uvs.len(),
            self.tangents.len(),
        ] {
            hasher.add(&length.to_le_bytes());
        }
        hasher.add(self.name.as_bytes());
        hasher.finish()
    }

    /// The corners of each triangle, as vertex numbers.
    pub fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.indices
            .chunks_exact(3)
            .map(|corner| [corner[0] as usize, corner[1] as usize, corner[2] as usize])
    }

    /// Box along the axes and sphere around the same centre. A mesh without
    /// vertices has a point at the origin.
    #[must_use]
    pub fn bounds(&self) -> MeshBounds {
        let Some(&first) = self.positions.first() else {
            return MeshBounds {
                center: Vec3::ZERO,
                half_extents: Vec3::ZERO,
                radius: 0.0,
            };
        };
        let (mut low, mut high) = (first, first);
        for &position in &self.positions {
            low = low.min(position);
            high = high.max(position);
        }
        // Half of each before the sum, so that huge coordinates don't overflow.
        let center = low * 0.5 + high * 0.5;
        let farthest = self
            .positions
            .iter()
            .map(|position| position.distance_squared(center))
            .fold(0.0, f32::max);
        MeshBounds {
            center,
            half_extents: (high * 0.5 - low * 0.5).abs(),
            radius: farthest.sqrt(),
        }
    }

    /// Whether the mesh can be drawn.
    ///
    /// # Errors
    /// The first rule of the type that it breaks.
    pub fn validate(&self) -> Result<(), MeshError> {
        let name = || self.name.clone();
        let vertices = self.positions.len();
        if [self.normals.len(), self.uvs.len(), self.tangents.len()] != [vertices; 3] {
            return Err(MeshError::Lengths {
                name: name(),
                positions: vertices,
                normals: self.normals.len(),
                uvs: self.uvs.len(),
                tangents: self.tangents.len(),
            });
        }
        if !self.indices.len().is_multiple_of(3) {
            return Err(MeshError::IndexCount {
                name: name(),
                count: self.indices.len(),
            });
        }
        if let Some(&index) = self
            .indices
            .iter()
            .find(|&&index| index as usize >= vertices)
        {
            return Err(MeshError::IndexRange {
                name: name(),
                index,
                vertices,
            });
        }
        let finite = |vertex: &usize| {
            self.positions[*vertex].is_finite()
                && self.normals[*vertex].is_finite()
                && self.uvs[*vertex].is_finite()
                && self.tangents[*vertex].is_finite()
        };
        match (0..vertices).find(|vertex| !finite(vertex)) {
            Some(vertex) => Err(MeshError::NotFinite {
                name: name(),
                vertex,
            }),
            None => Ok(()),
        }
    }

    /// Adds a moved copy of another mesh, to draw both as one. Reflections
    /// keep fronts in front, and non-uniform scales keep normals upright.
    pub fn append(&mut self, other: &Mesh, transform: Affine3A) {
        let linear = Mat3::from(transform.matrix3);
        let mirrored = linear.determinant() < 0.0;
        let hand = if mirrored { -1.0 } else { 1.0 };
        // The cofactors turn normals as the inverse transpose does, and exist
        // for flattening transforms too.
        let cofactors = Mat3::from_cols(
            linear.y_axis.cross(linear.z_axis),
            linear.z_axis.cross(linear.x_axis),
            linear.x_axis.cross(linear.y_axis),
        ) * hand;

        let first = self.positions.len() as u32;
        self.positions.extend(
            other
                .positions
                .iter()
                .map(|&p| transform.transform_point3(p)),
        );
        self.uvs.extend_from_slice(&other.uvs);
        for (&normal, &tangent) in other.normals.iter().zip(&other.tangents) {
            let normal = (cofactors * normal).normalize_or(Vec3::Y);
            let direction = linear * tangent.truncate();
            let direction = direction.reject_from_normalized(normal);
            let direction = direction.normalize_or(normal.any_orthonormal_vector());
            self.normals.push(normal);
            self.tangents.push(direction.extend(tangent.w * hand));
        }
        self.indices
            .extend(other.indices.chunks_exact(3).flat_map(|corner| {
                let [a, b, c] = [corner[0] + first, corner[1] + first, corner[2] + first];
                if mirrored { [a, c, b] } else { [a, b, c] }
            }));
    }

    /// Area of all triangles, in square metres.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.triangles()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| self.positions[corner].as_dvec3());
                0.5 * (b - a).cross(c - a).length()
            })
            .sum()
    }

    /// Volume inside a closed mesh, in cubic metres, by the divergence
    /// theorem; negative where the mesh is inside out.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.triangles()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| self.positions[corner].as_dvec3());
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }
}
