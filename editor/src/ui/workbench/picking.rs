//! What is under the pointer.

use lightbench::render::View;
use lightbench::script::{Ray, Scene, SceneEvent};
use lightbench::world::glam::{Affine3A, Vec3};
use lightbench::world::{Entity, MeshRenderer, WorldBounds, WorldMatrix};

use super::Workbench;

/// The line of sight through a place of the picture, in shares of its width and height from the
/// upper left. It begins at the near plane: what is nearer is not drawn.
pub fn line_of_sight(view: &View, share: [f32; 2], aspect: f32) -> Ray {
    let to_world = (view.projection(aspect) * view.view).inverse();
    // Depth is reversed: 1 is the near plane.
    let ndc = Vec3::new(2.0 * share[0] - 1.0, 1.0 - 2.0 * share[1], 1.0);
    let origin = to_world.project_point3(ndc);
    let direction = (origin - view.position()).normalize_or_zero();
    Ray { origin, direction }
}

/// The first visible mesh that a ray meets, and how far away.
pub fn pick(scene: &Scene, ray: Ray) -> Option<(Entity, f32)> {
    let direction = ray.direction.try_normalize()?;
    let renderers = scene.world.columns::<MeshRenderer>();
    let rows = renderers.slices();
    let mut nearest: Option<(Entity, f32)> = None;
    for (row, &entity) in renderers.entities().iter().enumerate() {
        let farthest = nearest.map_or(f32::INFINITY, |(_, distance)| distance);
        if !rows.visible[row] || !may_meet(scene, entity, ray.origin, direction, farthest) {
            continue;
        }
        let (Some(mesh), Some(matrix)) = (
            scene.assets.mesh(rows.mesh[row]),
            scene.world.get::<WorldMatrix>(entity),
        ) else {
            continue;
        };
        let to_mesh = matrix.matrix.inverse();
        let corners = mesh.indices.chunks_exact(3).filter_map(|triangle| {
            let corner = |index: usize| mesh.positions.get(triangle[index] as usize).copied();
            Some([corner(0)?, corner(1)?, corner(2)?])
        });
        if let Some(distance) = meet(corners, to_mesh, ray.origin, direction)
            && distance < farthest
        {
            nearest = Some((entity, distance));
        }
    }
    nearest
}

/// Whether the ray comes through the sphere around an entity before a distance.
fn may_meet(scene: &Scene, entity: Entity, origin: Vec3, direction: Vec3, farthest: f32) -> bool {
    let Some(bounds) = scene.world.get::<WorldBounds>(entity) else {
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
/// Ray/Triangle Intersection". The direction is not made a unit one in the mesh's space, so that
/// distances stay those of the world.
fn meet(
    triangles: impl Iterator<Item = [Vec3; 3]>,
    to_mesh: Affine3A,
    origin: Vec3,
    direction: Vec3,
) -> Option<f32> {
    let origin = to_mesh.transform_point3(origin);
    let direction = to_mesh.transform_vector3(direction);
    let distances = triangles.filter_map(|[a, b, c]| {
        let (ab, ac) = (b - a, c - a);
        let across = direction.cross(ac);
        let determinant = ab.dot(across);
        if determinant == 0.0 {
            return None;
        }
        let from_a = origin - a;
        let u = from_a.dot(across) / determinant;
        let over = from_a.cross(ab);
        let v = direction.dot(over) / determinant;
        let distance = ac.dot(over) / determinant;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
        inside.then_some(distance)
    });
    distances.reduce(f32::min)
}

impl Workbench {
    /// Tells the scene's scripts of a click at shares of the picture's width and height, from the
    /// upper left.
    pub fn click(&mut self, share: [f32; 2], aspect: f32) {
        let ray = line_of_sight(&self.camera.view(), share, aspect);
        self.happen(SceneEvent::Click(ray));
    }
}
