//! Where entities are and how large they are, before any system has run.

use lightbench_assets::Assets;
use lightbench_world::glam::{Affine3A, Vec3};
use lightbench_world::{Entity, MeshRenderer, Transform, World};

use super::data::Stage;
use super::entities::getter;
use crate::api::{Api, Mistake};

/// A box along the world's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

impl Extent {
    pub(super) fn center(&self) -> Vec3 {
        (self.low + self.high) * 0.5
    }

    /// Radius of the sphere around the box.
    pub(super) fn radius(&self) -> f32 {
        (self.high - self.low).length() * 0.5
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}

/// From an entity's own space to the world's.
pub(super) fn world_matrix(world: &World, entity: Entity) -> Affine3A {
    let own = |entity| world.get::<Transform>(entity).unwrap_or_default().matrix();
    let mut matrix = own(entity);
    let mut above = world.parent(entity);
    while let Some(parent) = above {
        matrix = own(parent) * matrix;
        above = world.parent(parent);
    }
    matrix
}

/// Around the meshes of an entity and of everything below it.
pub(super) fn extent(world: &World, assets: &Assets, entity: Entity) -> Option<Extent> {
    let mut below = world.descendants(entity);
    below.push(entity);
    below
        .into_iter()
        .filter_map(|entity| own_extent(world, assets, entity))
        .reduce(Extent::union)
}

/// Around all meshes.
pub(super) fn extent_of_all(world: &World, assets: &Assets) -> Option<Extent> {
    world
        .columns::<MeshRenderer>()
        .entities()
        .iter()
        .filter_map(|&entity| own_extent(world, assets, entity))
        .reduce(Extent::union)
}

fn own_extent(world: &World, assets: &Assets, entity: Entity) -> Option<Extent> {
    let renderer: MeshRenderer = world.get(entity)?;
    let bounds = assets.mesh_bounds().get(renderer.mesh.0 as usize)?;
    let matrix = world_matrix(world, entity);
    let center = matrix.transform_point3(bounds.center);
    // Arvo, "Transforming axis-aligned bounding boxes", Graphics Gems, 1990.
    let half: Vec3 = (matrix.matrix3.x_axis.abs() * bounds.half_extents.x
        + matrix.matrix3.y_axis.abs() * bounds.half_extents.y
        + matrix.matrix3.z_axis.abs() * bounds.half_extents.z)
        .into();
    Some(Extent {
        low: center - half,
        high: center + half,
    })
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    let mut corner = |name: &str, about, pick: fn(Extent) -> Vec3| {
        getter(api, stage, name, about, move |data, entity| {
            data.check(entity)?;
            match extent(&data.world, &data.assets, entity) {
                Some(extent) => Ok(pick(extent).as_dvec3()),
                None => Err(Mistake::new(format!(
                    "{} has no mesh, and so no extent",
                    data.called(entity)
                ))),
            }
        });
    };
    corner(
        "low",
        "The lower corner of the box around its meshes and those below it, in the world.",
        |extent| extent.low,
    );
    corner(
        "high",
        "The upper corner of the box around its meshes and those below it, in the world.",
        |extent| extent.high,
    );
    corner(
        "center",
        "The centre of the box around its meshes and those below it, in the world.",
        |extent| extent.center(),
    );
}
