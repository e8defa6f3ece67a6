//! Robust statistics of timings, without an assumption about their distribution.
//!
//! Frame times have long tails and drift, so the median and order statistics speak for them, and
//! intervals say how far the numbers can be trusted.

mod bootstrap;
mod interval;
mod processes;

pub use bootstrap::{Bootstrap, ratio_of_medians};
pub use interval::median_interval;
pub use processes::{LEAST_PROCESSES, ProcessRatio, holm};

use serde::{Deserialize, Serialize};

/// A range that holds the true value with a stated confidence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Confidence level, 0 to 1; at least the level that was asked for.
    pub level: f64,
}

impl Interval {
    /// Whether a value lies in the interval, ends included.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Whether two intervals share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }
}

/// What a report says of a series of measurements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Number of measurements.
    pub count: usize,
    /// The middle measurement, or the mean of the middle two.
    pub median: f64,
    /// Interval of the median at 95 %, absent below six measurements.
    pub median_interval: Option<Interval>,
    /// 95th percentile, interpolated linearly (type 7 of Hyndman and Fan 1996).
    pub p95: f64,
    /// Arithmetic mean.
    pub mean: f64,
    /// Smallest measurement.
    pub min: f64,
    /// Largest measurement.
    pub max: f64,
    /// Median of the distances from the median, not scaled.
    pub median_absolute_deviation: f64,
}

/// The confidence level of [`Summary::median_interval`].
pub const CONFIDENCE: f64 = 0.95;

impl Summary {
    /// Summarises measurements. Values that are not finite are left out; `None` if none is left.
    pub fn of(samples: &[f64]) -> Option<Self> {
        let sorted = sorted(samples);
        let (&min, &max) = (sorted.first()?, sorted.last()?);
        let median = quantile(&sorted, 0.5)?;
        let distances: Vec<f64> = sorted.iter().map(|v| (v - median).abs()).collect();
        Some(Self {
            count: sorted.len(),
            median,
            median_interval: median_interval(&sorted, CONFIDENCE),
            p95: quantile(&sorted, 0.95)?,
            mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
            min,
            max,
            median_absolute_deviation: self::median(&distances)?,
        })
    }
}

/// The finite values in ascending order.
pub fn sorted(samples: &[f64]) -> Vec<f64> {
    let mut sorted: Vec<f64> = samples.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted
}

/// The median of the finite values, `None` if there is none.
pub fn median(samples: &[f64]) -> Option<f64> {
    quantile(&sorted(samples), 0.5)
}

/// A quantile of sorted values, `q` in 0 to 1, interpolated linearly between the two nearest
/// (type 7 of Hyndman and Fan 1996, as NumPy and R do by default). `None` for an empty slice.
pub fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let position = q.clamp(0.0, 1.0) * sorted.len().checked_sub(1)? as f64;
    let below = position.floor() as usize;
    let low = *sorted.get(below)?;
    let high = sorted.get(below + 1).copied().unwrap_or(low);
    Some(low + (high - low) * (position - below as f64))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn summary_by_hand() {
        let s = Summary::of(&[4.0, 1.0, 3.0, f64::NAN, 2.0, 10.0, f64::INFINITY]).unwrap();
        assert_eq!(
            (s.count, s.median, s.mean, s.min, s.max),
            (5, 3.0, 4.0, 1.0, 10.0)
        );
        // Distances 2, 1, 0, 1, 7.
        assert_eq!(s.median_absolute_deviation, 1.0);
        // Position 3.8 between 4 and 10.
        assert!((s.p95 - 8.8).abs() < 1e-12);
        assert_eq!(s.median_interval, None);
        assert_eq!(Summary::of(&[2.0, 1.0]).unwrap().median, 1.5);
        assert_eq!(Summary::of(&[]), None);
        assert_eq!(Summary::of(&[f64::NAN]), None);
    }

    #[test]
    fn quantiles_at_the_ends() {
        assert_eq!(quantile(&[5.0], 0.95), Some(5.0));
        assert_eq!(quantile(&[1.0, 2.0], 1.0), Some(2.0));
        assert_eq!(quantile(&[1.0, 2.0], 0.25), Some(1.25));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
