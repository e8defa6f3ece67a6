//! World bounds: a sphere and a box around each drawn mesh.

use glam::{Affine3A, Vec3};

use crate::columns::Columns;
use crate::components::{MeshRenderer, WorldBounds, WorldMatrix};
use crate::ticks::Tick;
use crate::world::World;

/// The bounds of a mesh in its own space, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshBounds {
    /// Centre of the box and of the sphere.
    pub center: Vec3,
    /// Half the extents of the box.
    pub half_extents: Vec3,
    /// Radius of the sphere: the greatest distance of a vertex from the centre.
    pub radius: f32,
}

/// What the last run saw.
#[derive(Clone, Debug, Default)]
pub(crate) struct BoundsState {
    seen: Tick,
    meshes: Vec<MeshBounds>,
}

/// Writes the world bounds of every entity with a MeshRenderer whose mesh or
/// world matrix has changed since the last call.
///
/// `mesh_bounds` is indexed by [`MeshId`](crate::MeshId). A mesh beyond its end
/// has empty bounds in its own origin. An entity without a Transform stands at
/// the origin. Call [`update_world_matrices`](super::update_world_matrices)
/// first.
pub fn update_bounds(world: &mut World, mesh_bounds: &[MeshBounds]) {
    know_meshes(world, mesh_bounds);
    update_known_bounds(world);
}

/// Gives the next update another table of meshes.
pub(super) fn know_meshes(world: &mut World, mesh_bounds: &[MeshBounds]) {
    let state = &mut world.systems.bounds;
    if state.meshes != mesh_bounds {
        mesh_bounds.clone_into(&mut state.meshes);
        state.seen = Tick::START;
    }
}

/// [`update_bounds`] with the table that is known.
pub(super) fn update_known_bounds(world: &mut World) {
    let mut state = std::mem::take(&mut world.systems.bounds);
    let seen = state.seen;
    let changed = world.columns::<MeshRenderer>().any_changed_since(seen)
        || world.columns::<WorldMatrix>().any_changed_since(seen);
    if changed {
        state.seen = world.observe();
        let mut output = world.take_columns::<WorldBounds>();
        update_changed(world, &mut output, &state.meshes, seen);
        world.put_columns(output);
    }
    world.systems.bounds = state;
}

fn update_changed(
    world: &World,
    output: &mut Columns<WorldBounds>,
    mesh_bounds: &[MeshBounds],
    seen: Tick,
) {
    let renderers = world.columns::<MeshRenderer>();
    let matrices = world.columns::<WorldMatrix>();
    let mut update = |row: usize, matrix: Option<usize>| {
        let mesh = renderers.mesh()[row].0 as usize;
        let matrix = matrix.map_or(Affine3A::IDENTITY, |row| matrices.matrix()[row]);
        let bounds = mesh_bounds.get(mesh).copied().unwrap_or_default();
        output.set_row(row, world_bounds(&bounds, &matrix));
    };
    for row in renderers.changed_since(seen) {
        update(row, matrices.row_of(renderers.entities()[row]));
    }
    for matrix in matrices.changed_since(seen) {
        if let Some(row) = renderers.row_of(matrices.entities()[matrix])
            && !renderers.row_changed_since(row, seen)
        {
            update(row, Some(matrix));
        }
    }
}

/// The bounds of a mesh after an affine map. The box is the tightest one around
/// the mapped box (Arvo 1990, "Transforming axis-aligned bounding boxes"). The
/// sphere's radius grows by an upper bound of the map's greatest stretch, and
/// never beyond the box's corner.
fn world_bounds(mesh: &MeshBounds, matrix: &Affine3A) -> WorldBounds {
    let center = matrix.transform_point3(mesh.center);
    let [x, y, z] = [
        Vec3::from(matrix.matrix3.x_axis),
        Vec3::from(matrix.matrix3.y_axis),
        Vec3::from(matrix.matrix3.z_axis),
    ];
    let half = x.abs() * mesh.half_extents.x
        + y.abs() * mesh.half_extents.y
        + z.abs() * mesh.half_extents.z;
    let radius = (mesh.radius * greatest_stretch(x, y, z)).min(half.length());
    WorldBounds {
        x: center.x,
        y: center.y,
        z: center.z,
        radius,
        half_x: half.x,
        half_y: half.y,
        half_z: half.z,
    }
}

/// An upper bound of the greatest singular value of a matrix with these columns:
/// exact for orthogonal columns (rotation and scale), and by Gershgorin's
/// theorem on MᵀM for sheared ones, which a rotated child of a stretched parent
/// has.
fn greatest_stretch(x: Vec3, y: Vec3, z: Vec3) -> f32 {
    let (xy, yz, zx) = (x.dot(y).abs(), y.dot(z).abs(), z.dot(x).abs());
    let rows = [
        x.length_squared() + xy + zx,
        y.length_squared() + xy + yz,
        z.length_squared() + yz + zx,
    ];
    rows.into_iter().fold(0.0, f32::max).sqrt()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::components::Transform;
    use crate::systems::update_world_matrices;
    use crate::value::MeshId;
    use glam::Quat;

    const CUBE: MeshBounds = MeshBounds {
        center: Vec3::new(0.5, 0.0, 0.0),
        half_extents: Vec3::ONE,
        radius: 1.732_050_8,
    };

    #[test]
    fn bounds_hold_every_corner_even_under_shear() {
        for i in 0..200 {
            let angle = i as f32 * 0.37;
            let stretch = Affine3A::from_scale(Vec3::new(1.0, 0.2 + 0.05 * i as f32, 3.0));
            let matrix = stretch
                * Affine3A::from_rotation_translation(
                    Quat::from_euler(glam::EulerRot::XYZ, angle, 2.0 * angle, 0.5),
                    Vec3::new(angle, -3.0, 1.0),
                );
            let bounds = world_bounds(&CUBE, &matrix);
            for corner in 0..8 {
                let sign = |bit: i32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
                let corner = CUBE.center + Vec3::new(sign(0), sign(1), sign(2));
                let offset = matrix.transform_point3(corner) - bounds.center();
                let slack = 1e-4 * bounds.radius;
                assert!(offset.length() <= bounds.radius + slack);
                assert!((offset.abs() - bounds.half_extents()).max_element() <= slack);
            }
        }
    }

    #[test]
    fn rotation_and_scale_give_the_exact_sphere() {
        let ball = MeshBounds {
            center: Vec3::ZERO,
            half_extents: Vec3::ONE,
            radius: 1.0,
        };
        let matrix = Affine3A::from_scale_rotation_translation(
            Vec3::splat(2.0),
            Quat::from_rotation_x(0.7),
            Vec3::Y,
        );
        let bounds = world_bounds(&ball, &matrix);
        assert!((bounds.radius - 2.0).abs() < 1e-5);
        assert_eq!(bounds.center(), Vec3::Y);
    }

    #[test]
    fn follows_the_matrix_the_mesh_and_the_table() {
        let mut world = World::new();
        let [entity, other] = std::array::from_fn(|_| {
            let entity = world.spawn();
            world.insert(entity, Transform::default()).unwrap();
            world.insert(entity, MeshRenderer::default()).unwrap();
            entity
        });
        let small = MeshBounds {
            radius: 0.5,
            ..CUBE
        };
        let run = |world: &mut World, table: &[MeshBounds]| {
            let seen = world.observe();
            update_world_matrices(world);
            update_bounds(world, table);
            let columns = world.columns::<WorldBounds>();
            (
                columns.changed_since(seen).count(),
                world.get::<WorldBounds>(entity).unwrap(),
            )
        };
        assert_eq!(run(&mut world, &[CUBE, small]).1.center(), CUBE.center);
        assert_eq!(run(&mut world, &[CUBE, small]).0, 0);
        let moved = Transform::from_translation(Vec3::Y);
        world.set(entity, moved).unwrap();
        let (written, bounds) = run(&mut world, &[CUBE, small]);
        assert_eq!((written, bounds.y), (1, 1.0));
        let mut renderer = MeshRenderer {
            mesh: MeshId(1),
            ..MeshRenderer::default()
        };
        world.set(entity, renderer).unwrap();
        assert_eq!(run(&mut world, &[CUBE, small]).1.radius, 0.5);
        assert_eq!(run(&mut world, &[CUBE, CUBE]).0, 2);
        renderer.mesh = MeshId(99);
        world.set(entity, renderer).unwrap();
        assert_eq!(run(&mut world, &[CUBE, CUBE]).1.radius, 0.0);
        world.remove::<Transform>(entity);
        renderer.mesh = MeshId(0);
        world.set(other, renderer).unwrap();
        let (written, bounds) = run(&mut world, &[CUBE, CUBE]);
        assert_eq!((written, bounds.y), (2, 0.0));
        assert!(world.despawn(other));
        assert_eq!(world.columns::<WorldBounds>().len(), 1);
    }
}
