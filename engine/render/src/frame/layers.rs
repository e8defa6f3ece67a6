//! Layers of objects that do not overlap on the screen.

use glam::Vec3;
use lightbench_world::WorldBounds;

use super::Frame;
use super::objects::{Objects, distance};
use crate::description::{DrawOrder, MAX_LAYERS};
use crate::volumes;

/// An object of a list while layers are chosen, in the order of choosing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layered {
    distance: u32,
    row: u32,
    /// Its place in the list.
    index: usize,
    /// Around its bounding sphere: left, top, right, bottom.
    rectangle: [f32; 4],
}

impl Frame {
    /// Gives each object of the order one of `count` layers, such that objects that overlap on the
    /// screen have different ones as far as there are enough.
    ///
    /// The nearest object chooses first. Each takes the layer that the fewest objects overlapping it
    /// have, and of several the first. The choice depends on the objects and the view alone, not on
    /// the order of drawing, so that all passes find an object in the same layer.
    pub(super) fn choose_layers(&mut self, count: u32, objects: &Objects<'_>) {
        if count == 0 {
            return;
        }
        let bounds = objects.world.columns::<WorldBounds>();
        let b = bounds.slices();
        self.layered.clear();
        self.layered
            .extend(self.order.iter().enumerate().map(|(index, entry)| {
                let row = entry.row as usize;
                let center = Vec3::new(b.x[row], b.y[row], b.z[row]);
                Layered {
                    distance: distance(DrawOrder::FrontToBack, objects, row),
                    row: entry.row,
                    index,
                    rectangle: volumes::sphere_rectangle(center, b.radius[row], objects.view),
                }
            }));
        self.layered.sort_unstable_by_key(|l| (l.distance, l.row));
        for (at, object) in self.layered.iter().enumerate() {
            let mut taken = [0_u32; MAX_LAYERS];
            for nearer in &self.layered[..at] {
                if volumes::overlap(&nearer.rectangle, &object.rectangle) {
                    taken[self.order[nearer.index].layer as usize] += 1;
                }
            }
            let layers = 0..(count as usize).min(MAX_LAYERS);
            let freest = layers.min_by_key(|&layer| taken[layer]).unwrap_or(0);
            self.order[object.index].layer = freest as u32;
        }
    }
}
