//! Where and how much the pictures differ.

use super::list;
use crate::diff::{LdrDifference, number, percent};
use crate::report::model::{Comparison, PipelineResult};
use crate::study::TRACED;

/// At most this many pipelines are spoken of one by one.
const SPOKEN: usize = 4;

/// The statements on pictures.
pub fn say(c: &Comparison) -> Vec<String> {
    let compared = c.pipelines.iter().any(|p| p.difference.is_some());
    let reference = match c.reference_result() {
        Some(reference) => reference.label(),
        None if c.reference == TRACED && compared => "the path tracer",
        None => {
            return vec![format!(
                "The reference {} was not measured, so no pictures are compared.",
                c.reference
            )];
        }
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
            reference
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
            reference
        ));
        differing = ends.to_vec();
    }
    said.extend(differing.iter().map(|(p, d)| picture(p, reference, d)));
    said
}

fn picture(pipeline: &PipelineResult, reference: &str, d: &LdrDifference) -> String {
    format!(
        "The picture of {} differs from that of {} by FLIP {} in the mean (99th percentile {}, \
         maximum {}); {} of the pixels are above {}. {}",
        pipeline.label(),
        reference,
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
pub(super) fn place(d: &LdrDifference) -> String {
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
