//! The grid of world-space light indexing, as the CPU counts it.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::lists::Asked;

/// Cells along x and z.
const COLUMNS: i64 = 64;
/// Lights that a list has room for in tests.
pub const ROOM: usize = 64;

/// A grid as the parameters choose it.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Side of a cell, metres.
    pub cell: f64,
    /// Layers of cells; with one, cells are as high as the world.
    pub layers: i64,
}

impl Grid {
    /// The parameters.
    pub fn texts(self) -> [String; 3] {
        let layers = if self.layers == 1 { "2d" } else { "3d" };
        [
            format!("cell_size={}", self.cell),
            format!("layers={layers}"),
            format!("capacity={ROOM}"),
        ]
    }

    /// How many there are.
    pub fn cells(self) -> usize {
        (COLUMNS * COLUMNS * self.layers) as usize
    }

    /// Words of all lists.
    pub fn words(self) -> u32 {
        (self.cells() * (ROOM + 1)) as u32
    }

    fn number(self, [x, y, z]: [i64; 3]) -> usize {
        let [x, z] = [x, z].map(|at| at.rem_euclid(COLUMNS));
        ((y.rem_euclid(self.layers) * COLUMNS + z) * COLUMNS + x) as usize
    }

    /// The cell that a point lies in; none where rounding decides.
    pub fn cell_of(self, (_, point): (usize, DVec3)) -> Option<Asked> {
        let at = point / self.cell;
        let sure = (at - at.round()).abs().min_element() > 1e-3;
        let cell = at.floor().to_array().map(|at| at as i64);
        sure.then(|| (self.number(cell), point))
    }

    /// The cells that a ball reaches: those whose nearest point lies in it. Panics where rounding
    /// decides.
    pub fn reached(self, center: DVec3, radius: f64) -> BTreeSet<usize> {
        let first = ((center - radius) / self.cell).floor();
        let last = ((center + radius) / self.cell).floor();
        let along = |axis: usize| first[axis] as i64..=last[axis] as i64;
        let mut reached = BTreeSet::new();
        for (x, z) in along(0).flat_map(|x| along(2).map(move |z| (x, z))) {
            // Without layers a cell is as high as the world.
            let layers = if self.layers == 1 { 0..=0 } else { along(1) };
            for y in layers {
                let low = DVec3::new(x as f64, y as f64, z as f64) * self.cell;
                let mut away = center - center.clamp(low, low + self.cell);
                if self.layers == 1 {
                    away.y = 0.0;
                }
                let inside = radius - away.length();
                assert!(inside.abs() > 1e-6, "rounding decides");
                if inside > 0.0 {
                    reached.insert(self.number([x, y, z]));
                }
            }
        }
        reached
    }
}
