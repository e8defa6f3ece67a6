//! Spheres.

use std::collections::HashMap;
use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::{Profile, count, length, revolve};
use crate::Mesh;

/// A sphere around the origin from rings of quads. `segments` (3 to 1024) go
/// around, `rings` (2 to 1024) from pole to pole. Texture coordinates 0 to 1,
/// longitude and latitude.
#[must_use]
pub fn uv_sphere(radius: f32, segments: u32, rings: u32) -> Mesh {
    let radius = length(radius);
    let rings = count(rings, 2);
    let mut meridian = Profile::new().arc(Vec2::ZERO, radius, -PI / 2.0, PI / 2.0, rings);
    // The cosine of a rounded right angle is not quite 0, and a pole is a point.
    for part in &mut meridian.parts {
        let last = part.len() - 1;
        for (end, side) in [(0, -1.0), (last, 1.0)] {
            part[end].at = Vec2::new(0.0, side * radius);
            part[end].normal = Vec2::new(0.0, side);
        }
    }
    revolve(&meridian, segments, Vec2::ONE).named("sphere")
}

/// A sphere around the origin whose triangles are all nearly equal: an
/// icosahedron whose faces are cut in four `subdivisions` times (0 to 7).
/// Texture coordinates 0 to 1, longitude and latitude.
#[must_use]
pub fn icosphere(radius: f32, subdivisions: u32) -> Mesh {
    let (mut directions, mut triangles) = icosahedron();
    for _ in 0..subdivisions.min(7) {
        triangles = subdivided(&mut directions, &triangles);
    }
    let radius = length(radius);
    let mut mesh = Mesh {
        name: "icosphere".to_owned(),
        positions: directions
            .iter()
            .map(|&direction| direction * radius)
            .collect(),
        uvs: directions
            .iter()
            .map(|&direction| longitude_latitude(direction))
            .collect(),
        normals: directions,
        tangents: Vec::new(),
        indices: triangles.concat(),
    };
    mend_seam(&mut mesh);
    mesh.recompute_tangents();
    mesh
}

fn icosahedron() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    // Poles on the axis, two rings of five at latitude atan(1/2).
    let mut directions = vec![Vec3::NEG_Y];
    let latitude = 0.5_f32.atan();
    for (height, offset) in [(-latitude, 0.0), (latitude, 0.5)] {
        for step in 0..5 {
            let (sin, cos) = ((step as f32 + offset) * TAU / 5.0).sin_cos();
            let direction = Vec3::new(cos * height.cos(), height.sin(), -sin * height.cos());
            directions.push(direction.normalize());
        }
    }
    directions.push(Vec3::Y);
    let triangles = (0..5).flat_map(|step| {
        let next = (step + 1) % 5;
        let (low, low_next, high, high_next) = (1 + step, 1 + next, 6 + step, 6 + next);
        [
            [0, low_next, low],
            [low, low_next, high],
            [high, low_next, high_next],
            [high, high_next, 11],
        ]
    });
    (directions, triangles.collect())
}

/// Cuts every triangle in four at the middles of its edges, which are pushed
/// out to the sphere.
fn subdivided(directions: &mut Vec<Vec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles: HashMap<(u32, u32), u32> = HashMap::with_capacity(triangles.len() * 3 / 2);
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let between = directions[a as usize] + directions[b as usize];
            directions.push(between.normalize());
            directions.len() as u32 - 1
        })
    };
    let mut finer = Vec::with_capacity(triangles.len() * 4);
    for &[a, b, c] in triangles {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    finer
}

fn longitude_latitude(direction: Vec3) -> Vec2 {
    let turn = (-direction.z).atan2(direction.x) / TAU;
    Vec2::new(
        turn.rem_euclid(1.0),
        direction.y.clamp(-1.0, 1.0).acos() / PI,
    )
}

/// Doubles the vertices where the picture's edge crosses a triangle, and gives
/// every triangle at a pole its own longitude there.
fn mend_seam(mesh: &mut Mesh) {
    let mut beyond: HashMap<u32, u32> = HashMap::new();
    for first in (0..mesh.indices.len()).step_by(3) {
        let corners = [0, 1, 2].map(|at| mesh.indices[first + at]);
        let is_pole = corners.map(|corner| mesh.normals[corner as usize].y.abs() > 0.999_999);
        let mut u = corners.map(|corner| mesh.uvs[corner as usize].x);
        let others = |at: usize| (0..3).filter(move |&other| other != at && !is_pole[other]);
        let highest = (0..3)
            .filter(|&at| !is_pole[at])
            .map(|at| u[at])
            .fold(0.0, f32::max);
        for at in (0..3).filter(|&at| !is_pole[at]) {
            if highest - u[at] > 0.5 {
                u[at] += 1.0;
                let copy = beyond.entry(corners[at]);
                let copy = copy.or_insert_with(|| copy_with_u(mesh, corners[at], u[at]));
                mesh.indices[first + at] = *copy;
            }
        }
        for at in (0..3).filter(|&at| is_pole[at]) {
            let middle = others(at).map(|other| u[other]).sum::<f32>() / 2.0;
            mesh.indices[first + at] = copy_with_u(mesh, corners[at], middle);
        }
    }
}

fn copy_with_u(mesh: &mut Mesh, vertex: u32, u: f32) -> u32 {
    let vertex = vertex as usize;
    mesh.positions.push(mesh.positions[vertex]);
    mesh.normals.push(mesh.normals[vertex]);
    mesh.uvs.push(Vec2::new(u, mesh.uvs[vertex].y));
    mesh.positions.len() as u32 - 1
}
