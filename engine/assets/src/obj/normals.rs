//! Normals for models that bring none.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

/// The most triangles at one vertex that are compared with each other, for the
/// time grows with the square. At a vertex with more, all are smoothed.
const MAX_COMPARED: usize = 512;

/// Computes a normal for every corner of every triangle: the mean of the
/// triangles that meet at its position and whose planes make an angle of at
/// most `crease` (radians) with its own, each weighted by its angle there, so
/// that the mean does not depend on how faces were cut into triangles (Thürmer
/// and Wüthrich, "Computing vertex normals from polygonal facets", 1998).
///
/// Triangles without area have no say, and take the mean of their neighbours.
pub(super) fn smooth_normals(
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    crease: f32,
) -> Vec<[Vec3; 3]> {
    let place = weld(positions);
    let faces: Vec<DVec3> = triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|corner| positions[corner as usize].as_dvec3());
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    let fans = Fans::new(&place, triangles);
    // A little more, so that an angle of exactly the crease counts as smooth.
    let least = (f64::from(crease) + 1e-4)
        .clamp(0.0, std::f64::consts::PI)
        .cos();

    let weighted = |&(triangle, at): &(u32, u8)| {
        let corners =
            triangles[triangle as usize].map(|corner| positions[corner as usize].as_dvec3());
        let at = usize::from(at);
        let to_next = corners[(at + 1) % 3] - corners[at];
        let to_last = corners[(at + 2) % 3] - corners[at];
        let angle = to_next.cross(to_last).length().atan2(to_next.dot(to_last));
        faces[triangle as usize] * angle
    };
    let mut normals = vec![[Vec3::ZERO; 3]; triangles.len()];
    let mut weights = Vec::new();
    for fan in fans.iter() {
        weights.clear();
        weights.extend(fan.iter().map(weighted));
        let mean: DVec3 = weights.iter().sum();
        for &(triangle, at) in fan {
            let own = faces[triangle as usize];
            let sum = if fan.len() > MAX_COMPARED || own == DVec3::ZERO {
                mean
            } else {
                let near = |other: &(u32, u8)| faces[other.0 as usize].dot(own) >= least;
                let smooth = fan.iter().zip(&weights).filter(|(other, _)| near(other));
                smooth.map(|(_, weighted)| *weighted).sum()
            };
            let normal = sum.try_normalize().or_else(|| own.try_normalize());
            normals[triangle as usize][usize::from(at)] = normal.unwrap_or(DVec3::Y).as_vec3();
        }
    }
    normals
}

/// A number for each position, the same for equal ones.
fn weld(positions: &[Vec3]) -> Vec<u32> {
    let mut known = HashMap::with_capacity(positions.len());
    positions
        .iter()
        .map(|position| {
            // Adding 0 makes the two zeros one.
            let bits = position.to_array().map(|x| (x + 0.0).to_bits());
            let next = known.len() as u32;
            *known.entry(bits).or_insert(next)
        })
        .collect()
}

/// The corners that meet at each place, as (triangle, number of the corner),
/// in one array ordered by place.
struct Fans {
    starts: Vec<u32>,
    corners: Vec<(u32, u8)>,
}

impl Fans {
    fn new(place: &[u32], triangles: &[[u32; 3]]) -> Self {
        let places = place.iter().max().map_or(0, |&last| last as usize + 1);
        let place_of = |corner: u32| place[corner as usize] as usize;
        let mut starts = vec![0_u32; places + 1];
        for &corner in triangles.iter().flatten() {
            starts[place_of(corner) + 1] += 1;
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        let mut next = starts.clone();
        let mut corners = vec![(0, 0); triangles.len() * 3];
        for (triangle, of) in triangles.iter().enumerate() {
            for (at, &corner) in of.iter().enumerate() {
                let slot = &mut next[place_of(corner)];
                corners[*slot as usize] = (triangle as u32, at as u8);
                *slot += 1;
            }
        }
        Self { starts, corners }
    }

    fn iter(&self) -> impl Iterator<Item = &[(u32, u8)]> {
        self.starts
            .windows(2)
            .map(|pair| &self.corners[pair[0] as usize..pair[1] as usize])
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::procedural;

    #[test]
    fn a_box_keeps_its_edges_and_a_sphere_loses_them() {
        let cube = procedural::cuboid(Vec3::ONE);
        let triangles: Vec<[u32; 3]> = cube.indices.chunks(3).map(|c| [c[0], c[1], c[2]]).collect();
        for (corners, normals) in
            triangles
                .iter()
                .zip(smooth_normals(&cube.positions, &triangles, 1.0))
        {
            for (corner, normal) in corners.iter().zip(normals) {
                assert!(normal.distance(cube.normals[*corner as usize]) < 1e-6);
            }
        }
        // With a crease of over 90 degrees each corner points outward, whatever
        // way the squares were cut.
        for (corners, normals) in
            triangles
                .iter()
                .zip(smooth_normals(&cube.positions, &triangles, 1.6))
        {
            for (corner, normal) in corners.iter().zip(normals) {
                let outward = cube.positions[*corner as usize].normalize();
                assert!(normal.distance(outward) < 1e-6, "{normal} for {outward}");
            }
        }
        let sphere = procedural::icosphere(1e-6, 4);
        let triangles: Vec<[u32; 3]> = sphere
            .indices
            .chunks(3)
            .map(|c| [c[0], c[1], c[2]])
            .collect();
        let normals = smooth_normals(&sphere.positions, &triangles, 1.0);
        for (corners, normals) in triangles.iter().zip(normals) {
            for (corner, normal) in corners.iter().zip(normals) {
                assert!(normal.distance(sphere.normals[*corner as usize]) < 0.01);
            }
        }
    }

    #[test]
    fn the_crease_is_a_border() {
        // Two squares that meet at 45 degrees.
        let fold = [
            [0., 0., 0.],
            [0., 1., 0.],
            [1., 0., 0.],
            [1., 1., 0.],
            [-0.5, 0., 0.5],
            [-0.5, 1., 0.5],
        ];
        let positions = fold.map(Vec3::from_array);
        let triangles = [[0, 2, 3], [0, 3, 1], [4, 0, 1], [4, 1, 5]];
        let smooth = smooth_normals(&positions, &triangles, 46_f32.to_radians());
        let sharp = smooth_normals(&positions, &triangles, 44_f32.to_radians());
        assert_eq!(sharp[0], [Vec3::Z; 3]);
        assert_eq!(smooth[0][1], Vec3::Z);
        let between = Vec3::new(
            22.5_f32.to_radians().sin(),
            0.0,
            22.5_f32.to_radians().cos(),
        );
        assert!(
            smooth[0][0].distance(between) < 1e-6
                || smooth[0][0].distance(between * Vec3::new(-1., 1., 1.)) < 1e-6
        );
        assert!(smooth[0][0].distance(smooth[3][1]) < 1e-6);
    }

    #[test]
    fn faces_without_area_and_great_fans_are_survived() {
        let positions = [Vec3::ZERO, Vec3::ZERO, Vec3::X, Vec3::Y];
        let normals = smooth_normals(&positions, &[[0, 1, 2], [0, 2, 3]], 1.0);
        assert_eq!(normals, [[Vec3::Z; 3]; 2]);
        let lonely = smooth_normals(&positions, &[[0, 1, 2]], 1.0);
        assert_eq!(lonely, [[Vec3::Y; 3]]);
        // A hundred thousand triangles at one point take no time.
        let cone = procedural::cone(1.0, 1.0, 1024);
        let many: Vec<[u32; 3]> = (0..100_000)
            .map(|i| [0, 1 + i % 900, 2 + i % 900])
            .collect();
        smooth_normals(&cone.positions, &many, 1.0);
    }
}
