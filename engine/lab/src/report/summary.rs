//! The summary in words, from a decision table over the numbers.
//!
//! Every sentence is either a count of something measured, or a claim that [`Analysis`] allows.

mod pictures;
mod speed;
mod study;

pub use speed::clock_name;
pub(crate) use study::label_of;
pub use study::summarize_study;

use super::analysis::{Analysis, Clock};
use super::format::{bytes, significant};
use super::model::{Comparison, PipelineResult};

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
    let mut statements = vec![say(Topic::Speed)(speed::say(comparison, analysis))];
    statements.extend(
        pictures::say(comparison)
            .into_iter()
            .map(say(Topic::Pictures)),
    );
    statements.extend(memory(comparison).into_iter().map(say(Topic::Memory)));
    statements.extend(
        cautions(comparison, analysis)
            .into_iter()
            .map(say(Topic::Caution)),
    );
    statements
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
