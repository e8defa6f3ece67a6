//! Lists of light volumes: how each light is drawn, in which draw calls.

use glam::Vec3;

use super::{Frame, ViewVolume};
use crate::description::{LightStencil, Lights};
use crate::gpu_data::LightData;
use crate::volumes::{self, Case, VolumeDraw};

impl Frame {
    /// Chooses how each light is drawn, and groups equal choices into instanced draws.
    pub(super) fn light_volumes(
        &mut self,
        index: usize,
        key: &Lights,
        lights: &[LightData],
        view: &ViewVolume,
    ) {
        self.kinds.clear();
        for array in &mut self.arrays {
            array.clear();
        }
        let list = &mut self.light_lists[index];
        (list.coverage, list.unplaced) = (0.0, 0);
        list.draws.clear();
        for (index, light) in lights.iter().enumerate() {
            let unbounded = !volumes::is_bounded(light);
            if unbounded && (key.bounded_only || key.arrays > 0) {
                continue;
            }
            let Some(volume) = volumes::volume(light, index as u32, view, key.volumes) else {
                continue;
            };
            let array = if key.arrays == 0 {
                0
            } else {
                match place(&mut self.arrays, key.arrays, light) {
                    Some(array) => array,
                    None => {
                        list.unplaced += 1;
                        continue;
                    }
                }
            };
            list.coverage += if key.volumes {
                volumes::coverage(light, view)
            } else {
                1.0
            };
            // A scheme whose faces a plane of the view may cut does without stencil.
            let uncut = match key.stencil {
                LightStencil::Off => false,
                LightStencil::TwoPass => !volume.crosses_near && !volume.crosses_far,
                LightStencil::Inverse => !volume.crosses_far,
            };
            let stencil = uncut
                && volume.kind.case != Case::Screen
                && volumes::angular_diameter(light, view) >= key.threshold * view.fov_y();
            self.kinds.push(super::Chosen {
                array,
                stencil,
                kind: volume.kind,
                data: volume.data,
            });
        }
        self.visible_lights = self.kinds.len() as u32 + list.unplaced;
        // Equal kinds stay in the order of light indices, so that sums do too.
        self.kinds
            .sort_unstable_by_key(|c| (c.array, c.stencil, c.kind, c.data.light));
        for chosen in &self.kinds {
            let at = self.volumes.len() as u32;
            self.volumes.push(chosen.data);
            match list.draws.last_mut() {
                Some(draw)
                    if !chosen.stencil
                        && (draw.array, draw.stencil, draw.kind)
                            == (chosen.array, false, chosen.kind) =>
                {
                    draw.volumes.end = at + 1;
                }
                _ => list.draws.push(VolumeDraw {
                    kind: chosen.kind,
                    volumes: at..at + 1,
                    array: chosen.array,
                    stencil: chosen.stencil,
                }),
            }
        }
    }
}

/// Finds the first array in which a light overlaps no other, by bounding spheres, and puts it there.
fn place(arrays: &mut Vec<Vec<(Vec3, f32)>>, count: u32, light: &LightData) -> Option<u32> {
    if arrays.len() < count as usize {
        arrays.resize_with(count as usize, Vec::new);
    }
    let (center, radius) = (light.position, light.range);
    let free = |array: &Vec<(Vec3, f32)>| {
        array.iter().all(|(other, other_radius)| {
            let apart = radius + other_radius;
            other.distance_squared(center) > apart * apart
        })
    };
    let found = arrays[..count as usize].iter().position(free)?;
    arrays[found].push((center, radius));
    Some(found as u32)
}
