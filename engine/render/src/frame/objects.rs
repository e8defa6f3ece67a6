//! Lists of objects: which, in which order, in which draw calls.

use glam::Vec3;
use lightbench_assets::{Assets, Material, ReflectionModel, ReflectionModels};
use lightbench_world::{MaterialId, MeshId, MeshRenderer, World, WorldBounds};

use super::{Frame, ListKey, MeshDraw, Step, ViewVolume};
use crate::description::{DrawList, DrawOrder, ObjectLights};
use crate::gpu_data::{DrawnObject, InstanceData, LightData};
use crate::variant::Variant;

/// What lists of objects are made from.
pub(super) struct Objects<'a> {
    pub world: &'a World,
    pub assets: &'a Assets,
    pub instances: &'a [InstanceData],
    pub lights: &'a [LightData],
    pub models: ReflectionModels,
    pub view: &'a ViewVolume,
}

/// One object on its way into a list, in the order of drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Entry {
    /// Smaller is drawn earlier.
    distance: u32,
    pub variant: Variant,
    pub mesh: MeshId,
    pub row: u32,
    /// Chosen after the order.
    pub layer: u32,
}

impl Frame {
    /// Fills one list.
    pub(super) fn objects(&mut self, index: usize, key: &ListKey, objects: &Objects<'_>) {
        self.sort(key, objects);
        self.choose_layers(key.layers, objects);
        if key.list == DrawList::Opaque || key.list == DrawList::All {
            self.visible_objects = self.visible_objects.max(self.order.len() as u32);
        }
        let mut list = std::mem::take(&mut self.lists[index]);
        list.draws.clear();
        list.steps.clear();
        match key.repeat {
            Some(repeat) => self.repeat(&mut list, repeat, objects),
            None => {
                if key.lights == ObjectLights::Gathered && !self.order.is_empty() {
                    self.reach.fill(objects.lights, |_| true);
                }
                let order = std::mem::take(&mut self.order);
                for entry in &order {
                    let lights = self.lights_of(key.lights, entry.row, objects);
                    self.draw(&mut list.draws, 0, entry, lights);
                }
                self.order = order;
                list.steps.push(Step {
                    draws: 0..list.draws.len(),
                    scissor: None,
                    mark: None,
                });
            }
        }
        self.lists[index] = list;
    }

    /// Chooses the objects of a list and sorts them.
    fn sort(&mut self, key: &ListKey, objects: &Objects<'_>) {
        self.order.clear();
        if key.list == DrawList::Casters {
            let count = objects.world.columns::<MeshRenderer>().len() as u32;
            (0..count).for_each(|row| self.take(key.list, key.order, row, objects));
        } else {
            let visible = std::mem::take(&mut self.visible);
            for &row in &visible {
                self.take(key.list, key.order, row, objects);
            }
            self.visible = visible;
        }
        self.order.sort_unstable();
    }

    /// Adds an object to the order if it belongs to a list.
    pub(super) fn take(
        &mut self,
        list: DrawList,
        order: DrawOrder,
        row: u32,
        objects: &Objects<'_>,
    ) {
        let renderers = objects.world.columns::<MeshRenderer>();
        let r = renderers.slices();
        let index = row as usize;
        if !r.visible[index] {
            return;
        }
        let traits = Traits::of(objects.assets.material(r.material[index]), objects.models);
        let wanted = match list {
            DrawList::Opaque | DrawList::Casters => !traits.transparent,
            DrawList::Transparent => traits.transparent,
            DrawList::All => true,
        };
        if wanted {
            let mirrored = is_mirrored(&objects.instances[index]);
            self.order.push(Entry {
                distance: distance(order, objects, index),
                variant: Variant::new(
                    traits.two_sided,
                    traits.alpha_test,
                    mirrored,
                    traits.other_model,
                ),
                mesh: r.mesh[index],
                row,
                layer: 0,
            });
        }
    }

    /// Adds an object to the last draw call, if it fits there and that is not before `first`, or to
    /// a new one. `lights` are the first and the number of its list.
    pub(super) fn draw(
        &mut self,
        draws: &mut Vec<MeshDraw>,
        first: usize,
        entry: &Entry,
        lights: (u32, u32),
    ) {
        let at = self.drawn.len() as u32;
        self.variants.insert(entry.variant);
        self.drawn.push(DrawnObject {
            instance: entry.row,
            first_light: lights.0,
            light_count: lights.1,
            layer: entry.layer,
        });
        let open = draws.len() > first;
        match draws.last_mut() {
            Some(draw)
                if open
                    && draw.variant == entry.variant
                    && draw.mesh == entry.mesh
                    && draw.objects.end == at =>
            {
                draw.objects.end = at + 1;
            }
            _ => draws.push(MeshDraw {
                variant: entry.variant,
                mesh: entry.mesh,
                objects: at..at + 1,
            }),
        }
    }
}

/// A number that grows in the order of drawing: with the distance of the bounds' centre along the
/// view, or against it.
pub(super) fn distance(order: DrawOrder, objects: &Objects<'_>, row: usize) -> u32 {
    if order == DrawOrder::State {
        return 0;
    }
    let bounds = objects.world.columns::<WorldBounds>();
    let b = bounds.slices();
    let center = Vec3::new(b.x[row], b.y[row], b.z[row]);
    let ahead = objects.view.forward.dot(center - objects.view.position);
    // The bits of positive floats are ordered as the floats are; negative ones the other way round.
    let bits = ahead.to_bits();
    let ascending = if bits >> 31 == 0 {
        bits | 1 << 31
    } else {
        !bits
    };
    match order {
        DrawOrder::BackToFront => !ascending,
        _ => ascending,
    }
}

struct Traits {
    two_sided: bool,
    alpha_test: bool,
    transparent: bool,
    other_model: bool,
}

impl Traits {
    fn of(material: Option<&Material>, models: ReflectionModels) -> Self {
        let drawn = |m: &Material| m.reflection.nearest(models).model();
        Self {
            two_sided: material.is_some_and(|m| m.two_sided),
            alpha_test: material.is_some_and(|m| m.alpha_cutoff.is_some()),
            transparent: material.is_some_and(|m| m.is_transparent()),
            other_model: material.is_some_and(|m| drawn(m) != ReflectionModel::BlinnPhong),
        }
    }
}

/// Whether light passes through what has the material.
pub(super) fn is_transparent(assets: &Assets, id: MaterialId) -> bool {
    assets.material(id).is_some_and(Material::is_transparent)
}

/// Whether the world matrix turns the winding of triangles round.
fn is_mirrored(instance: &InstanceData) -> bool {
    let [x, y, z] = instance
        .world_rows
        .map(|row| Vec3::new(row[0], row[1], row[2]));
    x.dot(y.cross(z)) < 0.0
}
