//! The summary in words, from a decision table over the numbers.
//!
//! Every sentence is either a count of something measured, or a claim that [`Analysis`] allows.

use super::analysis::{Analysis, Clock, MARGIN, Ratio, Verdict};
use super::format::{bytes, milliseconds, significant};
use super::model::{Comparison, PipelineResult};
use crate::diff::{LdrDifference, number, percent};

/// What a sentence is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topic {
    /// Which pipeline is faster, and by how much. The first sentence of every summary.
    Speed,
    /// Where and how much the pictures differ.
    Pictures,
    /// What the targets take.
    Memory,
    /// What limits the other sentences.
    Caution,
}

/// A sentence or two on one topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// What it is about.
    pub topic: Topic,
    /// Plain text.
    pub text: String,
}

/// Says what was found. The first statement is about speed.
pub fn summarize(comparison: &Comparison, analysis: &Analysis) -> Vec<Statement> {
    let say = |topic| move |text| Statement { topic, text };
    let mut statements = vec![say(Topic::Speed)(speed(comparison, analysis))];
    statements.extend(pictures(comparison).into_iter().map(say(Topic::Pictures)));
    statements.extend(memory(comparison).into_iter().map(say(Topic::Memory)));
    statements.extend(
        cautions(comparison, analysis)
            .into_iter()
            .map(say(Topic::Caution)),
    );
    statements
}

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

fn speed(c: &Comparison, analysis: &Analysis) -> String {
    let clock = clock_name(c, analysis.clock);
    let label = |i: usize| c.pipelines[i].label();
    match (c.pipelines.len(), analysis.order.as_slice()) {
        (0, _) => "No pipeline was measured.".into(),
        (1, [only]) => format!(
            "Only {} was measured, so there is nothing to compare it with: a frame takes {}.",
            label(*only),
            time(analysis, *only, clock)
        ),
        (_, []) => {
            "No frame times are common to all pipelines, so none can be called faster.".into()
        }
        (_, [fastest, next, ..]) => {
            let leaders = analysis.leaders();
            if leaders.len() > 1 {
                return tie(c, analysis, &leaders, clock);
            }
            let ratio = analysis.against_fastest[*next];
            let rank = match c.pipelines.len() {
                2 => String::new(),
                n => format!("the fastest of {n} pipelines and "),
            };
            format!(
                "{} is {rank}{} as {}: a frame takes {}, against {}.",
                label(*fastest),
                ratio.map_or_else(String::new, times_as_fast),
                label(*next),
                time(analysis, *fastest, clock),
                milliseconds(median(analysis, *next)),
            )
        }
        (_, [only]) => format!(
            "{} alone has times: {}.",
            label(*only),
            time(analysis, *only, clock)
        ),
    }
}

/// The fastest pipelines can't be told apart: are they the same, or is it undecided?
fn tie(c: &Comparison, analysis: &Analysis, leaders: &[usize], clock: &str) -> String {
    let names = list(leaders.iter().map(|i| c.pipelines[*i].label()));
    let medians = list(leaders.iter().map(|i| milliseconds(median(analysis, *i))));
    let ratios: Vec<Ratio> = leaders
        .iter()
        .filter_map(|i| analysis.against_fastest[*i])
        .collect();
    let of_all = if leaders.len() < c.pipelines.len() {
        format!(
            "Of {} pipelines, {names} are the fastest. ",
            c.pipelines.len()
        )
    } else {
        String::new()
    };
    let behind = analysis.order.iter().find(|i| !leaders.contains(i));
    let next = behind.map_or_else(String::new, |i| {
        let label = c.pipelines[*i].label();
        format!(
            " Next is {label} with {}.",
            milliseconds(median(analysis, *i))
        )
    });
    let which = if of_all.is_empty() {
        names
    } else {
        "They".into()
    };
    if ratios.iter().all(|r| r.verdict == Verdict::Same) {
        return format!(
            "{of_all}{which} take the same time within {:.0} %: {medians} a frame (median {clock}; {}).{next}",
            100.0 * MARGIN,
            intervals(&ratios)
        );
    }
    let open = if of_all.is_empty() {
        format!("The data do not decide which of {which} is the fastest")
    } else {
        "The data do not decide between them".into()
    };
    let too_few = ratios.iter().any(|r| r.verdict == Verdict::TooFew);
    let reason = if too_few {
        "too few frames were measured for an interval; six are the least".into()
    } else {
        intervals(&ratios)
    };
    format!("{of_all}{open}: {reason}. The medians are {medians} ({clock}).{next}")
}

/// "the interval of the ratio is 0.9 to 1.1", for one or several ratios.
fn intervals(ratios: &[Ratio]) -> String {
    let ends = ratios.iter().filter_map(|r| r.interval);
    let texts = ends.map(|i| format!("{} to {}", significant(i.low), significant(i.high)));
    let noun = if ratios.len() == 1 {
        "the interval of the ratio is"
    } else {
        "the intervals of the ratios to the first are"
    };
    format!("{noun} {}", list(texts))
}

fn times_as_fast(ratio: Ratio) -> String {
    let interval = ratio.interval.map_or_else(String::new, |i| {
        format!(
            " (interval {} to {})",
            significant(i.low),
            significant(i.high)
        )
    });
    format!("{} times{interval} as fast", significant(ratio.speed))
}

fn median(analysis: &Analysis, pipeline: usize) -> f64 {
    analysis.times[pipeline].map_or(f64::NAN, |t| t.median)
}

/// "12.3 ms (median GPU time, 95 % interval 12.1 to 12.6)".
fn time(analysis: &Analysis, pipeline: usize, clock: &str) -> String {
    let Some(summary) = analysis.times[pipeline] else {
        return "an unknown time".into();
    };
    let interval = summary.median_interval.map_or_else(
        || format!(", {} frames: too few for an interval", summary.count),
        |i| {
            format!(
                ", 95 % interval {} to {}",
                significant(i.low),
                significant(i.high)
            )
        },
    );
    format!(
        "{} (median {clock}{interval})",
        milliseconds(summary.median)
    )
}

/// At most this many pipelines are spoken of one by one.
const SPOKEN: usize = 4;

fn pictures(c: &Comparison) -> Vec<String> {
    let Some(reference) = c.reference_result() else {
        return vec![format!(
            "The reference {} was not measured, so no pictures are compared.",
            c.reference
        )];
    };
    let others: Vec<&PipelineResult> = c
        .pipelines
        .iter()
        .filter(|p| p.name != c.reference)
        .collect();
    if others.is_empty() {
        return Vec::new();
    }
    let mut said = Vec::new();
    let with = |p: &&PipelineResult| p.difference.as_ref().map(LdrDifference::is_identical);
    let names = |state| {
        let found = others
            .iter()
            .filter(|p| with(p) == state)
            .map(|p| p.label());
        found.collect::<Vec<_>>()
    };
    let (equal, unknown) = (names(Some(true)), names(None));
    if !equal.is_empty() {
        let (noun, verb) = if equal.len() == 1 {
            ("picture", "equals")
        } else {
            ("pictures", "equal")
        };
        said.push(format!(
            "The {noun} of {} {verb} that of {} in every pixel.",
            list(&equal),
            reference.label()
        ));
    }
    if !unknown.is_empty() {
        said.push(format!(
            "The pictures of {} were not compared.",
            list(&unknown)
        ));
    }
    let mut differing: Vec<(&PipelineResult, &LdrDifference)> = others
        .iter()
        .filter_map(|p| Some((*p, p.difference.as_ref().filter(|d| !d.is_identical())?)))
        .collect();
    differing.sort_by(|a, b| a.1.flip.mean.total_cmp(&b.1.flip.mean));
    if differing.len() > SPOKEN {
        let ends = [differing[0], differing[differing.len() - 1]];
        said.push(format!(
            "{} pictures differ from that of {}; the least and the most different are these.",
            differing.len(),
            reference.label()
        ));
        differing = ends.to_vec();
    }
    said.extend(differing.iter().map(|(p, d)| picture(p, reference, d)));
    said
}

fn picture(pipeline: &PipelineResult, reference: &PipelineResult, d: &LdrDifference) -> String {
    format!(
        "The picture of {} differs from that of {} by FLIP {} in the mean (99th percentile {}, \
         maximum {}); {} of the pixels are above {}. {}",
        pipeline.label(),
        reference.label(),
        number(d.flip.mean),
        number(d.flip.p99),
        number(d.flip.max),
        percent(d.flip.share_over_bound),
        number(d.flip.bound),
        place(d)
    )
}

/// Share of the error on edges from which it is said to lie there …
const ON_EDGES: f64 = 0.6;
/// … if that is also this many times what edges would hold by their area alone.
const OVER_CHANCE: f64 = 1.5;
/// Share of the error in one ninth of the picture from which that ninth is named.
const IN_ONE_NINTH: f64 = 0.4;

/// Where the difference lies, in a sentence.
fn place(d: &LdrDifference) -> String {
    let l = &d.location;
    let mut places = Vec::new();
    if l.edge_error >= ON_EDGES && l.edge_error >= OVER_CHANCE * l.edge_area {
        places.push(format!(
            "along edges of the picture ({} of it on {} of the pixels)",
            percent(l.edge_error),
            percent(l.edge_area)
        ));
    }
    let ninths = l.thirds.iter().flatten().copied().enumerate();
    if let Some((ninth, share)) = ninths.max_by(|a, b| a.1.total_cmp(&b.1))
        && share >= IN_ONE_NINTH
    {
        let row = ["top", "middle", "bottom"][ninth / 3];
        let column = ["left", "centre", "right"][ninth % 3];
        places.push(format!(
            "in the {row} {column} of the picture ({} of it)",
            percent(share)
        ));
    }
    if places.is_empty() {
        return "The difference is spread over the picture.".into();
    }
    format!("The difference lies mostly {}.", list(places))
}

fn memory(c: &Comparison) -> Option<String> {
    let pixels = f64::from(c.size[0]) * f64::from(c.size[1]);
    let mut with_targets: Vec<&PipelineResult> = c
        .pipelines
        .iter()
        .filter(|p| !p.targets.is_empty())
        .collect();
    with_targets.sort_by_key(|p| p.target_bytes_total);
    let size = |p: &PipelineResult| {
        let per_pixel = p.target_bytes_total as f64 / pixels;
        format!(
            "{} ({} bytes a pixel)",
            bytes(p.target_bytes_total),
            significant(per_pixel)
        )
    };
    match with_targets.as_slice() {
        [] => None,
        [one] => Some(format!(
            "The targets of {} take {}.",
            one.label(),
            size(one)
        )),
        [least, .., most] if least.target_bytes_total == most.target_bytes_total => Some(format!(
            "The targets of each pipeline take {}.",
            size(least)
        )),
        [least, .., most] => Some(format!(
            "The targets take the least memory in {}, {}, and the most in {}, {}.",
            least.label(),
            size(least),
            most.label(),
            size(most)
        )),
    }
}

/// Median absolute deviation over the median from which a series is called unsteady.
const UNSTEADY: f64 = 0.1;

fn cautions(c: &Comparison, analysis: &Analysis) -> Vec<String> {
    let mut said = Vec::new();
    if c.adapter.software && !c.pipelines.is_empty() {
        said.push(
            "The adapter is a software driver: a processor does the work of a graphics card. The \
             times compare the pipelines on this machine and say nothing about a graphics card."
                .into(),
        );
    }
    let without: Vec<&PipelineResult> = c
        .pipelines
        .iter()
        .filter(|p| p.gpu_samples().is_none())
        .collect();
    if let Some(first) = without.first() {
        let reason = first
            .gpu_why_not
            .as_deref()
            .unwrap_or("no reason was recorded");
        let rest = match analysis.clock {
            Clock::Cpu => " The comparison rests on the CPU times of the frames.",
            _ => "",
        };
        said.push(format!(
            "GPU times are missing for {} ({}).{rest}",
            list(without.iter().map(|p| p.label())),
            reason.trim_end_matches('.')
        ));
    }
    let unsteady: Vec<&str> = c
        .pipelines
        .iter()
        .zip(&analysis.times)
        .filter(|(_, t)| t.is_some_and(|t| t.median_absolute_deviation > UNSTEADY * t.median))
        .map(|(p, _)| p.label())
        .collect();
    if !unsteady.is_empty() {
        said.push(format!(
            "The frame times of {} scatter by more than {:.0} % (median absolute deviation over \
             median): measure again on a quiet machine before you rank them.",
            list(&unsteady),
            100.0 * UNSTEADY
        ));
    }
    said
}

/// "a", "a and b", "a, b and c".
fn list<T: AsRef<str>>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<T> = items.into_iter().collect();
    match items.as_slice() {
        [] => String::new(),
        [one] => one.as_ref().into(),
        [head @ .., last] => {
            let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", head.join(", "), last.as_ref())
        }
    }
}

#[cfg(test)]
mod tests;
