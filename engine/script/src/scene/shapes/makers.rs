//! The functions that make shapes.

use lightbench_assets::procedural::{Arch, ArchedWall, Cloth, Column};
use lightbench_world::glam::{DVec3, UVec2, Vec2, Vec3};

use super::super::faces;
use super::{Kind, MAX_LENGTH, Shape, length};
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api) {
    flat(api);
    corners(api);
    round(api);
    building(api);
}

fn flat(api: &mut Api) {
    api.function(
        "plane(width, depth)",
        "A horizontal rectangle around the origin, facing up.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Plane {
                    size: Vec2::new(length(a, 0)?, length(a, 1)?),
                    cells: UVec2::ONE,
                },
            ))
        },
    );
    for form in ["box(width, height, depth)", "box(size)"] {
        api.function(form, "A box around the origin.", |a| {
            let size = match a.len() {
                3 => Vec3::new(length(a, 0)?, length(a, 1)?, length(a, 2)?),
                _ => match a.try_object::<DVec3>(0) {
                    Some(size) => size.as_vec3(),
                    None => Vec3::splat(length(a, 0)?),
                },
            };
            Ok(Shape::new(a, Kind::Box { size }))
        });
    }
}

fn corners(api: &mut Api) {
    api.function(
        "faces(corners)",
        "A mesh of flat convex faces: an array of faces, each an array of its corners, \
         counter-clockwise as seen from its front.",
        |a| {
            let corners = faces::read(a)?;
            Ok(Shape::new(a, Kind::Faces { corners }))
        },
    );
}

fn round(api: &mut Api) {
    api.function(
        "sphere(radius)",
        "A sphere around the origin, of rings.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Sphere {
                    radius: length(a, 0)?,
                    segments: 32,
                    rings: 16,
                },
            ))
        },
    );
    api.function(
        "icosphere(radius)",
        "A sphere around the origin whose triangles are nearly equal.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Icosphere {
                    radius: length(a, 0)?,
                    subdivisions: 3,
                },
            ))
        },
    );
    api.function(
        "cylinder(radius, height)",
        "An upright closed cylinder around the origin.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Cylinder {
                    radius: length(a, 0)?,
                    height: length(a, 1)?,
                    segments: 32,
                },
            ))
        },
    );
    api.function(
        "cone(radius, height)",
        "An upright closed cone around the origin, its tip above.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Cone {
                    radius: length(a, 0)?,
                    height: length(a, 1)?,
                    segments: 32,
                },
            ))
        },
    );
    api.function(
        "torus(radius, tube)",
        "A ring around the y axis: its radius to the middle of the tube, and the tube's own.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Torus {
                    radius: length(a, 0)?,
                    tube: length(a, 1)?,
                    segments: 48,
                    sides: 16,
                },
            ))
        },
    );
    api.function(
        "lathe(points)",
        "A shape turned around the y axis from its outline: an array of [radius, height] from \
         bottom to top. Smooth where the outline bends by less than 40 degrees.",
        |a| {
            let points = outline(a, 0)?;
            Ok(Shape::new(
                a,
                Kind::Lathe {
                    points,
                    segments: 32,
                },
            ))
        },
    );
}

/// The points of an outline, each [distance, height].
fn outline(a: &Arguments, index: usize) -> Result<Vec<Vec2>, Mistake> {
    let mut points = Vec::new();
    for point in a.array(index)? {
        let pair = point.into_array().unwrap_or_default();
        let numbers: Vec<f64> = pair.iter().filter_map(crate::api::as_number).collect();
        match numbers.as_slice() {
            [out, height] if *out >= 0.0 && out.max(height.abs()) <= MAX_LENGTH => {
                points.push(Vec2::new(*out as f32, *height as f32));
            }
            _ => return Err(a.wrong(index, "an array of [distance, height] pairs")),
        }
    }
    if !(2..=4096).contains(&points.len()) {
        return Err(Mistake::new("an outline needs 2 to 4096 points"));
    }
    Ok(points)
}

fn building(api: &mut Api) {
    api.function(
        "arched_wall(width, height, depth, radius)",
        "A piece of wall on the line y = 0, along x, with a round opening in its foot: the wall \
         around an arch. The height is at least the radius, the width twice as much.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::ArchedWall(ArchedWall {
                    width: length(a, 0)?,
                    height: length(a, 1)?,
                    depth: length(a, 2)?,
                    radius: length(a, 3)?,
                    ..ArchedWall::default()
                }),
            ))
        },
    );
    api.function(
        "moulding(points, length)",
        "A band along a wall, along x, from its outline: an array of [distance from the wall, \
         height] from bottom to top. It stands out towards +z, and is open behind and at its ends.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Moulding {
                    points: outline(a, 0)?,
                    length: length(a, 1)?,
                },
            ))
        },
    );
    api.function(
        "column(radius, height)",
        "A column on the ground, after the Tuscan order, with base, shaft and capital.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Column(Column {
                    radius: length(a, 0)?,
                    height: length(a, 1)?,
                    ..Column::default()
                }),
            ))
        },
    );
    api.function(
        "arch(inner, outer, depth)",
        "A round arch of wedges on the line y = 0: its inner and outer radius and the thickness \
         of its wall.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Arch(Arch {
                    inner_radius: length(a, 0)?,
                    outer_radius: length(a, 1)?,
                    depth: length(a, 2)?,
                    ..Arch::default()
                }),
            ))
        },
    );
    api.function(
        "cloth(width, height)",
        "A cloth that hangs down from the line y = 0. Draw it with a two-sided material.",
        |a| {
            Ok(Shape::new(
                a,
                Kind::Cloth(Cloth {
                    width: length(a, 0)?,
                    height: length(a, 1)?,
                    ..Cloth::default()
                }),
            ))
        },
    );
}
