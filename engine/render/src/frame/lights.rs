//! Lists of light volumes: how each light is drawn, in which draw calls.

use glam::Vec3;

use super::clip_volumes::clip_volume;
use super::objects::Objects;
use super::{Frame, ViewVolume};
use crate::description::{LightStencil, Lights};
use crate::gpu_data::{LightData, LightVolumeData, matrix_rows};
use crate::scene::Shape;
use crate::volumes::{self, Case, Marking, VolumeDraw, VolumeKind};

impl Frame {
    /// Chooses how each light is drawn, and groups equal choices into instanced draws.
    pub(super) fn light_volumes(
        &mut self,
        index: usize,
        key: &Lights,
        objects: &Objects<'_>,
        clamps_depth: bool,
    ) {
        let (lights, view) = (objects.lights, objects.view);
        self.kinds.clear();
        for array in &mut self.arrays {
            array.clear();
        }
        let list = &mut self.light_lists[index];
        (list.coverage, list.unplaced, list.unconfined) = (0.0, 0, 0);
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
                match place(&mut self.arrays, key, light, view) {
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
            if let Some(clip) = clip_volume(objects, index) {
                let can = key.stencil != LightStencil::Off && key.volumes && !key.any_depth;
                if can && (clamps_depth || !clip.crosses_far) {
                    self.kinds.push(super::Chosen {
                        array,
                        marking: Marking::Count,
                        kind: VolumeKind {
                            case: Case::Back,
                            shape: Shape::Mesh(clip.mesh),
                        },
                        data: LightVolumeData {
                            rows: matrix_rows(&clip.transform),
                            ..volume.data
                        },
                    });
                    continue;
                }
                list.unconfined += 1;
            }
            // A scheme whose faces a plane of the view may cut does without stencil.
            let uncut = match key.stencil {
                LightStencil::Off => false,
                LightStencil::TwoPass => !volume.crosses_near && !volume.crosses_far,
                LightStencil::Inverse => !volume.crosses_far,
            };
            let large = volumes::angular_diameter(light, view) >= key.threshold * view.fov_y();
            let marking = if uncut && large && volume.kind.case != Case::Screen {
                Marking::Scheme
            } else {
                Marking::Depth
            };
            self.kinds.push(super::Chosen {
                array,
                marking,
                kind: volume.kind,
                data: volume.data,
            });
        }
        self.visible_lights = self.kinds.len() as u32 + list.unplaced;
        // Equal kinds stay in the order of light indices, so that sums do too.
        self.kinds
            .sort_unstable_by_key(|c| (c.array, c.marking, c.kind, c.data.light));
        for chosen in &self.kinds {
            let at = self.volumes.len() as u32;
            self.volumes.push(chosen.data);
            match list.draws.last_mut() {
                Some(draw)
                    if chosen.marking == Marking::Depth
                        && (draw.array, draw.marking, draw.kind)
                            == (chosen.array, chosen.marking, chosen.kind) =>
                {
                    draw.volumes.end = at + 1;
                }
                _ => list.draws.push(VolumeDraw {
                    kind: chosen.kind,
                    volumes: at..at + 1,
                    array: chosen.array,
                    marking: chosen.marking,
                }),
            }
        }
    }
}

/// What a light takes up in an array.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    /// A sphere in the world: centre and radius.
    Sphere(Vec3, f32),
    /// A rectangle of the screen.
    Rectangle([f32; 4]),
}

impl Place {
    fn overlaps(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Sphere(a, a_radius), Self::Sphere(b, b_radius)) => {
                a.distance_squared(*b) <= (a_radius + b_radius).powi(2)
            }
            (Self::Rectangle(a), Self::Rectangle(b)) => volumes::overlap(a, b),
            _ => true,
        }
    }
}

/// Finds the first array in which a light overlaps no other, and puts it there. At one depth lights
/// overlap where their spheres do; seen at any depth, where they do on the screen.
fn place(
    arrays: &mut Vec<Vec<Place>>,
    key: &Lights,
    light: &LightData,
    view: &ViewVolume,
) -> Option<u32> {
    let count = key.arrays as usize;
    if arrays.len() < count {
        arrays.resize_with(count, Vec::new);
    }
    let place = if key.any_depth {
        Place::Rectangle(volumes::rectangle(light, view))
    } else {
        Place::Sphere(light.position, light.range)
    };
    let free = |array: &Vec<Place>| !array.iter().any(|other| other.overlaps(&place));
    let found = arrays[..count].iter().position(free)?;
    arrays[found].push(place);
    Some(found as u32)
}
