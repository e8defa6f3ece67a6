//! Woven cloth.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use super::{Noise, Surface, normal_map, paint};

/// Cloth in plain weave, with stripes along its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weave {
    /// Pixels a side.
    pub size: u32,
    /// Threads along a side, made even so that the weave repeats.
    pub threads: u32,
    /// Stripe patterns along a side; 0 for plain cloth.
    pub stripes: u32,
    /// Width of the second colour in a pattern, 0 to 1. A border of a sixth of
    /// it in the third colour runs along each side.
    pub stripe_width: f32,
    /// Of the cloth, its stripes and their borders.
    pub colors: [Vec3; 3],
    /// Thickness of a thread, in shares of the picture's side.
    pub depth: f32,
    /// Other irregular threads.
    pub seed: u32,
}

impl Default for Weave {
    fn default() -> Self {
        Self {
            size: 512,
            threads: 96,
            stripes: 3,
            stripe_width: 0.35,
            colors: [
                Vec3::new(0.42, 0.035, 0.03),
                Vec3::new(0.50, 0.30, 0.07),
                Vec3::new(0.05, 0.03, 0.10),
            ],
            depth: 0.002,
            seed: 1,
        }
    }
}

impl Weave {
    /// Colours and normals.
    #[must_use]
    pub fn paint(&self) -> Surface {
        let threads = self.threads.clamp(1, 4096).next_multiple_of(2);
        let noise = Noise::new(self.seed);
        let base_color = paint("cloth", self.size, |at| {
            let (height, thread) = weave(at, threads);
            let own = noise.cell(thread[0], thread[1]) - 0.5;
            let wear = noise.fractal(at, 4, 4);
            // Between the threads little light comes back.
            let light = (0.55 + 0.45 * height) * (1.0 + 0.2 * own + 0.12 * wear);
            (self.stripe(at.x) * light).clamp(Vec3::ZERO, Vec3::ONE)
        });
        let normal = normal_map("cloth normals", self.size, |at| {
            self.depth * weave(at, threads).0
        });
        Surface { base_color, normal }
    }

    fn stripe(&self, x: f32) -> Vec3 {
        let width = self.stripe_width.clamp(0.0, 1.0);
        // Distance from the middle of the stripe, in pattern widths.
        let from_middle = ((x * self.stripes as f32).fract() - 0.5).abs();
        if self.stripes == 0 || from_middle > 0.5 * width {
            self.colors[0]
        } else if from_middle > width / 3.0 {
            self.colors[2]
        } else {
            self.colors[1]
        }
    }
}

/// Height, 0 to 1, of the upper thread at a place, and a number for the thread.
fn weave(at: Vec2, threads: u32) -> (f32, [u32; 2]) {
    let place = at * threads as f32;
    let cell = place.floor();
    let across = place - cell;
    let even = (cell.x as u32 + cell.y as u32).is_multiple_of(2);
    // A thread is round across and rises over its neighbour along.
    let (round, along, line, way) = if even {
        (across.y, across.x, cell.y as u32, 0)
    } else {
        (across.x, across.y, cell.x as u32, 1)
    };
    let height = (PI * round).sin() * (0.75 - 0.25 * (TAU * along).cos());
    (height, [line, way])
}
