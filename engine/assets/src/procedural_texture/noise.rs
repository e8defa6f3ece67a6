//! Noise that repeats at the edges of the picture.

use glam::Vec2;

/// Gradient noise (Perlin, "Improving noise", SIGGRAPH 2002) on a lattice that
/// repeats, with lattice values from a hash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Noise {
    seed: u32,
}

impl Noise {
    /// A noise of its own for every seed.
    #[must_use]
    pub fn new(seed: u32) -> Self {
        Self { seed }
    }

    /// Noise of about −1 to 1, 0 at every lattice point, at a place in the
    /// picture (0 to 1, repeating) with `cells` lattice cells along each side.
    #[must_use]
    pub fn at(self, place: Vec2, cells: u32) -> f32 {
        let cells = cells.max(1);
        let place = (place - place.floor()) * cells as f32;
        let corner = place.floor();
        let in_cell = place - corner;
        // Rounding can put a place just below 1 on the far edge.
        let (x, y) = (corner.x as u32 % cells, corner.y as u32 % cells);
        let (next_x, next_y) = ((x + 1) % cells, (y + 1) % cells);
        let slope = |x: u32, y: u32, dx: f32, dy: f32| {
            gradient(self.hash(x, y)).dot(in_cell - Vec2::new(dx, dy))
        };
        let fade = in_cell * in_cell * in_cell * (in_cell * (in_cell * 6.0 - 15.0) + 10.0);
        let top = lerp(slope(x, y, 0.0, 0.0), slope(next_x, y, 1.0, 0.0), fade.x);
        let bottom = lerp(
            slope(x, next_y, 0.0, 1.0),
            slope(next_x, next_y, 1.0, 1.0),
            fade.x,
        );
        // The greatest value of the sum with unit gradients is sqrt(1/2).
        lerp(top, bottom, fade.y) * std::f32::consts::SQRT_2
    }

    /// A sum of `octaves` noises, each of half the size and half the height of
    /// the one before, brought back to about −1 to 1.
    #[must_use]
    pub fn fractal(self, place: Vec2, cells: u32, octaves: u32) -> f32 {
        let (mut sum, mut total, mut weight) = (0.0, 0.0, 1.0);
        for octave in 0..octaves.clamp(1, 12) {
            let layer = Self::new(self.seed.wrapping_add(octave.wrapping_mul(0x9e37_79b9)));
            let Some(cells) = cells
                .max(1)
                .checked_shl(octave)
                .filter(|&cells| cells < 1 << 20)
            else {
                break;
            };
            sum += weight * layer.at(place, cells);
            total += weight;
            weight *= 0.5;
        }
        if total > 0.0 { sum / total } else { 0.0 }
    }

    /// A number of 0 to 1 for a lattice cell, the same for the whole cell.
    #[must_use]
    pub fn cell(self, x: u32, y: u32) -> f32 {
        (self.hash(x, y) >> 8) as f32 / (1 << 24) as f32
    }

    /// PCG as a hash (Jarzynski and Olano, "Hash functions for GPU rendering",
    /// JCGT 2020), nested over the inputs.
    fn hash(self, x: u32, y: u32) -> u32 {
        pcg(x.wrapping_add(pcg(y.wrapping_add(pcg(self.seed)))))
    }
}

fn pcg(input: u32) -> u32 {
    let state = input.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// One of sixteen unit vectors.
fn gradient(hash: u32) -> Vec2 {
    const C1: f32 = 0.923_879_5;
    const S1: f32 = 0.382_683_43;
    const D: f32 = std::f32::consts::FRAC_1_SQRT_2;
    const QUARTER: [Vec2; 4] = [
        Vec2::new(1.0, 0.0),
        Vec2::new(C1, S1),
        Vec2::new(D, D),
        Vec2::new(S1, C1),
    ];
    let vector = QUARTER[(hash >> 28 & 3) as usize];
    match hash >> 30 {
        0 => vector,
        1 => vector.perp(),
        2 => -vector,
        _ => -vector.perp(),
    }
}

fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}
