//! From components to rows of the GPU's buffers, following the world's change ticks.

use glam::Vec3;
use lightbench_world::{Light, LightKind, MeshRenderer, Tick, World, WorldMatrix};

use super::{MeshPool, RowBuffer};
use crate::gpu_data::{InstanceData, LightData, matrix_rows};

/// What the GPU's rows were last compared with.
#[derive(Default)]
pub struct SceneRows {
    seen: Option<Tick>,
    /// The revision of the meshes that instances point into.
    meshes: u64,
}

impl SceneRows {
    /// Copies what changed since the last call. Row `i` of each buffer is row `i` of the component.
    pub fn sync(
        &mut self,
        world: &World,
        meshes: &MeshPool,
        instances: &mut RowBuffer<InstanceData>,
        lights: &mut RowBuffer<LightData>,
    ) {
        let since = self.seen.unwrap_or(Tick::START);
        // Meshes that were uploaded again may lie elsewhere.
        let all = self.seen.is_none() || self.meshes != meshes.revision();
        self.seen = Some(world.observe());
        self.meshes = meshes.revision();

        let renderers = world.columns::<MeshRenderer>();
        let light_columns = world.columns::<Light>();
        instances.resize(renderers.len());
        lights.resize(light_columns.len());
        if all {
            (0..renderers.len()).for_each(|row| instances.set(row, instance(world, meshes, row)));
            (0..light_columns.len()).for_each(|row| lights.set(row, light(world, row)));
            return;
        }
        for row in renderers.changed_since(since) {
            instances.set(row, instance(world, meshes, row));
        }
        for row in light_columns.changed_since(since) {
            lights.set(row, light(world, row));
        }
        let matrices = world.columns::<WorldMatrix>();
        for row in matrices.changed_since(since) {
            let entity = matrices.entities()[row];
            if let Some(row) = renderers.row_of(entity) {
                instances.set(row, instance(world, meshes, row));
            }
            if let Some(row) = light_columns.row_of(entity) {
                lights.set(row, light(world, row));
            }
        }
    }
}

fn instance(world: &World, meshes: &MeshPool, row: usize) -> InstanceData {
    let renderers = world.columns::<MeshRenderer>();
    let renderer = renderers.row(row);
    let matrix = world
        .get::<WorldMatrix>(renderers.entities()[row])
        .unwrap_or_default()
        .matrix;
    // An object without a mesh is never drawn.
    let mesh = meshes.range(renderer.mesh).cloned().unwrap_or_default();
    InstanceData {
        world_rows: matrix_rows(&matrix),
        material: renderer.material.0,
        first_index: mesh.indices.start,
        base_vertex: mesh.base_vertex.unsigned_abs(),
        reserved: 0,
    }
}

fn light(world: &World, row: usize) -> LightData {
    let lights = world.columns::<Light>();
    let matrix = world
        .get::<WorldMatrix>(lights.entities()[row])
        .unwrap_or_default()
        .matrix;
    light_data(
        &lights.row(row),
        matrix.translation.into(),
        (-matrix.matrix3.z_axis).into(),
    )
}

/// A light as shaders see it. `forward` is the way it shines and need not be a unit vector.
pub fn light_data(light: &Light, position: Vec3, forward: Vec3) -> LightData {
    // Cosines of the half angles; glTF's guard keeps equal angles from dividing by zero.
    let cos_inner = (light.inner_angle.min(light.outer_angle) * 0.5).cos();
    let cos_outer = (light.outer_angle * 0.5).cos();
    let angle_scale = 1.0 / (cos_inner - cos_outer).max(1e-3);
    LightData {
        position,
        range: light.range.max(0.0),
        direction: forward.try_normalize().unwrap_or(Vec3::NEG_Z),
        kind: match light.kind {
            LightKind::Point => 0,
            LightKind::Spot => 1,
            LightKind::Directional => 2,
            LightKind::Ambient => 3,
        },
        intensity: match light.visible {
            true => light.color * light.intensity,
            false => Vec3::ZERO,
        },
        angle_scale,
        angle_offset: -cos_outer * angle_scale,
        reserved: [0; 3],
    }
}
