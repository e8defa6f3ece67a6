//! The lights of each object, and objects drawn again for each group of lights.

use super::objects::Objects;
use super::reach::Space;
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
                self.reach.find(&space, &mut self.object_lights);
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
        let lights = objects.lights;
        let shown = |light: &LightData| {
            light.kind != AMBIENT && volumes::volume(light, 0, objects.view, true).is_some()
        };
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.begin(lights, repeat.lights as usize, shown);
        let order = std::mem::take(&mut self.order);
        self.reach.fill(lights, |index| pairs.is_shown(index));
        for (at, entry) in order.iter().enumerate() {
            self.found.clear();
            let space = Space::of(objects, entry.row);
            self.reach.find(&space, &mut self.found);
            pairs.add(at as u32, &self.found);
        }
        pairs.sort();
        for group in 0..pairs.groups() {
            let first_draw = list.draws.len();
            for of_object in pairs.of_group(group).chunk_by(|a, b| a.object == b.object) {
                let first = self.object_lights.len() as u32;
                let lights = of_object.iter().map(|pair| pair.light);
                self.object_lights.extend(lights);
                let entry = &order[of_object[0].object as usize];
                let lights = (first, of_object.len() as u32);
                self.draw(&mut list.draws, first_draw, entry, lights);
            }
            if list.draws.len() > first_draw {
                let members = pairs.members(group);
                let scissor = repeat.scissor.then(|| {
                    let light = |index: &u32| &lights[*index as usize];
                    let rectangles = members
                        .iter()
                        .map(|index| volumes::rectangle(light(index), objects.view));
                    rectangles.fold(
                        [1.0_f32, 1.0, 0.0, 0.0],
                        |[l, t, r, b], [left, top, right, bottom]| {
                            [l.min(left), t.min(top), r.max(right), b.max(bottom)]
                        },
                    )
                });
                let mark = members.first().filter(|_| repeat.stencil);
                let mark = mark.and_then(|light| self.mark(*light, objects));
                list.steps.push(Step {
                    draws: first_draw..list.draws.len(),
                    scissor,
                    mark,
                });
            }
        }
        self.order = order;
        self.pairs = pairs;
    }

    /// The volume of a light, to be marked in stencil.
    fn mark(&mut self, light: u32, objects: &Objects<'_>) -> Option<VolumeDraw> {
        let data = &objects.lights[light as usize];
        let found = volumes::volume(data, light, objects.view, true)?;
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
