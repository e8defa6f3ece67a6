//! Which pipeline is faster, and by how much.

use super::list;
use crate::report::analysis::{Analysis, Clock, MARGIN, Ratio, Verdict};
use crate::report::format::{milliseconds, significant};
use crate::report::model::Comparison;

/// Name of the clock with the software driver named where it is one.
pub fn clock_name(comparison: &Comparison, clock: Clock) -> &'static str {
    match (clock, comparison.adapter.software) {
        (Clock::Gpu, false) => "GPU time",
        (Clock::Gpu, true) => "GPU time on a software driver",
        (Clock::Cpu, false) => "CPU time",
        (Clock::Cpu, true) => "CPU time on a software driver",
        (Clock::Missing, _) => "time",
    }
}

/// The first statement of every summary.
pub fn say(comparison: &Comparison, analysis: &Analysis) -> String {
    let words = Words {
        comparison,
        analysis,
        clock: clock_name(comparison, analysis.clock),
    };
    let leaders = analysis.leaders();
    match (comparison.pipelines.len(), leaders.as_slice()) {
        (0, _) => "No pipeline was measured.".into(),
        (1, [only]) => format!(
            "Only {} was measured, so there is nothing to compare it with: a frame takes {}.",
            words.label(*only),
            words.time(*only)
        ),
        (_, []) => {
            "No frame times are common to all pipelines, so none can be called faster.".into()
        }
        (_, [winner]) => words.winner(*winner),
        (_, [first, rest @ ..]) => words.tie(*first, rest),
    }
}

/// What the sentences are made from.
struct Words<'a> {
    comparison: &'a Comparison,
    analysis: &'a Analysis,
    clock: &'static str,
}

impl Words<'_> {
    fn label(&self, pipeline: usize) -> &str {
        self.comparison.pipelines[pipeline].label()
    }

    fn labels(&self, pipelines: &[usize]) -> String {
        list(pipelines.iter().map(|i| self.label(*i)))
    }

    fn median(&self, pipeline: usize) -> String {
        milliseconds(self.analysis.times[pipeline].map_or(f64::NAN, |t| t.median))
    }

    /// "12.3 ms (median GPU time, 95 % interval 12.1 to 12.6)".
    fn time(&self, pipeline: usize) -> String {
        let Some(summary) = self.analysis.times[pipeline] else {
            return "an unknown time".into();
        };
        let interval = match summary.median_interval {
            None => format!("{} frames: too few for an interval", summary.count),
            Some(i) => format!("95 % interval {}", ends(i.low, i.high)),
        };
        format!(
            "{} (median {}, {interval})",
            self.median(pipeline),
            self.clock
        )
    }

    /// One pipeline is faster than every other, and the intervals support it.
    fn winner(&self, winner: usize) -> String {
        let Some(&next) = self.analysis.order.get(1) else {
            return format!(
                "{} alone has times: {}.",
                self.label(winner),
                self.time(winner)
            );
        };
        let rank = match self.comparison.pipelines.len() {
            2 => String::new(),
            n => format!("the fastest of {n} pipelines and "),
        };
        let speed = self.analysis.against_fastest[next].map_or_else(String::new, times_as_fast);
        format!(
            "{} is {rank}{speed} as {}: a frame takes {}, against {}.",
            self.label(winner),
            self.label(next),
            self.time(winner),
            self.median(next)
        )
    }

    /// The pipeline with the smallest median is not shown to be faster than `rest`.
    fn tie(&self, first: usize, rest: &[usize]) -> String {
        let with = |verdict: fn(Verdict) -> bool| -> Vec<usize> {
            let ratio = |i: &usize| self.analysis.against_fastest[*i];
            rest.iter()
                .copied()
                .filter(|i| ratio(i).is_some_and(|r| verdict(r.verdict)))
                .collect()
        };
        let same = with(|v| v == Verdict::Same);
        let open = with(|v| v != Verdict::Same && v != Verdict::TooFew);
        let too_few = with(|v| v == Verdict::TooFew);
        let everyone = rest.len() + 1 == self.comparison.pipelines.len();
        let margin = 100.0 * MARGIN;
        let mut said = Vec::new();

        if everyone && same.len() == rest.len() {
            let names = self.labels(&[&[first], rest].concat());
            said.push(format!("{names} take the same time within {margin:.0} %"));
        } else if everyone && open.len() == rest.len() {
            let names = self.labels(&[&[first], rest].concat());
            said.push(format!(
                "The data do not decide which of {names} is the fastest"
            ));
        } else {
            let n = self.comparison.pipelines.len();
            said.push(format!(
                "{} has the smallest median of {n} pipelines",
                self.label(first)
            ));
            if !same.is_empty() {
                let (names, verb) = (
                    self.labels(&same),
                    if same.len() == 1 { "takes" } else { "take" },
                );
                said.push(format!("{names} {verb} the same time within {margin:.0} %"));
            }
            if !open.is_empty() {
                let names = self.labels(&open);
                said.push(format!(
                    "the data do not decide whether it is faster than {names}"
                ));
            }
        }
        if !too_few.is_empty() {
            let names = self.labels(&too_few);
            said.push(format!(
                "too few processes measured for a comparison with {names} (five are the least)"
            ));
        }
        let mut text = said.join("; ");
        text.push_str(". ");
        text.push_str(&self.numbers(first, rest));
        if let Some(next) = self
            .analysis
            .order
            .iter()
            .find(|i| **i != first && !rest.contains(i))
        {
            let (first, next, time) = (self.label(first), self.label(*next), self.median(*next));
            text.push_str(&format!(
                " {first} is faster than the rest, of which {next} is next with {time}."
            ));
        }
        text
    }

    /// "The medians are 10.0 ms and 10.1 ms (GPU time; interval of the ratio 0.98 to 1.03)."
    fn numbers(&self, first: usize, rest: &[usize]) -> String {
        let medians = list([&[first], rest].concat().iter().map(|i| self.median(*i)));
        let intervals: Vec<String> = rest
            .iter()
            .filter_map(|i| self.analysis.against_fastest[*i]?.interval)
            .map(|i| ends(i.low, i.high))
            .collect();
        let noun = match intervals.len() {
            0 => String::new(),
            1 => "; interval of the ratio ".into(),
            _ => "; intervals of the ratios to the first ".into(),
        };
        format!(
            "The medians are {medians} ({}{noun}{}).",
            self.clock,
            list(&intervals)
        )
    }
}

fn ends(low: f64, high: f64) -> String {
    format!("{} to {}", significant(low), significant(high))
}

fn times_as_fast(ratio: Ratio) -> String {
    let interval = ratio.interval.map_or_else(String::new, |i| {
        format!(" (interval {})", ends(i.low, i.high))
    });
    format!("{} times{interval} as fast", significant(ratio.speed))
}
