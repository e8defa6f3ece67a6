//! Meshes from flat faces, corner by corner.

use std::fmt;
use std::sync::Arc;

use lightbench_assets::{Digest, Mesh};
use lightbench_world::glam::{DVec3, Vec2, Vec3};
use rhai::Array;

use crate::api::{Arguments, Mistake, spell_call};

/// The most corners of one face.
const MAX_CORNERS: usize = 1024;

/// The corners of each face. They may be many, so their `Debug` writes only the digest of their
/// bits, and their call is spelled only for files.
#[derive(Clone)]
pub(super) struct Corners {
    faces: Arc<[Vec<Vec3>]>,
    digest: Digest,
}

impl fmt::Debug for Corners {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.digest)
    }
}

impl Corners {
    fn new(faces: Vec<Vec<Vec3>>) -> Self {
        let mut bytes = Vec::new();
        for face in &faces {
            bytes.extend(face.len().to_le_bytes());
            let numbers = face.iter().flat_map(|corner| corner.to_array());
            bytes.extend(numbers.flat_map(f32::to_le_bytes));
        }
        Self {
            faces: faces.into(),
            digest: Digest::of(&bytes),
        }
    }

    /// The call that makes them.
    pub(super) fn spelled(&self) -> String {
        let corner = |corner: &Vec3| spell_call("vec3", corner.as_dvec3());
        let face = |face: &Vec<Vec3>| {
            let corners: Vec<String> = face.iter().map(corner).collect();
            format!("[{}]", corners.join(", "))
        };
        let faces: Vec<String> = self.faces.iter().map(face).collect();
        format!("faces([{}])", faces.join(", "))
    }
}

/// Reads an array of faces, each an array of at least three corners.
pub(super) fn read(a: &Arguments) -> Result<Corners, Mistake> {
    let wanted = "an array of faces, each an array of three or more corners, as in \
                  `[[vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0)]]`";
    let wrong = || a.wrong(0, wanted);
    let mut faces = Vec::new();
    // There may be many: they are read in place.
    let listed = a.value(0).read_lock::<Array>();
    for face in listed.ok_or_else(|| a.wrong(0, "an array"))?.iter() {
        let corners = face.read_lock::<Array>().ok_or_else(wrong)?;
        let mut points = Vec::with_capacity(corners.len());
        for corner in corners.iter() {
            let point = corner.read_lock::<DVec3>().ok_or_else(wrong)?;
            points.push(point.as_vec3());
        }
        if !(3..=MAX_CORNERS).contains(&points.len()) {
            return Err(Mistake::new(format!(
                "a face has 3 to {MAX_CORNERS} corners, not {}",
                points.len()
            )));
        }
        if !points.iter().all(|point| point.is_finite()) {
            return Err(Mistake::new("a corner is infinite or not a number"));
        }
        faces.push(points);
    }
    Ok(Corners::new(faces))
}

/// The mesh of flat convex faces, seen from the side on which their corners run counter-clockwise.
/// Texture coordinates in metres from the first corner, u along the first edge.
pub(super) fn mesh(corners: &Corners) -> Mesh {
    let mut mesh = Mesh::default().named("faces");
    for corners in corners.faces.iter() {
        let normal = newell(corners);
        let first = corners[0];
        let along = (corners[1] - first)
            .try_normalize()
            .unwrap_or_else(|| normal.any_orthonormal_vector());
        // At right angles to the normal, even where the corners are not quite in one plane.
        let tangent = (along - normal * along.dot(normal))
            .try_normalize()
            .unwrap_or_else(|| normal.any_orthonormal_vector());
        let up = normal.cross(tangent);
        let start = mesh.positions.len() as u32;
        for &corner in corners {
            let offset = corner - first;
            mesh.positions.push(corner);
            mesh.normals.push(normal);
            mesh.uvs
                .push(Vec2::new(offset.dot(tangent), -offset.dot(up)));
            mesh.tangents.push(tangent.extend(1.0));
        }
        for third in 2..corners.len() as u32 {
            mesh.indices
                .extend([start, start + third - 1, start + third]);
        }
    }
    mesh
}

/// Newell's normal (Sutherland, Sproull and Schumacker 1974), which no three corners in one line
/// can spoil.
fn newell(corners: &[Vec3]) -> Vec3 {
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .map(|(a, b)| (*a - corners[0]).cross(*b - corners[0]))
        .sum::<Vec3>()
        .try_normalize()
        .unwrap_or(Vec3::Y)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_slanted_square_is_a_whole_mesh() {
        let square = vec![
            Vec3::ZERO,
            Vec3::new(2.0, 0.0, 0.0),
            Vec3::new(2.0, 2.0, -2.0),
            Vec3::new(0.0, 2.0, -2.0),
        ];
        let mesh = mesh(&Corners::new(vec![square]));
        mesh.validate().unwrap();
        assert_eq!(mesh.triangle_count(), 2);
        assert!((mesh.area() - 2.0 * 8_f64.sqrt()).abs() < 1e-6);
        let expected = Vec3::new(0.0, 1.0, 1.0).normalize();
        for normal in &mesh.normals {
            assert!(normal.distance(expected) < 1e-6);
        }
        // Up the picture is up the square: v falls with the height.
        assert!((mesh.uvs[2] - Vec2::new(2.0, -8_f32.sqrt())).length() < 1e-5);
    }

    #[test]
    fn corners_are_told_apart_by_every_bit_and_by_their_faces() {
        let of = |faces: &[&[Vec3]]| {
            let faces = faces.iter().map(|face| face.to_vec()).collect();
            format!("{:?}", Corners::new(faces))
        };
        let next = Vec3::new(1.0, f32::from_bits(1), 0.0);
        assert_eq!(of(&[&[Vec3::X, Vec3::Y]]), of(&[&[Vec3::X, Vec3::Y]]));
        assert_ne!(of(&[&[Vec3::X, Vec3::Y]]), of(&[&[next, Vec3::Y]]));
        assert_ne!(of(&[&[Vec3::X, Vec3::Y]]), of(&[&[Vec3::X], &[Vec3::Y]]));
    }

    #[test]
    fn faces_without_an_area_do_no_harm() {
        let line = vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
        let point = vec![Vec3::ONE; 5];
        mesh(&Corners::new(vec![line, point])).validate().unwrap();
    }
}
