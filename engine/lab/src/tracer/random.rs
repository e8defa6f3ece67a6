//! Random numbers that depend on nothing but seed, pixel and sample.

use rand_pcg::Pcg32;
use rand_pcg::rand_core::RngCore;

/// The random numbers of one path.
#[derive(Clone, Debug)]
pub struct Random(Pcg32);

impl Random {
    /// Those of a sample of a pixel. Each has a generator of its own, so that the order in which
    /// threads take pixels changes nothing.
    pub fn of_sample(seed: u64, pixel: u64, sample: u64) -> Self {
        let place = mix(seed ^ mix(pixel));
        Self(Pcg32::new(mix(place ^ sample), place))
    }

    /// Evenly from 0 up to, but not including, 1.
    pub fn number(&mut self) -> f64 {
        f64::from(self.0.next_u32()) * (-32.0_f64).exp2()
    }

    /// Two such numbers.
    pub fn pair(&mut self) -> [f64; 2] {
        [self.number(), self.number()]
    }
}

/// Spreads the bits of a number (the finaliser of SplitMix64, Steele, Lea and Flood 2014, "Fast
/// Splittable Pseudorandom Number Generators").
fn mix(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_repeatable_and_unlike_their_neighbours() {
        let first = |seed, pixel, sample| Random::of_sample(seed, pixel, sample).number();
        assert_eq!(first(1, 2, 3), first(1, 2, 3));
        let others = [
            first(2, 2, 3),
            first(1, 3, 3),
            first(1, 2, 4),
            first(2, 1, 3),
        ];
        assert!(others.iter().all(|&other| other != first(1, 2, 3)));
    }

    /// The mean of n even numbers has a standard deviation of √(1/12n).
    #[test]
    fn first_numbers_are_even_over_samples_and_over_pixels() {
        let count = 100_000_u64;
        let bound = 4.0 / (12.0 * count as f64).sqrt();
        for mean in [
            (0..count)
                .map(|n| Random::of_sample(7, 5, n).number())
                .sum::<f64>(),
            (0..count)
                .map(|n| Random::of_sample(7, n, 0).number())
                .sum::<f64>(),
        ] {
            assert!((mean / count as f64 - 0.5).abs() < bound, "{mean}");
        }
    }
}
