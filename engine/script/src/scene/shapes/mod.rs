//! Shapes, and the meshes made of them.

mod makers;
mod setters;

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::procedural::{self, Arch, ArchedWall, Cloth, Column, MAX_SEGMENTS, Profile};
use lightbench_assets::{Mesh, MeshId, Shared};
use lightbench_world::glam::{UVec2, Vec2, Vec3};
use rhai::Dynamic;

use super::data::{Data, Stage};
use super::faces::{self, Corners};
use super::recipes::MeshRecipe;
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
        corners: Corners,
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
    /// The calls that made it, for files.
    recipe: Option<MeshRecipe>,
}

impl ScriptType for Shape {
    const NAME: &'static str = "shape";
}

impl Shape {
    /// A shape that a call makes.
    fn new(call: &Arguments, kind: Kind) -> Self {
        let recipe = match &kind {
            Kind::Faces { corners } => Some(MeshRecipe::Faces(corners.clone(), String::new())),
            _ => call.spelled().map(MeshRecipe::Calls),
        };
        Self(Arc::new(Mutex::new(Plan {
            kind,
            repeat: Vec2::ONE,
            mesh: None,
            recipe,
        })))
    }

    fn lock(&self) -> MutexGuard<'_, Plan> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A mesh that the same calls have made, the first of several.
    pub(super) fn known_mesh(&self, data: &Data) -> Option<MeshId> {
        let plan = self.lock();
        let Some(MeshRecipe::Calls(calls)) = &plan.recipe else {
            return None;
        };
        let recipes = data.recipes.meshes.iter();
        let same = recipes
            .filter(|(_, recipe)| matches!(recipe, MeshRecipe::Calls(known) if known == calls));
        same.map(|(id, _)| *id).min()
    }

    /// The mesh of the shape.
    pub(super) fn mesh(&self, data: &mut Data) -> Result<MeshId, Mistake> {
        let mut plan = self.lock();
        if let Some(mesh) = plan.mesh {
            return Ok(mesh);
        }
        let watch = Arc::clone(&data.watch);
        let mesh = watch.free_of_charge(|| {
            let made_of = (&plan.kind, plan.repeat);
            data.reuse
                .get("shape", &made_of, || Shared::shared(plan.build()))
        });
        let mesh = data.add_mesh(mesh)?;
        plan.mesh = Some(mesh);
        if let Some(recipe) = &plan.recipe {
            data.recipes.meshes.insert(mesh, recipe.clone());
        }
        Ok(mesh)
    }
}

impl Plan {
    fn build(&self) -> Mesh {
        let mut mesh = self.kind.build();
        if self.repeat != Vec2::ONE {
            mesh.uvs.iter_mut().for_each(|uv| *uv *= self.repeat);
        }
        mesh
    }

    /// Follows a call that changed the shape: what was drawn with it keeps its mesh, and what
    /// comes gets a new one.
    fn changed(&mut self, call: &Arguments) {
        self.mesh = None;
        self.recipe = self.recipe.take().and_then(|recipe| recipe.then(call));
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
    mesh_of(data, a.value(index))
        .unwrap_or_else(|| Err(a.wrong(index, "a mesh or a shape, as in `sphere(1)`")))
}

/// The mesh that a value is, or that is made of it; `None` for other values.
pub(super) fn mesh_of(data: &mut Data, value: &Dynamic) -> Option<Result<MeshId, Mistake>> {
    if let Some(mesh) = value.read_lock::<MeshHandle>() {
        return Some(Ok(mesh.0));
    }
    let shape = value.read_lock::<Shape>()?;
    Some(shape.mesh(data))
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
    makers::register(api);
    setters::register(api);
}
