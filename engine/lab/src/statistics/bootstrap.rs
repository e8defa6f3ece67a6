//! Intervals by resampling.

use super::{Interval, median, quantile, sorted};

/// How a bootstrap is run. The same input gives the same interval on every machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bootstrap {
    /// Confidence level, 0 to 1.
    pub level: f64,
    /// Number of resamples.
    pub resamples: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for Bootstrap {
    fn default() -> Self {
        Self {
            level: 0.95,
            resamples: 2000,
            seed: 0x1234_5678,
        }
    }
}

/// Percentile-bootstrap interval of median(a) / median(b).
///
/// Neighbouring frames are not independent, so whole runs of ⌈n^(1/3)⌉ consecutive samples are
/// drawn (circular block bootstrap: D. N. Politis and J. P. Romano, 1992). `None` if either series
/// has fewer than six finite values, or if a median is not positive.
pub fn ratio_of_medians(a: &[f64], b: &[f64], options: Bootstrap) -> Option<Interval> {
    let finite = |samples: &[f64]| -> Vec<f64> {
        samples.iter().copied().filter(|v| v.is_finite()).collect()
    };
    let (a, b) = (finite(a), finite(b));
    if a.len() < 6 || b.len() < 6 || median(&a)? <= 0.0 || median(&b)? <= 0.0 {
        return None;
    }
    let mut random = SplitMix(options.seed);
    let mut scratch = Vec::new();
    let ratios: Vec<f64> = (0..options.resamples.max(1))
        .map(|_| {
            let top = resampled_median(&a, &mut random, &mut scratch);
            top / resampled_median(&b, &mut random, &mut scratch)
        })
        .collect();
    let ratios = sorted(&ratios);
    let tail = (1.0 - options.level) / 2.0;
    Some(Interval {
        low: quantile(&ratios, tail)?,
        high: quantile(&ratios, 1.0 - tail)?,
        level: options.level,
    })
}

fn resampled_median(samples: &[f64], random: &mut SplitMix, scratch: &mut Vec<f64>) -> f64 {
    let n = samples.len();
    let block = (n as f64).cbrt().ceil() as usize;
    scratch.clear();
    while scratch.len() < n {
        let start = random.below(n);
        let wanted = block.min(n - scratch.len());
        scratch.extend((0..wanted).map(|i| samples[(start + i) % n]));
    }
    let (below, &mut upper, _) = scratch.select_nth_unstable_by(n / 2, f64::total_cmp);
    if n % 2 == 1 {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (lower + upper)
}

/// The generator SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, 2014). A report must be the same
/// after any update of a crate, so the few lines are kept here.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number below `n`. The high bits of a product are uniform up to n / 2⁶⁴.
    fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.next()) * n as u128) >> 64) as usize
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn generator_is_the_published_one() {
        // First outputs of SplitMix64 for the seed 1234567, as in the reference code's test.
        let mut random = SplitMix(1_234_567);
        let found: Vec<u64> = (0..3).map(|_| random.next()).collect();
        assert_eq!(
            found,
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423
            ]
        );
    }

    #[test]
    fn constant_series_have_an_exact_ratio() {
        let i = ratio_of_medians(&[6.0; 40], &[2.0; 33], Bootstrap::default()).unwrap();
        assert_eq!((i.low, i.high), (3.0, 3.0));
    }

    #[test]
    fn interval_covers_the_true_ratio_about_as_often_as_stated() {
        // 300 pairs of independent uniform series with the true ratio of medians 1.5.
        let mut random = SplitMix(7);
        let mut series = |scale: f64| -> Vec<f64> {
            (0..60)
                .map(|_| scale * (0.8 + 0.4 * random.below(1 << 30) as f64 / (1 << 30) as f64))
                .collect()
        };
        let options = Bootstrap {
            resamples: 400,
            ..Bootstrap::default()
        };
        let covered = (0..300)
            .filter(|_| {
                let (a, b) = (series(1.5), series(1.0));
                ratio_of_medians(&a, &b, options).unwrap().contains(1.5)
            })
            .count();
        // Four standard deviations of B(300, 0.95) around 285 are ± 15; the percentile interval
        // of a median is known to be a little conservative.
        assert!((270..=300).contains(&covered), "{covered}");
    }

    #[test]
    fn same_seed_same_interval_and_too_little_gives_none() {
        let a: Vec<f64> = (0..50).map(|i| 10.0 + f64::from(i % 7)).collect();
        let b: Vec<f64> = (0..50).map(|i| 5.0 + f64::from(i % 5)).collect();
        let options = Bootstrap::default();
        assert_eq!(
            ratio_of_medians(&a, &b, options),
            ratio_of_medians(&a, &b, options)
        );
        assert_eq!(ratio_of_medians(&a[..5], &b, options), None);
        assert_eq!(ratio_of_medians(&a, &[0.0; 50], options), None);
    }
}
