//! The lights of each object, and objects drawn again for each group of lights.

use glam::Vec3;
use lightbench_world::WorldBounds;

use super::objects::Objects;
use super::{Frame, ObjectList, Step};
use crate::description::{ObjectLights, Repeat};
use crate::gpu_data::LightData;
use crate::volumes::{self, AMBIENT, Marking, VolumeDraw};

impl Frame {
    /// Where the list of an object's lights begins and how long it is, in the order of light
    /// indices.
    pub(super) fn lights_of(
        &mut self,
        which: ObjectLights,
        row: u32,
        objects: &Objects<'_>,
    ) -> (u32, u32) {
        let lights = objects.lights;
        match which {
            ObjectLights::Nothing => (0, 0),
            ObjectLights::All => self.shared(0, lights, |_| true),
            ObjectLights::Ambient => self.shared(1, lights, |light| light.kind == AMBIENT),
            ObjectLights::Gathered => {
                let first = self.object_lights.len() as u32;
                let space = Space::of(objects, row);
                for (index, light) in lights.iter().enumerate() {
                    if space.is_reached(light) {
                        self.object_lights.push(index as u32);
                    }
                }
                (first, self.object_lights.len() as u32 - first)
            }
        }
    }

    /// A list that all objects share, made when it is first needed.
    fn shared(
        &mut self,
        slot: usize,
        lights: &[LightData],
        wanted: impl Fn(&LightData) -> bool,
    ) -> (u32, u32) {
        if let Some(known) = self.shared_lights[slot] {
            return known;
        }
        let first = self.object_lights.len() as u32;
        let found = lights.iter().enumerate().filter(|(_, light)| wanted(light));
        self.object_lights
            .extend(found.map(|(index, _)| index as u32));
        let list = (first, self.object_lights.len() as u32 - first);
        self.shared_lights[slot] = Some(list);
        list
    }

    /// Fills a list once for each group of the lights that the view shows, ambient ones left out.
    pub(super) fn repeat(&mut self, list: &mut ObjectList, repeat: Repeat, objects: &Objects<'_>) {
        let order = std::mem::take(&mut self.order);
        let shown = |light: &LightData| {
            light.kind != AMBIENT && volumes::volume(light, 0, objects.view, true).is_some()
        };
        let mut next = 0;
        while next < objects.lights.len() {
            // The group: so many of the shown lights from here on.
            let begin = next;
            let mut taken = 0;
            while next < objects.lights.len() && taken < repeat.lights {
                taken += u32::from(shown(&objects.lights[next]));
                next += 1;
            }
            let group = begin..next;
            let first_draw = list.draws.len();
            for entry in &order {
                let space = Space::of(objects, entry.row);
                let first = self.object_lights.len() as u32;
                for index in group.clone() {
                    let light = &objects.lights[index];
                    if shown(light) && space.is_reached(light) {
                        self.object_lights.push(index as u32);
                    }
                }
                let count = self.object_lights.len() as u32 - first;
                if count > 0 {
                    self.draw(&mut list.draws, first_draw, entry, (first, count));
                }
            }
            if list.draws.len() > first_draw {
                let lights = group
                    .clone()
                    .map(|index| &objects.lights[index])
                    .filter(|light| shown(light));
                let scissor = repeat.scissor.then(|| {
                    lights.fold([1.0_f32, 1.0, 0.0, 0.0], |[l, t, r, b], light| {
                        let [left, top, right, bottom] = volumes::rectangle(light, objects.view);
                        [l.min(left), t.min(top), r.max(right), b.max(bottom)]
                    })
                });
                let mark = repeat.stencil.then(|| self.mark(group, objects)).flatten();
                list.steps.push(Step {
                    draws: first_draw..list.draws.len(),
                    scissor,
                    mark,
                });
            }
        }
        self.order = order;
    }

    /// The volume of the group's only light that is shown.
    fn mark(&mut self, group: std::ops::Range<usize>, objects: &Objects<'_>) -> Option<VolumeDraw> {
        let found = group
            .filter(|&index| objects.lights[index].kind != AMBIENT)
            .find_map(|index| {
                volumes::volume(&objects.lights[index], index as u32, objects.view, true)
            })?;
        let at = self.volumes.len() as u32;
        self.volumes.push(found.data);
        Some(VolumeDraw {
            kind: found.kind,
            volumes: at..at + 1,
            array: 0,
            marking: Marking::Scheme,
        })
    }
}

/// The box around an object.
struct Space {
    center: Vec3,
    half: Vec3,
}

impl Space {
    fn of(objects: &Objects<'_>, row: u32) -> Self {
        let bounds = objects.world.columns::<WorldBounds>();
        let b = bounds.slices();
        let row = row as usize;
        Self {
            center: Vec3::new(b.x[row], b.y[row], b.z[row]),
            half: Vec3::new(b.half_x[row], b.half_y[row], b.half_z[row]),
        }
    }

    /// Distance from the light to the box, by clamping (Arvo 1990, Graphics Gems).
    fn is_reached(&self, light: &LightData) -> bool {
        let outside = ((light.position - self.center).abs() - self.half).max(Vec3::ZERO);
        !volumes::is_bounded(light) || outside.length_squared() < light.range * light.range
    }
}
