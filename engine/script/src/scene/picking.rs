//! What a line of sight meets first.

use lightbench_assets::Assets;
use lightbench_world::glam::{Affine3A, DVec3, Vec3};
use lightbench_world::{Entity, MeshRenderer, World, WorldBounds, WorldMatrix};
use rhai::{Dynamic, Map};

use super::data::Stage;
use crate::api::{Api, Mistake};

/// A line from a point in a direction, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins, in metres.
    pub origin: Vec3,
    /// Where it goes. Need not have unit length.
    pub direction: Vec3,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The entity whose mesh it is.
    pub entity: Entity,
    /// In the world, in metres.
    pub point: DVec3,
    /// From the ray's origin, in metres.
    pub distance: f64,
}

/// The first visible triangle that a ray meets, whichever side it shows. Places are those of the last
/// step.
pub(super) fn pick(
    world: &World,
    assets: &Assets,
    ray: Ray,
    counts: impl Fn(Entity) -> bool,
) -> Option<Hit> {
    let direction = ray.direction.try_normalize()?;
    let renderers = world.columns::<MeshRenderer>();
    let rows = renderers.slices();
    let mut nearest: Option<(f32, Entity)> = None;
    for (row, &entity) in renderers.entities().iter().enumerate() {
        let farthest = nearest.map_or(f32::INFINITY, |(distance, _)| distance);
        if !rows.visible[row] || !meets_bounds(world, entity, ray.origin, direction, farthest) {
            continue;
        }
        if !counts(entity) {
            continue;
        }
        let Some(mesh) = assets.mesh(rows.mesh[row]) else {
            continue;
        };
        let Some(matrix) = world.get::<WorldMatrix>(entity) else {
            continue;
        };
        let to_mesh = matrix.matrix.inverse();
        let meets = meet_mesh(
            &mesh.positions,
            &mesh.indices,
            to_mesh,
            ray.origin,
            direction,
        );
        if let Some(distance) = meets.filter(|distance| *distance < farthest) {
            nearest = Some((distance, entity));
        }
    }
    let (distance, entity) = nearest?;
    Some(Hit {
        entity,
        point: (ray.origin + direction * distance).as_dvec3(),
        distance: f64::from(distance),
    })
}

/// Whether the ray comes through the sphere around an entity before a distance.
fn meets_bounds(
    world: &World,
    entity: Entity,
    origin: Vec3,
    direction: Vec3,
    farthest: f32,
) -> bool {
    let Some(bounds) = world.get::<WorldBounds>(entity) else {
        return false;
    };
    let to_center = Vec3::new(bounds.x, bounds.y, bounds.z) - origin;
    let along = to_center.dot(direction);
    let beside = to_center - direction * along;
    // Far origins, as those of orthographic views, are coarse.
    let radius = bounds.radius * 1.001 + 1e-6 * along.abs();
    beside.length() <= radius && along >= -radius && along - radius < farthest
}

/// The distance to the first triangle, by Möller and Trumbore 1997, "Fast, Minimum Storage
/// Ray/Triangle Intersection". The ray goes into the mesh's space as it is, so that distances stay
/// those of the world.
fn meet_mesh(
    positions: &[Vec3],
    indices: &[u32],
    to_mesh: Affine3A,
    origin: Vec3,
    direction: Vec3,
) -> Option<f32> {
    let origin = to_mesh.transform_point3(origin);
    let direction = to_mesh.transform_vector3(direction);
    let corner = |index: u32| positions.get(index as usize).copied();
    let mut nearest: Option<f32> = None;
    for triangle in indices.chunks_exact(3) {
        let (Some(a), Some(b), Some(c)) = (
            corner(triangle[0]),
            corner(triangle[1]),
            corner(triangle[2]),
        ) else {
            continue;
        };
        let (ab, ac) = (b - a, c - a);
        let across = direction.cross(ac);
        let determinant = ab.dot(across);
        if determinant == 0.0 {
            continue;
        }
        let from_a = origin - a;
        let u = from_a.dot(across) / determinant;
        let over = from_a.cross(ab);
        let v = direction.dot(over) / determinant;
        let distance = ac.dot(over) / determinant;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
        if inside && nearest.is_none_or(|before| distance < before) {
            nearest = Some(distance);
        }
    }
    nearest
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.section("Keyboard and mouse");
    let stage = stage.clone();
    api.function(
        "pick(origin, direction)",
        "What a line from a point in a direction meets first, as a map with `entity`, `point` in the \
         world and `distance` in metres; `()` where it meets nothing. Entities stand where they stood \
         at the end of the last step.",
        move |a| {
            let (origin, direction) = (a.object::<DVec3>(0)?, a.object::<DVec3>(1)?);
            if direction.length_squared() < 1e-12 {
                return Err(Mistake::new("the direction has no length"));
            }
            let ray = Ray {
                origin: origin.as_vec3(),
                direction: direction.as_vec3(),
            };
            let hit = {
                let data = stage.lock();
                pick(&data.world, &data.assets, ray, |_| true)
            };
            let Some(hit) = hit else {
                return Ok(Dynamic::UNIT);
            };
            let mut map = Map::new();
            map.insert("entity".into(), Dynamic::from(hit.entity));
            map.insert("point".into(), Dynamic::from(hit.point));
            map.insert("distance".into(), Dynamic::from(hit.distance));
            Ok(Dynamic::from_map(map))
        },
    );
}
