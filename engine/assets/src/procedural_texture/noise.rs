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
        self.wrapped(place - place.floor(), cells.max(1))
    }

    /// As [`Noise::at`], at a place that is 0 to 1 already.
    fn wrapped(self, place: Vec2, cells: u32) -> f32 {
        let place = place * cells as f32;
        // Casts, because rounding down is a call of a function on the oldest
        // processors that the compiler must serve. Rounding up may have put a
        // place of nearly 1 on the far edge.
        let (x, y) = (
            (place.x as u32).min(cells - 1),
            (place.y as u32).min(cells - 1),
        );
        let next = |line: u32| if line + 1 == cells { 0 } else { line + 1 };
        let in_cell = place - Vec2::new(x as f32, y as f32);
        let slope =
            |row: u32, x: u32, from: Vec2| gradient(pcg(x.wrapping_add(row))).dot(in_cell - from);
        let fade = in_cell * in_cell * in_cell * (in_cell * (in_cell * 6.0 - 15.0) + 10.0);
        let (top, bottom) = (self.row(y), self.row(next(y)));
        let (left, right) = (x, next(x));
        let above = lerp(
            slope(top, left, Vec2::ZERO),
            slope(top, right, Vec2::X),
            fade.x,
        );
        let below = lerp(
            slope(bottom, left, Vec2::Y),
            slope(bottom, right, Vec2::ONE),
            fade.x,
        );
        // The greatest value of the sum with unit gradients is sqrt(1/2).
        lerp(above, below, fade.y) * std::f32::consts::SQRT_2
    }

    /// A sum of `octaves` noises, each of half the size and half the height of
    /// the one before, brought back to about −1 to 1.
    #[must_use]
    pub fn fractal(self, place: Vec2, cells: u32, octaves: u32) -> f32 {
        let place = place - place.floor();
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
            sum += weight * layer.wrapped(place, cells);
            total += weight;
            weight *= 0.5;
        }
        if total > 0.0 { sum / total } else { 0.0 }
    }

    /// A number of 0 to 1 for a lattice cell, the same for the whole cell.
    #[must_use]
    pub fn cell(self, x: u32, y: u32) -> f32 {
        (pcg(x.wrapping_add(self.row(y))) >> 8) as f32 / (1 << 24) as f32
    }

    /// The part of a lattice point's hash that its row decides.
    fn row(self, y: u32) -> u32 {
        pcg(y.wrapping_add(pcg(self.seed)))
    }
}

/// PCG as a hash (Jarzynski and Olano, "Hash functions for GPU rendering",
/// JCGT 2020). Nested over several inputs it has no visible pattern.
fn pcg(input: u32) -> u32 {
    let state = input.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// One of sixteen unit vectors, by the highest bits of a hash. A table, for a
/// branch on random bits is guessed wrong every other time.
fn gradient(hash: u32) -> Vec2 {
    const C: f32 = 0.923_879_5;
    const S: f32 = 0.382_683_43;
    const D: f32 = std::f32::consts::FRAC_1_SQRT_2;
    #[rustfmt::skip]
    const DIRECTIONS: [[f32; 2]; 16] = [
        [1.0, 0.0], [C, S], [D, D], [S, C], [0.0, 1.0], [-S, C], [-D, D], [-C, S],
        [-1.0, 0.0], [-C, -S], [-D, -D], [-S, -C], [0.0, -1.0], [S, -C], [D, -D], [C, -S],
    ];
    Vec2::from_array(DIRECTIONS[(hash >> 28) as usize])
}

fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}
