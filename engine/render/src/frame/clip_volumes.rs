//! The meshes that confine lights.

use glam::{Affine3A, Quat};
use lightbench_world::{ClipVolume, Light, MeshId, WorldMatrix};

use super::objects::Objects;

/// A mesh in the world, to the inside of which a light is confined.
#[derive(Clone, Copy, Debug)]
pub(super) struct Confine {
    pub mesh: MeshId,
    /// From the mesh's space to the world's.
    pub transform: Affine3A,
    /// Whether the far plane may cut it.
    pub crosses_far: bool,
}

/// The volume of the light in a row, if it has one.
pub(super) fn clip_volume(objects: &Objects<'_>, row: usize) -> Option<Confine> {
    let volumes = objects.world.columns::<ClipVolume>();
    if volumes.is_empty() {
        return None;
    }
    let entity = objects.world.columns::<Light>().entities()[row];
    let volume = volumes.row(volumes.row_of(entity)?);
    let bounds = objects.assets.mesh_bounds().get(volume.mesh.0 as usize)?;
    let own =
        Affine3A::from_scale_rotation_translation(volume.scale, Quat::IDENTITY, volume.offset);
    let to_world = objects.world.get::<WorldMatrix>(entity)?.matrix;
    let transform = to_world * own;
    let m = transform.matrix3;
    let stretch = [m.x_axis, m.y_axis, m.z_axis].map(glam::Vec3A::length);
    let radius = bounds.radius * stretch.into_iter().fold(0.0, f32::max);
    let view = objects.view;
    let ahead = transform.transform_point3(bounds.center) - view.position;
    Some(Confine {
        mesh: volume.mesh,
        transform,
        crosses_far: view.forward.dot(ahead) + radius >= view.far,
    })
}
