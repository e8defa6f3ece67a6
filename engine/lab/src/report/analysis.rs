//! What the numbers of a comparison allow to be said about speed.
//!
//! Two pipelines are compared inside of each process, which drew them in turn, and the ratios of at
//! least five fresh processes give an interval. A pair is ranked where that interval, corrected for
//! all pairs, lies beyond ± 5 %.

use super::model::{Comparison, PipelineResult};
use crate::statistics::{CONFIDENCE, Interval, ProcessRatio, Summary, holm, median};
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
    /// The interval of the ratio reaches over the margin.
    Undecided,
    /// Fewer than five processes, or no times at all.
    TooFew,
}

/// The speed of `a` relative to `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// How many times as fast `a` is: the geometric mean over the processes of median(b) / median(a).
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
    /// Each pipeline against each other, `None` against itself: how many times as fast the first is.
    pub ratios: Vec<Vec<Option<Ratio>>>,
    /// The strictest level of a ratio's interval, so that all pairs together hold with 95 % (Holm).
    pub ratio_level: f64,
}

/// Analyses every point of a study. The correction is for all pairs of all points together.
pub fn of_study(study: &Study) -> Vec<Analysis> {
    let comparisons: Vec<&Comparison> = study.points.iter().map(|p| &p.comparison).collect();
    of_points(&comparisons)
}

fn of_points(points: &[&Comparison]) -> Vec<Analysis> {
    let clocks: Vec<Clock> = points
        .iter()
        .map(|point| choose_clock(&point.pipelines))
        .collect();
    // Any pair may end up in a sentence, so every interval is corrected for all of them.
    let mut pairs = Vec::new();
    for (point, clock) in points.iter().zip(&clocks) {
        let count = point.pipelines.len();
        for (a, b) in (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))) {
            let speeds = speeds(&point.pipelines[a], &point.pipelines[b], *clock);
            pairs.push(ProcessRatio::of(&speeds));
        }
    }
    let known: Vec<ProcessRatio> = pairs.iter().flatten().copied().collect();
    let doubts: Vec<f64> = known.iter().map(|pair| pair.doubt(MARGIN)).collect();
    let levels = holm(&doubts, CONFIDENCE);
    let ratio_level = levels.iter().copied().fold(CONFIDENCE, f64::max);
    let mut levels = levels.into_iter();
    let mut decided = pairs.into_iter().map(|pair| {
        let pair = pair?;
        let interval = pair.interval(levels.next().unwrap_or(ratio_level));
        Some(Ratio {
            speed: pair.ratio(),
            interval: Some(interval),
            verdict: decide(interval),
        })
    });
    let mut analyses = Vec::new();
    for (point, clock) in points.iter().zip(clocks) {
        let count = point.pipelines.len();
        let mut ratios = vec![vec![None; count]; count];
        for (a, b) in (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))) {
            let ratio = decided.next().flatten();
            let ratio = ratio
                .unwrap_or_else(|| undecidable(&point.pipelines[a], &point.pipelines[b], clock));
            ratios[a][b] = Some(ratio);
            ratios[b][a] = Some(ratio.inverse());
        }
        analyses.push(Analysis::with(point, clock, ratios, ratio_level));
    }
    analyses
}

/// How many times as fast `a` is as `b`, in each process that measured both. Of a pipeline that was
/// cut short, the same moments of the other count.
fn speeds(a: &PipelineResult, b: &PipelineResult, clock: Clock) -> Vec<f64> {
    let (a, b) = (
        a.by_process(samples(a, clock)),
        b.by_process(samples(b, clock)),
    );
    let speed = |(a, b): (&[f64], &[f64])| {
        let both = a.len().min(b.len());
        Some(median(&b[..both])? / median(&a[..both])?)
    };
    a.into_iter()
        .zip(b)
        .map(|pair| speed(pair).unwrap_or(f64::NAN))
        .collect()
}

/// The ratio of two medians of which too few processes tell.
fn undecidable(a: &PipelineResult, b: &PipelineResult, clock: Clock) -> Ratio {
    let [a, b] = [a, b].map(|p| median(samples(p, clock)).unwrap_or(f64::NAN));
    Ratio {
        speed: b / a,
        interval: None,
        verdict: Verdict::TooFew,
    }
}

impl Ratio {
    /// The speed of the second relative to the first.
    fn inverse(self) -> Self {
        Self {
            speed: 1.0 / self.speed,
            interval: self.interval.map(|interval| Interval {
                low: 1.0 / interval.high,
                high: 1.0 / interval.low,
                level: interval.level,
            }),
            verdict: match self.verdict {
                Verdict::Faster => Verdict::Slower,
                Verdict::Slower => Verdict::Faster,
                same => same,
            },
        }
    }
}

impl Analysis {
    /// Analyses the frame times of one point alone.
    pub fn of(comparison: &Comparison) -> Self {
        let found = of_points(&[comparison]).pop();
        found.unwrap_or_else(|| Self::with(comparison, Clock::Missing, Vec::new(), CONFIDENCE))
    }

    fn with(
        comparison: &Comparison,
        clock: Clock,
        ratios: Vec<Vec<Option<Ratio>>>,
        ratio_level: f64,
    ) -> Self {
        let pipelines = &comparison.pipelines;
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
        let against = |from: Option<usize>, to: usize| {
            let row = ratios.get(from?)?;
            row.get(to).copied().flatten()
        };
        let all = 0..pipelines.len();
        Self {
            clock,
            baseline,
            against_baseline: all.clone().map(|i| against(Some(i), baseline)).collect(),
            against_fastest: all.map(|i| against(order.first().copied(), i)).collect(),
            times,
            order,
            ratios,
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

/// The decision table.
fn decide(speed: Interval) -> Verdict {
    let (fast, slow) = (1.0 + MARGIN, 1.0 / (1.0 + MARGIN));
    if speed.low >= slow && speed.high <= fast {
        Verdict::Same
    } else if speed.low > fast {
        Verdict::Faster
    } else if speed.high < slow {
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
        for (low, high, verdict) in [
            (1.2, 1.4, Faster),
            (1.04, 1.4, Undecided),
            (0.7, 0.8, Slower),
            (0.9, 1.1, Undecided),
            (0.98, 1.02, Same),
            (1.01, 1.03, Same),
            (1.0, 1.0, Same),
        ] {
            let level = 0.95;
            assert_eq!(
                decide(Interval { low, high, level }),
                verdict,
                "{low} {high}"
            );
        }
    }

    /// A pipeline that takes so long in each of the processes, with two frames in each.
    fn pipeline(name: &str, times: &[f64]) -> PipelineResult {
        let frames: Vec<f64> = times.iter().flat_map(|ms| [*ms, *ms * 1.001]).collect();
        PipelineResult {
            name: name.into(),
            frame_cpu_ms: frames.clone(),
            frame_gpu_ms: Some(frames),
            process_frames: vec![2; times.len()],
            ..PipelineResult::default()
        }
    }

    fn verdicts(pipelines: Vec<PipelineResult>) -> Vec<Option<Verdict>> {
        let analysis = Analysis::of(&crate::report::sample::with(pipelines));
        let ratios = analysis.against_baseline.iter();
        ratios
            .map(|ratio| ratio.map(|ratio| ratio.verdict))
            .collect()
    }

    #[test]
    fn processes_decide_and_not_frames() {
        let base = [10.0, 10.1, 9.9, 10.05, 10.0];
        let twice = [20.3, 19.9, 20.0, 20.2, 20.1];
        let wild = [11.0, 18.0, 9.0, 25.0, 12.0];
        let found = verdicts(vec![
            pipeline("base", &base),
            pipeline("twice", &twice),
            pipeline("wild", &wild),
            pipeline("same", &base),
        ]);
        use Verdict::{Same, Slower, Undecided};
        assert_eq!(found, [None, Some(Slower), Some(Undecided), Some(Same)]);
        // The same numbers from fewer processes say nothing.
        let few = verdicts(vec![
            pipeline("base", &base[..4]),
            pipeline("twice", &twice[..4]),
        ]);
        assert_eq!(few, [None, Some(Verdict::TooFew)]);
    }

    /// What slows a process slows all of its pipelines, and cancels.
    #[test]
    fn ratios_are_formed_inside_of_processes() {
        let drift = [1.0, 1.3, 0.8, 1.6, 1.1];
        let found = verdicts(vec![
            pipeline("base", &drift.map(|d| 10.0 * d)),
            pipeline("slower", &drift.map(|d| 12.0 * d)),
        ]);
        assert_eq!(found[1], Some(Verdict::Slower));
    }

    /// A pipeline that had time for two of six moments is compared at these.
    #[test]
    fn moments_that_both_measured_are_compared() {
        let times = |frames: usize| {
            let moments: Vec<f64> = (0..frames).map(|i| 10.0 + 4.0 * i as f64).collect();
            PipelineResult {
                frame_gpu_ms: Some(moments.repeat(5)),
                frame_cpu_ms: vec![1.0; 5 * frames],
                process_frames: vec![frames as u32; 5],
                ..PipelineResult::default()
            }
        };
        let name = |name: &str, result: PipelineResult| PipelineResult {
            name: name.into(),
            ..result
        };
        let found = verdicts(vec![name("long", times(6)), name("cut", times(2))]);
        assert_eq!(found[1], Some(Verdict::Same));
    }

    #[test]
    fn more_points_make_claims_harder() {
        let times = [10.0, 10.3, 9.8, 10.2, 9.9];
        let slower = [11.2, 11.1, 11.4, 11.0, 11.3];
        let point =
            || crate::report::sample::with(vec![pipeline("a", &times), pipeline("b", &slower)]);
        let verdict = |analysis: &Analysis| analysis.against_baseline[1].map(|ratio| ratio.verdict);
        let points: Vec<Comparison> = (0..200).map(|_| point()).collect();
        let refs: Vec<&Comparison> = points.iter().collect();
        let alone = verdict(&Analysis::of(&points[0]));
        let among = of_points(&refs);
        assert_eq!(alone, Some(Verdict::Slower));
        assert_eq!(verdict(&among[0]), Some(Verdict::Undecided));
        assert!(among[0].ratio_level > 0.999);
    }
}
