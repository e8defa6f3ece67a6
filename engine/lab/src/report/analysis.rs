//! What the numbers of a comparison allow to be said about speed.

use super::model::{Comparison, PipelineResult};
use crate::statistics::{Bootstrap, CONFIDENCE, Interval, Summary, ratio_of_medians};
use crate::study::Study;

/// Times within this share of each other count as the same.
pub const MARGIN: f64 = 0.05;

/// The clock that a comparison of speed rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// GPU time of the frame, present for every pipeline.
    Gpu,
    /// CPU time of the frame, because some GPU time is missing.
    Cpu,
    /// No clock has times of every pipeline.
    Missing,
}

/// How one pipeline's time stands to another's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Faster by more than the margin, and the intervals support it.
    Faster,
    /// Slower by more than the margin, and the intervals support it.
    Slower,
    /// The same within the margin, and the interval supports it.
    Same,
    /// The interval of the ratio reaches over the margin, or the medians' intervals overlap.
    Undecided,
    /// Fewer than six frames, or no times at all.
    TooFew,
}

/// The speed of `a` relative to `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// median(b) / median(a): how many times as fast `a` is.
    pub speed: f64,
    /// Interval of `speed`.
    pub interval: Option<Interval>,
    /// What may be said.
    pub verdict: Verdict,
}

/// Speeds of all pipelines on the chosen clock. Indices are those of the pipelines.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// The clock used.
    pub clock: Clock,
    /// Summary of each pipeline's frame times on that clock.
    pub times: Vec<Option<Summary>>,
    /// The pipeline that ratios are formed with: the reference, or the first.
    pub baseline: usize,
    /// Each pipeline against the baseline; `None` for the baseline.
    pub against_baseline: Vec<Option<Ratio>>,
    /// The pipelines with the smallest median first; empty without times.
    pub order: Vec<usize>,
    /// The fastest against each other pipeline; `None` for the fastest.
    pub against_fastest: Vec<Option<Ratio>>,
    /// Confidence level of each ratio's interval: 95 % for all pairs together (Bonferroni).
    pub ratio_level: f64,
}

/// Analyses every point of a study. The corrections are for all pairs of all points together.
pub fn of_study(study: &Study) -> Vec<Analysis> {
    let points = study.points.iter();
    points
        .map(|point| Analysis::of(&point.comparison))
        .collect()
}

impl Analysis {
    /// Analyses the frame times.
    pub fn of(comparison: &Comparison) -> Self {
        let pipelines = &comparison.pipelines;
        let clock = choose_clock(pipelines);
        let times: Vec<_> = pipelines
            .iter()
            .map(|p| Summary::of(samples(p, clock)))
            .collect();
        let baseline = pipelines
            .iter()
            .position(|p| p.name == comparison.reference)
            .unwrap_or_default();
        let mut order: Vec<usize> = (0..pipelines.len())
            .filter(|i| times[*i].is_some())
            .collect();
        let median = |i: usize| times[i].map_or(f64::INFINITY, |t| t.median);
        order.sort_by(|a, b| median(*a).total_cmp(&median(*b)));

        // Any pair may end up in a sentence, so every interval is corrected for all of them.
        let pairs = (pipelines.len() * pipelines.len().saturating_sub(1) / 2).max(1);
        let ratio_level = 1.0 - (1.0 - CONFIDENCE) / pairs as f64;
        let compare = |a: usize, b: usize| {
            let series = [samples(&pipelines[a], clock), samples(&pipelines[b], clock)];
            ratio(series, [times[a], times[b]], ratio_level)
        };
        let against_baseline = (0..pipelines.len())
            .map(|i| (i != baseline).then(|| compare(i, baseline)))
            .collect();
        let against_fastest = (0..pipelines.len())
            .map(|i| {
                order
                    .first()
                    .filter(|f| **f != i)
                    .map(|fastest| compare(*fastest, i))
            })
            .collect();
        Self {
            clock,
            times,
            baseline,
            against_baseline,
            order,
            against_fastest,
            ratio_level,
        }
    }

    /// The fastest pipeline and those that the data don't show to be slower.
    pub fn leaders(&self) -> Vec<usize> {
        let behind = |i: &usize| {
            self.against_fastest[*i].is_some_and(|ratio| ratio.verdict == Verdict::Faster)
        };
        self.order.iter().copied().filter(|i| !behind(i)).collect()
    }
}

/// The frame times of a pipeline on a clock.
pub fn samples(pipeline: &PipelineResult, clock: Clock) -> &[f64] {
    match clock {
        Clock::Gpu => pipeline.gpu_samples().unwrap_or_default(),
        Clock::Cpu => &pipeline.frame_cpu_ms,
        Clock::Missing => &[],
    }
}

fn choose_clock(pipelines: &[PipelineResult]) -> Clock {
    if pipelines.is_empty() {
        Clock::Missing
    } else if pipelines.iter().all(|p| p.gpu_samples().is_some()) {
        Clock::Gpu
    } else if pipelines
        .iter()
        .all(|p| p.frame_cpu_ms.iter().any(|v| v.is_finite()))
    {
        Clock::Cpu
    } else {
        Clock::Missing
    }
}

fn ratio([a, b]: [&[f64]; 2], times: [Option<Summary>; 2], level: f64) -> Ratio {
    let [Some(time_a), Some(time_b)] = times else {
        return Ratio {
            speed: f64::NAN,
            interval: None,
            verdict: Verdict::TooFew,
        };
    };
    let speed = time_b.median / time_a.median;
    // At least ten resamples beyond each end of the interval.
    let resamples = (20.0 / (1.0 - level)).clamp(2000.0, 100_000.0) as u32;
    let options = Bootstrap {
        level,
        resamples,
        ..Bootstrap::default()
    };
    let Some(interval) = ratio_of_medians(b, a, options) else {
        return Ratio {
            speed,
            interval: None,
            verdict: Verdict::TooFew,
        };
    };
    let medians = [time_a.median_interval, time_b.median_interval];
    let apart = matches!(medians, [Some(a), Some(b)] if !a.overlaps(&b));
    Ratio {
        speed,
        interval: Some(interval),
        verdict: decide(interval, apart),
    }
}

/// The decision table. `apart` says whether the intervals of the two medians are disjoint.
fn decide(speed: Interval, apart: bool) -> Verdict {
    let (fast, slow) = (1.0 + MARGIN, 1.0 / (1.0 + MARGIN));
    if speed.low >= slow && speed.high <= fast {
        Verdict::Same
    } else if apart && speed.low > fast {
        Verdict::Faster
    } else if apart && speed.high < slow {
        Verdict::Slower
    } else {
        Verdict::Undecided
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decision_table() {
        use Verdict::{Faster, Same, Slower, Undecided};
        for (low, high, apart, verdict) in [
            (1.2, 1.4, true, Faster),
            (1.2, 1.4, false, Undecided),
            (1.04, 1.4, true, Undecided),
            (0.7, 0.8, true, Slower),
            (0.7, 0.8, false, Undecided),
            (0.9, 1.1, true, Undecided),
            (0.9, 1.1, false, Undecided),
            (0.98, 1.02, false, Same),
            (1.01, 1.03, true, Same),
            (1.0, 1.0, false, Same),
        ] {
            let found = decide(
                Interval {
                    low,
                    high,
                    level: 0.95,
                },
                apart,
            );
            assert_eq!(found, verdict, "{low} {high} {apart}");
        }
    }
}
