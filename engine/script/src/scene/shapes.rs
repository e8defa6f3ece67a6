//! Shapes with their setters, and the meshes made of them.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::procedural::{self, Arch, ArchedWall, Cloth, Column, MAX_SEGMENTS, Profile};
use lightbench_assets::{Mesh, MeshId};
use lightbench_world::glam::{DVec3, UVec2, Vec2, Vec3};

use super::data::{Data, Stage};
use super::faces;
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// The most that a length of a shape may be, in metres.
const MAX_LENGTH: f64 = 1e6;

/// Where an outline bends by less than this (40 degrees), its shape is smooth.
const CREASE: f32 = 0.698;

/// A shape and its numbers.
#[derive(Clone, Debug)]
enum Kind {
    Plane {
        size: Vec2,
        cells: UVec2,
    },
    Box {
        size: Vec3,
    },
    Sphere {
        radius: f32,
        segments: u32,
        rings: u32,
    },
    Icosphere {
        radius: f32,
        subdivisions: u32,
    },
    Cylinder {
        radius: f32,
        height: f32,
        segments: u32,
    },
    Cone {
        radius: f32,
        height: f32,
        segments: u32,
    },
    Torus {
        radius: f32,
        tube: f32,
        segments: u32,
        sides: u32,
    },
    Lathe {
        points: Vec<Vec2>,
        segments: u32,
    },
    Moulding {
        points: Vec<Vec2>,
        length: f32,
    },
    Faces {
        corners: Vec<Vec<Vec3>>,
    },
    Arch(Arch),
    ArchedWall(ArchedWall),
    Column(Column),
    Cloth(Cloth),
}

impl Kind {
    fn name(&self) -> &'static str {
        match self {
            Self::Plane { .. } => "plane",
            Self::Box { .. } => "box",
            Self::Sphere { .. } => "sphere",
            Self::Icosphere { .. } => "icosphere",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Torus { .. } => "torus",
            Self::Lathe { .. } => "lathe",
            Self::Moulding { .. } => "moulding",
            Self::Faces { .. } => "faces",
            Self::Arch(_) => "arch",
            Self::ArchedWall(_) => "arched_wall",
            Self::Column(_) => "column",
            Self::Cloth(_) => "cloth",
        }
    }

    fn build(&self) -> Mesh {
        match self {
            Self::Plane { size, cells } => procedural::plane(*size, *cells),
            Self::Box { size } => procedural::cuboid(*size),
            Self::Sphere {
                radius,
                segments,
                rings,
            } => procedural::uv_sphere(*radius, *segments, *rings),
            Self::Icosphere {
                radius,
                subdivisions,
            } => procedural::icosphere(*radius, *subdivisions),
            Self::Cylinder {
                radius,
                height,
                segments,
            } => procedural::cylinder(*radius, *height, *segments),
            Self::Cone {
                radius,
                height,
                segments,
            } => procedural::cone(*radius, *height, *segments),
            Self::Torus {
                radius,
                tube,
                segments,
                sides,
            } => procedural::torus(*radius, *tube, *segments, *sides),
            Self::Lathe { points, segments } => {
                let profile = Profile::new().outline(points, CREASE);
                procedural::revolve(&profile, *segments, Vec2::ONE).named("lathe")
            }
            Self::Moulding { points, length } => {
                procedural::extrude(&Profile::new().outline(points, CREASE), *length)
            }
            Self::Faces { corners } => faces::mesh(corners),
            Self::Arch(arch) => arch.mesh(),
            Self::ArchedWall(wall) => wall.mesh(),
            Self::Column(column) => column.mesh(),
            Self::Cloth(cloth) => cloth.mesh(),
        }
    }
}

/// A shape, as scripts hold it: numbers first, a mesh as soon as something is drawn with it.
#[derive(Clone, Debug)]
pub(super) struct Shape(Arc<Mutex<Plan>>);

#[derive(Debug)]
struct Plan {
    kind: Kind,
    /// How often a picture is repeated where it would be seen once.
    repeat: Vec2,
    /// Made at the first use, and shared by all entities that use the shape.
    mesh: Option<MeshId>,
}

impl ScriptType for Shape {
    const NAME: &'static str = "shape";
}

impl Shape {
    fn new(kind: Kind) -> Self {
        Self(Arc::new(Mutex::new(Plan {
            kind,
            repeat: Vec2::ONE,
            mesh: None,
        })))
    }

    fn lock(&self) -> MutexGuard<'_, Plan> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The mesh of the shape.
    fn mesh(&self, data: &mut Data) -> Result<MeshId, Mistake> {
        let mut plan = self.lock();
        if let Some(mesh) = plan.mesh {
            return Ok(mesh);
        }
        let watch = Arc::clone(&data.watch);
        let mesh = watch.free_of_charge(|| {
            let mut mesh = plan.kind.build();
            if plan.repeat != Vec2::ONE {
                mesh.uvs.iter_mut().for_each(|uv| *uv *= plan.repeat);
            }
            mesh
        });
        let mesh = data.add_mesh(mesh)?;
        plan.mesh = Some(mesh);
        Ok(mesh)
    }
}

/// A mesh, as scripts hold it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MeshHandle(pub(super) MeshId);

impl ScriptType for MeshHandle {
    const NAME: &'static str = "mesh";
}

/// A mesh, or the mesh of a shape, from an argument.
pub(super) fn mesh_argument(
    data: &mut Data,
    a: &Arguments,
    index: usize,
) -> Result<MeshId, Mistake> {
    if let Some(mesh) = a.try_object::<MeshHandle>(index) {
        return Ok(mesh.0);
    }
    match a.try_object::<Shape>(index) {
        Some(shape) => shape.mesh(data),
        None => Err(a.wrong(index, "a mesh or a shape, as in `sphere(1)`")),
    }
}

fn length(a: &Arguments, index: usize) -> Result<f32, Mistake> {
    a.number_in(index, 0.0, MAX_LENGTH)
        .map(|metres| metres as f32)
}

fn count(a: &Arguments, index: usize, least: i64) -> Result<u32, Mistake> {
    a.whole(index, least, i64::from(MAX_SEGMENTS))
        .map(|count| count as u32)
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.object::<Shape>();
    api.object::<MeshHandle>();
    let made = stage.clone();
    api.function(
        "mesh(shape)",
        "Makes the mesh of a shape. Entities take the shape itself too.",
        move |a| {
            let shape: Shape = a.object(0)?;
            shape.mesh(&mut made.lock()).map(MeshHandle)
        },
    );
    let counted = stage.clone();
    api.getter(
        "triangles",
        "How many triangles it has.",
        move |mesh: MeshHandle, _| {
            let data = counted.lock();
            let count = data
                .assets
                .mesh(mesh.0)
                .map_or(0, |mesh| mesh.triangle_count());
            Ok(count as i64)
        },
    );
    flat(api);
    corners(api);
    round(api);
    building(api);
    setters(api);
}

fn flat(api: &mut Api) {
    api.function(
        "plane(width, depth)",
        "A horizontal rectangle around the origin, facing up.",
        |a| {
            Ok(Shape::new(Kind::Plane {
                size: Vec2::new(length(a, 0)?, length(a, 1)?),
                cells: UVec2::ONE,
            }))
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
            Ok(Shape::new(Kind::Box { size }))
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
            Ok(Shape::new(Kind::Faces { corners }))
        },
    );
}

fn round(api: &mut Api) {
    api.function(
        "sphere(radius)",
        "A sphere around the origin, of rings.",
        |a| {
            Ok(Shape::new(Kind::Sphere {
                radius: length(a, 0)?,
                segments: 32,
                rings: 16,
            }))
        },
    );
    api.function(
        "icosphere(radius)",
        "A sphere around the origin whose triangles are nearly equal.",
        |a| {
            Ok(Shape::new(Kind::Icosphere {
                radius: length(a, 0)?,
                subdivisions: 3,
            }))
        },
    );
    api.function(
        "cylinder(radius, height)",
        "An upright closed cylinder around the origin.",
        |a| {
            Ok(Shape::new(Kind::Cylinder {
                radius: length(a, 0)?,
                height: length(a, 1)?,
                segments: 32,
            }))
        },
    );
    api.function(
        "cone(radius, height)",
        "An upright closed cone around the origin, its tip above.",
        |a| {
            Ok(Shape::new(Kind::Cone {
                radius: length(a, 0)?,
                height: length(a, 1)?,
                segments: 32,
            }))
        },
    );
    api.function(
        "torus(radius, tube)",
        "A ring around the y axis: its radius to the middle of the tube, and the tube's own.",
        |a| {
            Ok(Shape::new(Kind::Torus {
                radius: length(a, 0)?,
                tube: length(a, 1)?,
                segments: 48,
                sides: 16,
            }))
        },
    );
    api.function(
        "lathe(points)",
        "A shape turned around the y axis from its outline: an array of [radius, height] from \
         bottom to top. Smooth where the outline bends by less than 40 degrees.",
        |a| {
            let points = outline(a, 0)?;
            Ok(Shape::new(Kind::Lathe {
                points,
                segments: 32,
            }))
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
            Ok(Shape::new(Kind::ArchedWall(ArchedWall {
                width: length(a, 0)?,
                height: length(a, 1)?,
                depth: length(a, 2)?,
                radius: length(a, 3)?,
                ..ArchedWall::default()
            })))
        },
    );
    api.function(
        "moulding(points, length)",
        "A band along a wall, along x, from its outline: an array of [distance from the wall, \
         height] from bottom to top. It stands out towards +z, and is open behind and at its ends.",
        |a| {
            Ok(Shape::new(Kind::Moulding {
                points: outline(a, 0)?,
                length: length(a, 1)?,
            }))
        },
    );
    api.function(
        "column(radius, height)",
        "A column on the ground, after the Tuscan order, with base, shaft and capital.",
        |a| {
            Ok(Shape::new(Kind::Column(Column {
                radius: length(a, 0)?,
                height: length(a, 1)?,
                ..Column::default()
            })))
        },
    );
    api.function(
        "arch(inner, outer, depth)",
        "A round arch of wedges on the line y = 0: its inner and outer radius and the thickness \
         of its wall.",
        |a| {
            Ok(Shape::new(Kind::Arch(Arch {
                inner_radius: length(a, 0)?,
                outer_radius: length(a, 1)?,
                depth: length(a, 2)?,
                ..Arch::default()
            })))
        },
    );
    api.function(
        "cloth(width, height)",
        "A cloth that hangs down from the line y = 0. Draw it with a two-sided material.",
        |a| {
            Ok(Shape::new(Kind::Cloth(Cloth {
                width: length(a, 0)?,
                height: length(a, 1)?,
                ..Cloth::default()
            })))
        },
    );
}

/// Registers a setter of some kinds of shape. `change` says whether the kind has it.
fn setter(
    api: &mut Api,
    form: &'static str,
    about: &'static str,
    change: impl Fn(&mut Kind, &Arguments) -> Result<bool, Mistake> + Send + Sync + 'static,
) {
    let name = form.split('(').next().unwrap_or(form);
    api.method(form, about, move |shape: Shape, a| {
        let mut plan = shape.lock();
        if !change(&mut plan.kind, a)? {
            return Err(Mistake::new(format!(
                "the shape `{}` has no `{name}`",
                plan.kind.name()
            )));
        }
        // What was drawn with the shape keeps its mesh; what comes gets a new one.
        plan.mesh = None;
        drop(plan);
        Ok(shape)
    });
}

fn setters(api: &mut Api) {
    api.method(
        "repeat(across, up)",
        "How often a texture repeats where it would be seen once: on flat and built shapes, in \
         each metre; on round ones and cloths, on the whole. Numbers below 1 stretch it.",
        |shape: Shape, a| {
            let times = [a.number_in(0, 1e-6, 1e6)?, a.number_in(1, 1e-6, 1e6)?];
            let mut plan = shape.lock();
            plan.repeat = Vec2::from(times.map(|times| times as f32));
            plan.mesh = None;
            drop(plan);
            Ok(shape)
        },
    );
    setter(
        api,
        "segments(around)",
        "Pieces around the axis, or along each wedge of an arch, to 1024.",
        |kind, a| {
            let value = count(a, 0, 1)?;
            match kind {
                Kind::Sphere { segments, .. }
                | Kind::Cylinder { segments, .. }
                | Kind::Cone { segments, .. }
                | Kind::Torus { segments, .. }
                | Kind::Lathe { segments, .. } => *segments = value,
                Kind::Column(column) => column.segments = value,
                Kind::Arch(arch) => arch.segments = value,
                Kind::ArchedWall(wall) => wall.segments = value,
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "segments(first, second)",
        "Pieces in both directions, to 1024: around and from pole to pole of a sphere, around and \
         along of a column, around the axis and around the tube of a torus, along the sides of a \
         plane or a cloth.",
        |kind, a| {
            let (first, second) = (count(a, 0, 1)?, count(a, 1, 1)?);
            match kind {
                Kind::Plane { cells, .. } => *cells = UVec2::new(first, second),
                Kind::Sphere {
                    segments, rings, ..
                } => (*segments, *rings) = (first, second),
                Kind::Torus {
                    segments, sides, ..
                } => (*segments, *sides) = (first, second),
                Kind::Column(column) => (column.segments, column.rings) = (first, second),
                Kind::Cloth(cloth) => cloth.segments = [first, second],
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "subdivisions(times)",
        "How often each triangle of an icosphere is cut in four, 0 to 7.",
        |kind, a| {
            let times = a.whole(0, 0, 7)? as u32;
            let Kind::Icosphere { subdivisions, .. } = kind else {
                return Ok(false);
            };
            *subdivisions = times;
            Ok(true)
        },
    );
    setter(
        api,
        "span(degrees)",
        "The angle that an arch spans, 1 to 360.",
        |kind, a| {
            let angle = a.number_in(0, 1.0, 360.0)?.to_radians() as f32;
            let Kind::Arch(arch) = kind else {
                return Ok(false);
            };
            arch.span = angle;
            Ok(true)
        },
    );
    setter(
        api,
        "voussoirs(count)",
        "The wedges of an arch; odd for a keystone.",
        |kind, a| {
            let wedges = count(a, 0, 1)?;
            let Kind::Arch(arch) = kind else {
                return Ok(false);
            };
            arch.voussoirs = wedges;
            Ok(true)
        },
    );
    setter(
        api,
        "joint(metres)",
        "The joints between the wedges of an arch; 0 for none.",
        |kind, a| {
            let joint = length(a, 0)?;
            let Kind::Arch(arch) = kind else {
                return Ok(false);
            };
            arch.joint = joint;
            Ok(true)
        },
    );
    setter(
        api,
        "taper(share)",
        "The upper radius of a column as a share of the lower one, 0.1 to 1.",
        |kind, a| {
            let share = a.number_in(0, 0.1, 1.0)? as f32;
            let Kind::Column(column) = kind else {
                return Ok(false);
            };
            column.taper = share;
            Ok(true)
        },
    );
    setter(
        api,
        "flutes(count)",
        "The flutes of a column, 0 to 64; Doric 20.",
        |kind, a| {
            let flutes = a.whole(0, 0, 64)? as u32;
            let Kind::Column(column) = kind else {
                return Ok(false);
            };
            column.flutes = flutes;
            Ok(true)
        },
    );
    setter(
        api,
        "waves(count, depth)",
        "Waves across a cloth, and how deep they are at its lower edge, in metres.",
        |kind, a| {
            let (waves, depth) = (a.number_in(0, 0.0, 1000.0)? as f32, length(a, 1)?);
            let Kind::Cloth(cloth) = kind else {
                return Ok(false);
            };
            (cloth.waves, cloth.depth) = (waves, depth);
            Ok(true)
        },
    );
    setter(
        api,
        "sag(metres)",
        "How far the middle of a cloth's lower edge hangs below its ends.",
        |kind, a| {
            let sag = length(a, 0)?;
            let Kind::Cloth(cloth) = kind else {
                return Ok(false);
            };
            cloth.sag = sag;
            Ok(true)
        },
    );
    setter(
        api,
        "seed(number)",
        "Makes each cloth wave in its own way.",
        |kind, a| {
            let seed = a.whole(0, 0, i64::from(u32::MAX))? as u32;
            let Kind::Cloth(cloth) = kind else {
                return Ok(false);
            };
            cloth.seed = seed;
            Ok(true)
        },
    );
}
