//! How the values of an error map are distributed.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::plane::Plane;

/// FLIP above which a pixel counts as differing unless the caller says otherwise. One 8-bit step
/// over a whole picture gives about 0.04; 0.1 is seen at once when the pictures alternate.
pub const DEFAULT_BOUND: f64 = 0.1;

/// Number of bins of [`MapStatistics::histogram`].
pub const HISTOGRAM_BINS: usize = 50;

/// What a report says of an error map with values in 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapStatistics {
    /// Mean over all pixels.
    pub mean: f64,
    /// Smallest value.
    pub min: f64,
    /// Median pixel.
    pub p50: f64,
    /// 95th percentile.
    pub p95: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest value.
    pub max: f64,
    /// Percentiles 25, 50 and 75 weighted by the error itself: the typical error of the
    /// erroneous part, which a large equal background does not dilute.
    pub weighted_quartiles: [f64; 3],
    /// The bound of `share_over_bound`.
    pub bound: f64,
    /// Share of the pixels with a value above the bound, 0 to 1.
    pub share_over_bound: f64,
    /// Counts in [`HISTOGRAM_BINS`] bins of equal width over 0 to 1.
    pub histogram: Vec<u64>,
}

impl MapStatistics {
    /// Pools a map. Values outside 0 to 1 are counted in the nearest bin.
    pub fn of(map: &Plane, bound: f64) -> Self {
        let mut sorted = map.values.clone();
        sorted.par_sort_unstable_by(f32::total_cmp);
        let at = |p: f64| f64::from(percentile(&sorted, p).unwrap_or(0.0));
        let weighted = |p: f64| f64::from(weighted_percentile(&sorted, p).unwrap_or(0.0));
        let over = sorted.len() - sorted.partition_point(|v| *v <= bound as f32);
        let mut histogram = vec![0; HISTOGRAM_BINS];
        for value in &sorted {
            let bin = (value * HISTOGRAM_BINS as f32) as usize;
            histogram[bin.min(HISTOGRAM_BINS - 1)] += 1;
        }
        Self {
            mean: map.mean(),
            min: at(0.0),
            p50: at(50.0),
            p95: at(95.0),
            p99: at(99.0),
            max: at(100.0),
            weighted_quartiles: [25.0, 50.0, 75.0].map(weighted),
            bound,
            share_over_bound: over as f64 / sorted.len().max(1) as f64,
            histogram,
        }
    }
}

/// The smallest of the sorted values that at least `percent` % of them don't exceed (nearest
/// rank). `None` for an empty slice; `percent` is clamped to 0 to 100.
pub fn percentile(sorted: &[f32], percent: f64) -> Option<f32> {
    let rank = (percent.clamp(0.0, 100.0) / 100.0 * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.saturating_sub(1)).copied()
}

/// The smallest value such that the values up to it hold at least `percent` % of the sum of all.
/// `None` for an empty slice; `percent` is clamped to 0 to 100.
pub fn weighted_percentile(sorted: &[f32], percent: f64) -> Option<f32> {
    let total: f64 = sorted.iter().map(|&v| f64::from(v)).sum();
    let target = percent.clamp(0.0, 100.0) / 100.0 * total;
    let mut sum = 0.0;
    for &value in sorted {
        sum += f64::from(value);
        if sum >= target {
            return Some(value);
        }
    }
    sorted.last().copied()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn percentiles_by_hand() {
        let values = [0.0, 0.1, 0.2, 0.3, 0.4];
        for (percent, expected) in [
            (0.0, 0.0),
            (20.0, 0.0),
            (20.1, 0.1),
            (50.0, 0.2),
            (99.0, 0.4),
            (100.0, 0.4),
        ] {
            assert_eq!(percentile(&values, percent), Some(expected), "{percent}");
        }
        // The sum is 2: up to 1/8 it is 6.25 %, up to 1/4 18.75 %, up to 1/2 43.75 %.
        let values = [0.0, 0.125, 0.25, 0.5, 1.125];
        for (percent, expected) in [(6.25, 0.125), (6.3, 0.25), (25.0, 0.5), (50.0, 1.125)] {
            assert_eq!(
                weighted_percentile(&values, percent),
                Some(expected),
                "{percent}"
            );
        }
        assert_eq!(percentile(&[], 50.0), None);
        assert_eq!(weighted_percentile(&[], 50.0), None);
    }

    #[test]
    fn statistics_of_a_small_map() {
        let map = Plane {
            width: 5,
            height: 2,
            values: vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.5, 0.99, 1.0],
        };
        let s = MapStatistics::of(&map, 0.1);
        assert!((s.mean - 0.259).abs() < 1e-7);
        assert_eq!((s.min, s.p50, s.max), (0.0, 0.0, 1.0));
        assert_eq!(s.share_over_bound, 0.3);
        assert_eq!(s.histogram.iter().sum::<u64>(), 10);
        assert_eq!((s.histogram[0], s.histogram[5], s.histogram[49]), (6, 1, 2));
    }
}
