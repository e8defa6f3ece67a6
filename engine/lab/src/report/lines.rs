//! The points of a study as lines over one axis, and where two pipelines' curves cross.

use super::analysis::{Analysis, Verdict};
use super::model::Parameter;
use crate::study::{Point, SIZE, Study};

/// Points that differ in one axis with numbers for values.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The axis.
    pub axis: String,
    /// What the points have in common.
    pub fixed: Vec<Parameter>,
    /// The value and the index of each point, in ascending order of the value.
    pub points: Vec<(f64, usize)>,
}

impl Line {
    /// What the points have in common, in words; empty where that is nothing that varies.
    pub fn place(&self) -> String {
        in_words(&self.fixed)
    }

    /// What goes to the right.
    pub fn unit(&self) -> String {
        match self.axis == SIZE {
            true => "pixels of the picture".into(),
            false => self.axis.clone(),
        }
    }
}

/// The lines of a study: for each axis whose values are numbers, one a combination of the others.
pub fn lines(study: &Study) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for axis in &study.plan.axes {
        let first = lines.len();
        for (index, point) in study.points.iter().enumerate() {
            let found = point.coordinates.iter().find(|c| c.name == axis.name);
            let Some(value) = found.and_then(|c| number(&axis.name, &c.value)) else {
                continue;
            };
            let others = point.coordinates.iter().filter(|c| c.name != axis.name);
            let fixed: Vec<Parameter> = others.cloned().collect();
            match lines[first..].iter_mut().find(|line| line.fixed == fixed) {
                Some(line) => line.points.push((value, index)),
                None => lines.push(Line {
                    axis: axis.name.clone(),
                    fixed,
                    points: vec![(value, index)],
                }),
            }
        }
    }
    for line in &mut lines {
        line.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        line.points.dedup_by(|a, b| a.0 == b.0);
    }
    lines.retain(|line| line.points.len() > 1);
    // What all points of the study share needs no words.
    for line in &mut lines {
        line.fixed.retain(|c| varies(study, &c.name));
    }
    lines
}

/// The number that a value of an axis stands for; of a size, its pixels.
fn number(axis: &str, text: &str) -> Option<f64> {
    let value: f64 = match axis {
        SIZE => {
            let (width, height) = text.split_once('x')?;
            width.trim().parse::<f64>().ok()? * height.trim().parse::<f64>().ok()?
        }
        _ => text.trim().parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// Whether the points differ in a coordinate.
fn varies(study: &Study, name: &str) -> bool {
    let value = |point: &Point| {
        let found = point.coordinates.iter().find(|c| c.name == name);
        found.map(|c| c.value.clone())
    };
    let mut values = study.points.iter().map(value);
    let first = values.next();
    values.any(|value| Some(value) != first)
}

/// A point in words, by the coordinates in which the points differ: `lights = 64`.
pub fn name(study: &Study, point: &Point) -> String {
    let varying = point
        .coordinates
        .iter()
        .filter(|c| varies(study, &c.name))
        .cloned();
    in_words(&varying.collect::<Vec<_>>())
}

fn in_words(coordinates: &[Parameter]) -> String {
    let parts: Vec<String> = coordinates
        .iter()
        .map(|c| format!("{} = {}", c.name, c.value))
        .collect();
    parts.join(", ")
}

/// Where the faster one of two pipelines becomes the slower one.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// Name of the pipeline that is faster at smaller values.
    pub before: String,
    /// Name of the pipeline that is faster at larger values.
    pub after: String,
    /// The last value at which `before` is faster, and the first at which `after` is; the intervals
    /// support both.
    pub between: [f64; 2],
    /// Where straight lines between the medians of neighbouring points cross.
    pub near: f64,
}

/// The crossings on a line. Only such are found whose both sides the intervals support.
pub fn crossings(study: &Study, analyses: &[Analysis], line: &Line) -> Vec<Crossing> {
    let Some(first) = line.points.first() else {
        return Vec::new();
    };
    let pipelines = &study.points[first.1].comparison.pipelines;
    let names: Vec<&str> = pipelines.iter().map(|p| p.name.as_str()).collect();
    let mut found = Vec::new();
    for (i, a) in names.iter().enumerate() {
        for b in &names[i + 1..] {
            pair(study, analyses, line, [a, b], &mut found);
        }
    }
    found.sort_by(|a, b| a.between[0].total_cmp(&b.between[0]));
    found
}

fn pair(
    study: &Study,
    analyses: &[Analysis],
    line: &Line,
    names: [&str; 2],
    out: &mut Vec<Crossing>,
) {
    // The last point at which one is faster for certain, and whether it is the first of the two.
    let mut last: Option<(usize, bool)> = None;
    for (at, (_, index)) in line.points.iter().enumerate() {
        let Some(faster) = first_is_faster(study, analyses, *index, names) else {
            continue;
        };
        if let Some((from, was)) = last
            && was != faster
        {
            let [before, after] = if was { names } else { [names[1], names[0]] };
            out.push(Crossing {
                before: before.into(),
                after: after.into(),
                between: [line.points[from].0, line.points[at].0],
                near: meeting(study, analyses, &line.points[from..=at], names),
            });
        }
        last = Some((at, faster));
    }
}

/// Whether the first of two pipelines is faster at a point, where the intervals say so.
fn first_is_faster(
    study: &Study,
    analyses: &[Analysis],
    point: usize,
    names: [&str; 2],
) -> Option<bool> {
    let analysis = analyses.get(point)?;
    let pipelines = &study.points[point].comparison.pipelines;
    let place = |name: &str| pipelines.iter().position(|p| p.name == name);
    let (a, b) = (place(names[0])?, place(names[1])?);
    let fastest = analysis.order.first().copied();
    // Against the baseline a ratio is that of the other; against the fastest, that of the fastest.
    let (ratio, of_first) = if analysis.baseline == b {
        (analysis.against_baseline[a], true)
    } else if analysis.baseline == a {
        (analysis.against_baseline[b], false)
    } else if fastest == Some(a) {
        (analysis.against_fastest[b], true)
    } else if fastest == Some(b) {
        (analysis.against_fastest[a], false)
    } else {
        return None;
    };
    match ratio?.verdict {
        Verdict::Faster => Some(of_first),
        Verdict::Slower => Some(!of_first),
        Verdict::Same | Verdict::Undecided | Verdict::TooFew => None,
    }
}

/// Where the medians of two pipelines meet, on straight lines between points; on logarithmic axes
/// where all values are positive.
fn meeting(study: &Study, analyses: &[Analysis], points: &[(f64, usize)], names: [&str; 2]) -> f64 {
    let logarithmic = points.iter().all(|(value, _)| *value > 0.0);
    let place = |value: f64| if logarithmic { value.ln() } else { value };
    let back = |value: f64| if logarithmic { value.exp() } else { value };
    let gap = |index: usize| {
        let pipelines = &study.points[index].comparison.pipelines;
        let time = |name: &str| {
            let at = pipelines.iter().position(|p| p.name == name)?;
            Some(analyses[index].times[at]?.median)
        };
        Some((time(names[0])? / time(names[1])?).ln())
    };
    let known: Vec<(f64, f64)> = points
        .iter()
        .filter_map(|(value, index)| Some((place(*value), gap(*index)?)))
        .collect();
    let meets = known.windows(2).find_map(|two| {
        let [(x0, g0), (x1, g1)] = *two else {
            return None;
        };
        (g0 * g1 <= 0.0 && g0 != g1).then(|| x0 + (x1 - x0) * g0 / (g0 - g1))
    });
    meets.map_or(f64::NAN, back)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::analysis::of_study;
    use crate::report::sample;

    #[test]
    fn curves_cross_where_two_power_laws_are_equal() {
        // 10 ms against 0.1 ms · lights: equal at 100 lights, both straight on logarithmic axes.
        let study = sample::study(&[16, 64, 256, 1024], |lights| [10.0, 0.1 * lights]);
        let analyses = of_study(&study);
        let lines = lines(&study);
        assert_eq!(lines.len(), 1);
        assert_eq!(
            (lines[0].axis.as_str(), lines[0].place()),
            ("lights", String::new())
        );
        let found = crossings(&study, &analyses, &lines[0]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].between, [64.0, 256.0]);
        assert!((found[0].near - 100.0).abs() < 2.0, "{}", found[0].near);
        assert_eq!(found[0].before, "forward_single_pass");
    }

    #[test]
    fn an_undecided_side_is_no_crossing() {
        let study = sample::study(&[16, 64, 256], |lights| {
            [10.0, if lights < 100.0 { 5.0 } else { 10.01 }]
        });
        let found = crossings(&study, &of_study(&study), &lines(&study)[0]);
        assert!(found.is_empty(), "{found:?}");
    }

    #[test]
    fn sizes_are_numbers_of_pixels_and_words_are_none() {
        assert_eq!(number(SIZE, "640x360"), Some(230_400.0));
        assert_eq!(number("lights", " 64 "), Some(64.0));
        assert_eq!(number("quality", "high"), None);
    }
}
