#![allow(clippy::unwrap_used)]
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

use glam::{Affine3A, Quat, UVec2, Vec2, Vec3};

use super::*;
use crate::Mesh;

fn all_shapes() -> Vec<Mesh> {
    vec![
        plane(Vec2::new(3.0, 2.0), UVec2::new(4, 3)),
        cuboid(Vec3::new(1.0, 2.0, 3.0)),
        uv_sphere(1.5, 32, 16),
        icosphere(1.5, 3),
        cylinder(0.5, 2.0, 24),
        cone(0.5, 2.0, 24),
        torus(1.0, 0.3, 32, 16),
        Arch::default().mesh(),
        Arch {
            joint: 0.0,
            ..Arch::default()
        }
        .mesh(),
        Arch {
            inner_radius: 0.0,
            voussoirs: 4,
            ..Arch::default()
        }
        .mesh(),
        Arch {
            span: 7.0,
            ..Arch::default()
        }
        .mesh(),
        Column::default().mesh(),
        Column {
            flutes: 20,
            taper: 0.7,
            ..Column::default()
        }
        .mesh(),
        Cloth::default().mesh(),
        ArchedWall::default().mesh(),
        ArchedWall {
            height: 5.0,
            segments: 9,
            ..ArchedWall::default()
        }
        .mesh(),
        extrude(&cornice(), 2.0),
        revolve(&cornice(), 24, Vec2::ONE).named("turned cornice"),
    ]
}

/// A fillet, a hollow and a round, all smooth, under a flat band.
fn cornice() -> Profile {
    let round = (0..=12).map(|step| {
        let t = step as f32 / 12.0;
        Vec2::new(0.2 + 0.1 * t + 0.02 * (6.0 * t).sin(), 0.3 * t)
    });
    let mut points: Vec<Vec2> = round.collect();
    let top = points[12];
    points.extend([top, top + 0.1 * Vec2::X, top + Vec2::new(0.1, 0.1)]);
    Profile::new().outline(&points, 0.5)
}

/// The triangles between positions, whatever vertices share them.
fn welded(mesh: &Mesh) -> Vec<[usize; 3]> {
    let mut known: HashMap<[i64; 3], usize> = HashMap::new();
    let weld: Vec<usize> = mesh
        .positions
        .iter()
        .map(|position| {
            let cell = position
                .to_array()
                .map(|x| (f64::from(x) * 1e4).round() as i64);
            let next = known.len();
            *known.entry(cell).or_insert(next)
        })
        .collect();
    mesh.triangles()
        .map(|corners| corners.map(|corner| weld[corner]))
        .collect()
}

/// Vertices − edges + faces, with a check that every edge has two sides that
/// run opposite ways: a closed, consistently turned surface.
fn euler_characteristic(mesh: &Mesh) -> i64 {
    let triangles = welded(mesh);
    let mut directed = HashSet::new();
    let mut vertices = HashSet::new();
    for corners in &triangles {
        for at in 0..3 {
            vertices.insert(corners[at]);
            let fresh = directed.insert((corners[at], corners[(at + 1) % 3]));
            assert!(fresh, "{}: an edge twice in one direction", mesh.name);
        }
    }
    for &(a, b) in &directed {
        assert!(directed.contains(&(b, a)), "{}: an open edge", mesh.name);
    }
    vertices.len() as i64 - directed.len() as i64 / 2 + triangles.len() as i64
}

#[test]
fn every_shape_is_valid_and_its_frames_are_orthonormal() {
    for mesh in all_shapes() {
        mesh.validate().unwrap();
        assert!(mesh.triangle_count() > 0, "{}", mesh.name);
        for (normal, tangent) in mesh.normals.iter().zip(&mesh.tangents) {
            let direction = tangent.truncate();
            assert!(
                (normal.length() - 1.0).abs() < 1e-5,
                "{}: {normal}",
                mesh.name
            );
            assert!(
                (direction.length() - 1.0).abs() < 1e-5,
                "{}: {direction}",
                mesh.name
            );
            assert!(normal.dot(direction).abs() < 1e-5, "{}", mesh.name);
            assert_eq!(
                tangent.w, 1.0,
                "{}: no shape has a mirrored picture",
                mesh.name
            );
        }
    }
}

#[test]
fn normals_agree_with_the_way_the_corners_turn() {
    for mesh in all_shapes() {
        for corners in mesh.triangles() {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner]);
            let face = (b - a).cross(c - a);
            assert!(
                face.length() > 1e-9,
                "{}: a triangle without area",
                mesh.name
            );
            let face = face.normalize();
            for corner in corners {
                let turned = mesh.normals[corner].dot(face);
                assert!(
                    turned > 0.55,
                    "{} at {}: {turned}",
                    mesh.name,
                    mesh.positions[corner]
                );
            }
        }
    }
}

#[test]
fn tangents_agree_with_the_texture_coordinates() {
    for mesh in all_shapes() {
        let mut computed = mesh.clone();
        computed.recompute_tangents();
        assert_eq!(
            computed.vertex_count(),
            mesh.vertex_count(),
            "{}",
            mesh.name
        );
        for vertex in mesh.triangles().flatten() {
            let tangent = computed.tangents[vertex];
            let given = mesh.tangents[vertex];
            assert_eq!(
                given.w, tangent.w,
                "{} at {}",
                mesh.name, mesh.positions[vertex]
            );
            let agree = given.truncate().dot(tangent.truncate());
            assert!(
                agree > 0.7,
                "{} at {}: {agree}",
                mesh.name,
                mesh.positions[vertex]
            );
        }
    }
}

#[test]
fn spheres_converge_to_their_area_and_volume() {
    let radius = 1.5_f32;
    let area = 4.0 * PI * 2.25;
    let volume = 4.0 / 3.0 * PI * 3.375;
    let finer: [fn(u32) -> Mesh; 2] = [
        |level| uv_sphere(1.5, 16 << level, 8 << level),
        |level| icosphere(1.5, 2 + level),
    ];
    for make in finer {
        let errors: Vec<[f64; 2]> = (0..4)
            .map(|level| {
                [
                    1.0 - make(level).area() / area,
                    1.0 - make(level).volume() / volume,
                ]
            })
            .collect();
        for pair in errors.windows(2) {
            for (coarse, fine) in pair[0].into_iter().zip(pair[1]) {
                // Inside the sphere, with an error that falls as the square.
                assert!(
                    fine > 0.0 && (3.7..4.3).contains(&(coarse / fine)),
                    "{errors:?}"
                );
            }
        }
        assert!(errors[3][1] < 2e-3);
    }
    for position in icosphere(radius, 3).positions {
        assert!((position.length() - radius).abs() < 1e-6);
    }
}

#[test]
fn closed_forms_of_the_other_shapes() {
    let near = |found: f64, expected: f64| {
        assert!(
            (found / expected - 1.0).abs() < 1e-5,
            "{found} for {expected}"
        );
    };
    let cube = cuboid(Vec3::new(1.0, 2.0, 3.0));
    near(cube.area(), 22.0);
    near(cube.volume(), 6.0);
    near(plane(Vec2::new(3.0, 2.0), UVec2::new(7, 5)).area(), 6.0);
    // A prism and a pyramid over a regular polygon, exactly.
    let polygon = |n: f64, r: f64| 0.5 * n * r * r * (2.0 * PI / n).sin();
    near(cylinder(0.5, 2.0, 24).volume(), 2.0 * polygon(24.0, 0.5));
    near(cone(0.5, 2.0, 24).volume(), 2.0 / 3.0 * polygon(24.0, 0.5));
    let (fine, tube) = (torus(1.0, 0.3, 512, 256), 0.3);
    assert!((fine.volume() / (2.0 * PI * PI * tube * tube) - 1.0).abs() < 2e-4);
    assert!((fine.area() / (4.0 * PI * PI * tube) - 1.0).abs() < 2e-4);
    // Half a ring of 39 pieces.
    let arch = Arch {
        joint: 0.0,
        ..Arch::default()
    };
    let ring = 0.5 * 39.0 * (PI / 39.0).sin() * (1.35_f64.powi(2) - 1.0);
    near(arch.mesh().volume(), ring * 0.5);
}

#[test]
fn closed_shapes_have_the_right_topology() {
    for (mesh, expected) in [
        (cuboid(Vec3::ONE), 2),
        (uv_sphere(1.0, 12, 7), 2),
        (icosphere(1.0, 0), 2),
        (icosphere(1.0, 3), 2),
        (cylinder(1.0, 1.0, 3), 2),
        (cone(1.0, 1.0, 9), 2),
        (torus(1.0, 0.3, 12, 7), 0),
        (
            Arch {
                joint: 0.0,
                ..Arch::default()
            }
            .mesh(),
            2,
        ),
        (
            Arch {
                joint: 0.0,
                span: 7.0,
                ..Arch::default()
            }
            .mesh(),
            0,
        ),
        (ArchedWall::default().mesh(), 2),
        (
            ArchedWall {
                width: 2.4,
                radius: 1.2,
                ..ArchedWall::default()
            }
            .mesh(),
            2,
        ),
        // Thirteen stones and the mortar behind them.
        (Arch::default().mesh(), 2 * 14),
    ] {
        assert_eq!(euler_characteristic(&mesh), expected, "{}", mesh.name);
    }
}

#[test]
fn outlines_are_smooth_up_to_the_crease_and_drawn_to_their_length() {
    // A quarter of a circle in steps of 10 degrees, then a right angle.
    let quarter = (0..=9).map(|step| Vec2::from_angle((step as f32 * 10.0).to_radians()));
    let mut points: Vec<Vec2> = quarter.collect();
    points.push(Vec2::new(0.0, 2.0));
    let profile = Profile::new().outline(&points, 0.3);
    let mesh = extrude(&profile, 3.0);
    let length = 18.0 * (5.0_f64.to_radians()).sin() + 1.0;
    assert!((f64::from(profile.length()) - length).abs() < 1e-6);
    assert!((mesh.area() - 3.0 * length).abs() < 1e-5);
    // Ten rows for the arc and two for the straight part after its edge.
    assert_eq!(mesh.vertex_count(), 2 * (10 + 2));
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals).skip(2).take(16) {
        let exact = Vec3::new(0.0, position.y, position.z);
        assert!(normal.distance(exact) < 1e-5, "{normal} at {position}");
    }
}

#[test]
fn seams_carry_the_picture_across() {
    for mesh in [
        uv_sphere(1.0, 16, 8),
        icosphere(1.0, 3),
        torus(1.0, 0.3, 16, 8),
        cylinder(1.0, 1.0, 16),
    ] {
        for corners in mesh.triangles() {
            let u = corners.map(|corner| mesh.uvs[corner].x);
            let spread = u.iter().copied().fold(f32::MIN, f32::max)
                - u.iter().copied().fold(f32::MAX, f32::min);
            // An icosphere's triangles beside a pole reach over 72 degrees.
            assert!(
                spread < 1.01 || mesh.name == "torus",
                "{}: {u:?}",
                mesh.name
            );
            assert!(
                spread < 0.3 || mesh.name == "cylinder",
                "{}: {u:?}",
                mesh.name
            );
        }
    }
}

#[test]
fn columns_have_their_size_and_flutes_only_take_away() {
    let smooth = Column::default();
    let fluted = Column {
        flutes: 20,
        segments: 160,
        ..smooth
    };
    let bounds = smooth.mesh().bounds();
    assert!((bounds.center.y - 2.0).abs() < 1e-6 && (bounds.half_extents.y - 2.0).abs() < 1e-6);
    let plain = Column {
        segments: 160,
        ..smooth
    }
    .mesh();
    assert!(fluted.mesh().volume() < plain.volume());
    assert!(fluted.mesh().area() > plain.area());
    for position in fluted.mesh().positions {
        assert!(position.x.hypot(position.z) < 0.28 * 2.0);
    }
}

#[test]
fn wild_arguments_give_harmless_meshes() {
    for wild in [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        -1.0,
        0.0,
        1e-30,
        1e30,
    ] {
        let arch = Arch {
            inner_radius: wild,
            outer_radius: wild,
            depth: wild,
            span: wild,
            joint: wild,
            ..Arch::default()
        };
        let wall = ArchedWall {
            width: wild,
            height: wild,
            depth: wild,
            radius: wild,
            ..ArchedWall::default()
        };
        let column = Column {
            height: wild,
            radius: wild,
            taper: wild,
            flutes: 9,
            ..Column::default()
        };
        let cloth = Cloth {
            width: wild,
            height: wild,
            waves: wild,
            depth: wild,
            sag: wild,
            ..Cloth::default()
        };
        for mesh in [
            plane(Vec2::splat(wild), UVec2::ZERO),
            cuboid(Vec3::splat(wild)),
            uv_sphere(wild, 0, 0),
            icosphere(wild, 1),
            cylinder(wild, wild, 0),
            cone(wild, wild, 0),
            torus(wild, wild, 0, 0),
            arch.mesh(),
            wall.mesh(),
            extrude(&cornice(), wild),
            column.mesh(),
            cloth.mesh(),
        ] {
            mesh.validate().unwrap();
        }
    }
    let most = plane(Vec2::ONE, UVec2::MAX).vertex_count();
    assert_eq!(most, 1025 * 1025);
}

#[test]
fn appending_keeps_fronts_in_front() {
    let sphere = uv_sphere(1.0, 24, 12);
    let squash = Affine3A::from_scale_rotation_translation(
        Vec3::new(-2.0, 0.5, 1.0),
        Quat::from_rotation_y(0.7),
        Vec3::new(1.0, 2.0, 3.0),
    );
    let mut both = cuboid(Vec3::ONE);
    let (before, triangles) = (both.vertex_count(), both.triangle_count());
    both.append(&sphere, squash);
    both.validate().unwrap();
    assert!((both.volume() - 1.0 - sphere.volume()).abs() < 1e-5);
    for corners in both.triangles().skip(triangles) {
        let [a, b, c] = corners.map(|corner| both.positions[corner]);
        let face = (b - a).cross(c - a).normalize();
        assert!(
            corners
                .iter()
                .all(|&corner| both.normals[corner].dot(face) > 0.7)
        );
    }
    // The picture on the mirrored part is mirrored, and the frames say so.
    let given = both.tangents.clone();
    both.recompute_tangents();
    assert!(given[before..].iter().all(|tangent| tangent.w == -1.0));
    assert!(
        both.tangents[before..]
            .iter()
            .all(|tangent| tangent.w == -1.0)
    );
}
