//! From components to rows of the GPU's buffers, following the world's change ticks.

use glam::Vec3;
use lightbench_world::{Light, LightKind, MeshRenderer, Tick, World, WorldMatrix};

use super::RowBuffer;
use crate::gpu_data::{InstanceData, LightData, matrix_rows};

/// What the GPU's rows were last compared with.
#[derive(Default)]
pub struct SceneRows {
    seen: Option<Tick>,
}

impl SceneRows {
    /// Copies what changed since the last call. Row `i` of each buffer is row `i` of the component.
    pub fn sync(
        &mut self,
        world: &World,
        instances: &mut RowBuffer<InstanceData>,
        lights: &mut RowBuffer<LightData>,
    ) {
        let since = self.seen.unwrap_or(Tick::START);
        let all = self.seen.is_none();
        self.seen = Some(world.observe());

        let renderers = world.columns::<MeshRenderer>();
        let light_columns = world.columns::<Light>();
        instances.resize(renderers.len());
        lights.resize(light_columns.len());
        if all {
            (0..renderers.len()).for_each(|row| instances.set(row, instance(world, row)));
            (0..light_columns.len()).for_each(|row| lights.set(row, light(world, row)));
            return;
        }
        for row in renderers.changed_since(since) {
            instances.set(row, instance(world, row));
        }
        for row in light_columns.changed_since(since) {
            lights.set(row, light(world, row));
        }
        let matrices = world.columns::<WorldMatrix>();
        for row in matrices.changed_since(since) {
            let entity = matrices.entities()[row];
            if let Some(row) = renderers.row_of(entity) {
                instances.set(row, instance(world, row));
            }
            if let Some(row) = light_columns.row_of(entity) {
                lights.set(row, light(world, row));
            }
        }
    }
}

fn instance(world: &World, row: usize) -> InstanceData {
    let renderers = world.columns::<MeshRenderer>();
    let matrix = world
        .get::<WorldMatrix>(renderers.entities()[row])
        .unwrap_or_default()
        .matrix;
    InstanceData {
        world_rows: matrix_rows(&matrix),
        material: renderers.row(row).material.0,
        reserved: [0; 3],
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
        intensity: light.color * light.intensity,
        angle_scale,
        angle_offset: -cos_outer * angle_scale,
        reserved: [0; 3],
    }
}
