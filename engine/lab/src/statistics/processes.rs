//! Ratios over fresh processes, and how many of them may be believed at once.
//!
//! Frames of one process share its memory layout and its moment of the machine, so that more of them
//! make an interval narrower without making it truer (T. Kalibera and R. Jones 2013, "Rigorous
//! Benchmarking in Reasonable Time", section 4). Each process therefore gives one value alone.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::Interval;

/// The least number of processes from which anything is concluded.
pub const LEAST_PROCESSES: usize = 5;

/// The ratio of two times, one value a process, with what scatters between processes.
///
/// Ratios multiply, so their logarithms are averaged: the geometric mean of a / b is the inverse of
/// that of b / a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessRatio {
    /// Mean of the logarithms.
    mean: f64,
    /// Standard error of that mean.
    error: f64,
    /// Processes less one.
    freedom: f64,
}

impl ProcessRatio {
    /// From one ratio a process; `None` below [`LEAST_PROCESSES`] positive ones.
    pub fn of(ratios: &[f64]) -> Option<Self> {
        let logs: Vec<f64> = ratios
            .iter()
            .filter(|ratio| ratio.is_finite() && **ratio > 0.0)
            .map(|ratio| ratio.ln())
            .collect();
        let count = logs.len() as f64;
        if logs.len() < LEAST_PROCESSES {
            return None;
        }
        let mean = logs.iter().sum::<f64>() / count;
        let squares: f64 = logs.iter().map(|log| (log - mean).powi(2)).sum();
        Some(Self {
            mean,
            error: (squares / (count - 1.0) / count).sqrt(),
            freedom: count - 1.0,
        })
    }

    /// The ratio of two series that were measured apart, one time a process in each: a / b. Their
    /// scatter may differ (B. L. Welch 1947, "The Generalization of Student's Problem when Several
    /// Different Population Variances are Involved"). `None` below [`LEAST_PROCESSES`] in either.
    pub fn between(a: &[f64], b: &[f64]) -> Option<Self> {
        let (a, b) = (Self::of(a)?, Self::of(b)?);
        let (in_a, in_b) = (a.error.powi(2), b.error.powi(2));
        let both = in_a + in_b;
        let freedom = both.powi(2) / (in_a.powi(2) / a.freedom + in_b.powi(2) / b.freedom);
        Some(Self {
            mean: a.mean - b.mean,
            error: both.sqrt(),
            // Without any scatter the formula divides nothing by nothing.
            freedom: if freedom.is_finite() {
                freedom
            } else {
                a.freedom
            },
        })
    }

    /// The geometric mean.
    pub fn ratio(&self) -> f64 {
        self.mean.exp()
    }

    /// Student's interval of the ratio (W. S. Gosset 1908, "The Probable Error of a Mean").
    pub fn interval(&self, level: f64) -> Interval {
        let reach = self.student().map_or(f64::INFINITY, |student| {
            student.inverse_cdf(0.5 + 0.5 * level.clamp(0.0, 1.0 - 1e-12))
        });
        // Without scatter the interval is a point, however sure it has to be.
        let half = if self.error > 0.0 {
            reach * self.error
        } else {
            0.0
        };
        Interval {
            low: (self.mean - half).exp(),
            high: (self.mean + half).exp(),
            level,
        }
    }

    /// One less the highest level at which the interval lies outside of 1 / (1 + `margin`) to
    /// 1 + `margin`: small where the ratio is certainly beyond them.
    pub fn doubt(&self, margin: f64) -> f64 {
        let beyond = self.mean.abs() - margin.ln_1p();
        if beyond <= 0.0 {
            return 1.0;
        }
        if self.error <= 0.0 {
            return 0.0;
        }
        let tail = |student: StudentsT| 2.0 * student.sf(beyond / self.error);
        self.student().map_or(1.0, tail)
    }

    fn student(&self) -> Option<StudentsT> {
        StudentsT::new(0.0, 1.0, self.freedom).ok()
    }
}

/// The level at which each of several intervals has to be looked at, so that with 95 % (or whatever
/// `level` says) none of them misleads (S. Holm 1979, "A Simple Sequentially Rejective Multiple Test
/// Procedure"): the surest at 1 − α/m, the next at 1 − α/(m − 1), and so on, until one does not hold
/// there. Those after it are looked at as it was.
pub fn holm(doubts: &[f64], level: f64) -> Vec<f64> {
    let alpha = 1.0 - level;
    let mut order: Vec<usize> = (0..doubts.len()).collect();
    order.sort_by(|a, b| doubts[*a].total_cmp(&doubts[*b]));
    let mut levels = vec![level; doubts.len()];
    let mut share = alpha;
    let mut open = true;
    for (rank, index) in order.into_iter().enumerate() {
        if open {
            share = alpha / (doubts.len() - rank) as f64;
            open = doubts[index] <= share;
        }
        levels[index] = 1.0 - share;
    }
    levels
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn intervals_are_those_of_students_table() {
        // Logarithms −2, −1, 0, 1, 2: mean 0, deviation √2.5, error √0.5. The table has 2.776445
        // for 95 % and 4.604095 for 99 % at four degrees of freedom.
        let ratios = [-2.0_f64, -1.0, 0.0, 1.0, 2.0].map(f64::exp);
        let found = ProcessRatio::of(&ratios).unwrap();
        assert!((found.ratio() - 1.0).abs() < 1e-12);
        for (level, table) in [(0.95, 2.776_445), (0.99, 4.604_095)] {
            let interval = found.interval(level);
            let reach = interval.high.ln() / 0.5_f64.sqrt();
            assert!((reach - table).abs() < 1e-5, "{reach}");
            assert!((interval.low * interval.high - 1.0).abs() < 1e-9);
        }
        assert!(ProcessRatio::of(&ratios[..4]).is_none());
        assert!(ProcessRatio::of(&[1.0, 1.0, f64::NAN, 1.0, 1.0]).is_none());
    }

    #[test]
    fn doubt_is_the_level_at_which_the_interval_reaches_the_margin() {
        let ratios = [1.28, 1.33, 1.31, 1.30, 1.29, 1.35];
        let found = ProcessRatio::of(&ratios).unwrap();
        let doubt = found.doubt(0.05);
        assert!((found.interval(1.0 - doubt).low - 1.05).abs() < 1e-9);
        // The inverse ratio is as certain.
        let inverse = ProcessRatio::of(&ratios.map(|ratio| 1.0 / ratio)).unwrap();
        assert!((inverse.doubt(0.05) - doubt).abs() < 1e-12);
        assert_eq!(ProcessRatio::of(&[1.01; 5]).unwrap().doubt(0.05), 1.0);
        assert_eq!(ProcessRatio::of(&[2.0; 5]).unwrap().doubt(0.05), 0.0);
    }

    #[test]
    fn series_that_were_measured_apart() {
        // Of equal size and scatter: the error is √2 of each, with twice the degrees of freedom.
        let a = [-2.0_f64, -1.0, 0.0, 1.0, 2.0].map(f64::exp);
        let found = ProcessRatio::between(&a.map(|x| 3.0 * x), &a).unwrap();
        assert!((found.ratio() - 3.0).abs() < 1e-12);
        assert!((found.error - 1.0).abs() < 1e-12 && (found.freedom - 8.0).abs() < 1e-9);
        // Where one hardly scatters, the other's degrees of freedom are left.
        let calm = [1.0, 1.0 + 1e-9, 1.0, 1.0 - 1e-9, 1.0, 1.0, 1.0];
        let found = ProcessRatio::between(&a, &calm).unwrap();
        assert!((found.freedom - 4.0).abs() < 1e-6, "{}", found.freedom);
        assert!(ProcessRatio::between(&a, &calm[..4]).is_none());
        assert_eq!(
            ProcessRatio::between(&[2.0; 5], &[1.0; 5])
                .unwrap()
                .doubt(0.05),
            0.0
        );
    }

    #[test]
    fn holm_as_in_the_literature() {
        // α = 0.05 of four: 0.005 ≤ 0.0125, 0.01 ≤ 0.0167, 0.03 > 0.025, and so 0.04 neither.
        let levels = holm(&[0.01, 0.04, 0.03, 0.005], 0.95);
        let expected = [0.05 / 3.0, 0.05 / 2.0, 0.05 / 2.0, 0.05 / 4.0];
        for (found, share) in levels.iter().zip(expected) {
            assert!((1.0 - found - share).abs() < 1e-12, "{levels:?}");
        }
        assert!(holm(&[], 0.95).is_empty());
    }

    /// Where nothing differs by more than the margin, a family of intervals misleads in one of twenty
    /// studies at the most.
    #[test]
    fn false_claims_are_as_rare_as_promised() {
        use rand_pcg::rand_core::{RngCore as _, SeedableRng as _};
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(7);
        let mut uniform = || (random.next_u64() >> 11) as f64 * 2.0_f64.powi(-53);
        let (studies, pairs) = (2000, 20);
        let mut misled = 0;
        for _ in 0..studies {
            // Every true ratio lies on the margin, which is the hardest case.
            let mut ratios = Vec::new();
            for _ in 0..pairs {
                let sample: Vec<f64> = (0..5)
                    .map(|_| {
                        let normal: f64 = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                        1.05 * (0.02 * normal).exp()
                    })
                    .collect();
                ratios.push(ProcessRatio::of(&sample).unwrap());
            }
            let doubts: Vec<f64> = ratios.iter().map(|ratio| ratio.doubt(0.05)).collect();
            let levels = holm(&doubts, 0.95);
            misled += u32::from(
                doubts
                    .iter()
                    .zip(&levels)
                    .any(|(doubt, level)| *doubt <= 1.0 - level),
            );
        }
        let share = f64::from(misled) / f64::from(studies);
        // One side alone can mislead here, so half of 5 %, give or take four standard errors.
        assert!((0.011..0.039).contains(&share), "{share}");
    }
}
