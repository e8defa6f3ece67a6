//! What a study says, over all of its points.

use super::{Statement, Topic, list, pictures, speed, summarize};
use crate::report::analysis::Analysis;
use crate::report::format::significant;
use crate::report::lines::{Line, crossings, lines, name};
use crate::study::Study;

/// Points that are spoken of one by one.
const SPOKEN: usize = 4;

/// Says what a study found. The first statement is about speed. A study of one point reads as that
/// comparison does.
pub fn summarize_study(study: &Study, analyses: &[Analysis]) -> Vec<Statement> {
    let mut statements = match (study.points.as_slice(), analyses) {
        ([], _) | (_, []) => vec![Statement {
            topic: Topic::Speed,
            text: "No point of the study was measured to its end.".into(),
        }],
        ([point], [analysis]) => summarize(&point.comparison, analysis),
        _ => several(study, analyses),
    };
    let cautions = unfinished(study).into_iter().chain(cut(study));
    statements.extend(cautions.map(|text| Statement {
        topic: Topic::Caution,
        text,
    }));
    statements
}

fn several(study: &Study, analyses: &[Analysis]) -> Vec<Statement> {
    let mut said = vec![(Topic::Speed, tally(study, analyses))];
    for index in spoken(study) {
        let point = &study.points[index];
        let text = speed::say(&point.comparison, &analyses[index]);
        said.push((Topic::Speed, format!("At {}: {text}", name(study, point))));
    }
    for line in lines(study) {
        said.extend(
            crossed(study, analyses, &line)
                .into_iter()
                .map(|text| (Topic::Speed, text)),
        );
    }
    if let Some(index) = most_different(study) {
        let point = &study.points[index];
        let at = name(study, point);
        let texts = pictures::say(&point.comparison).into_iter();
        said.push((
            Topic::Pictures,
            format!(
                "The pictures differ most at {at}. {}",
                texts.collect::<Vec<_>>().join(" ")
            ),
        ));
    } else {
        // Where no picture differs, the first point says why.
        let texts = pictures::say(&study.points[0].comparison).into_iter();
        said.extend(texts.map(|text| {
            let at = name(study, &study.points[0]);
            (Topic::Pictures, format!("At {at}: {text}"))
        }));
    }
    said.extend(others(study, analyses));
    said.into_iter()
        .map(|(topic, text)| Statement { topic, text })
        .collect()
}

/// How many points which pipeline wins. Only wins that the intervals support are counted.
fn tally(study: &Study, analyses: &[Analysis]) -> String {
    let mut wins: Vec<(&str, usize)> = Vec::new();
    let (mut open, mut without, mut alone) = (0, 0, 0);
    for (point, analysis) in study.points.iter().zip(analyses) {
        let pipelines = &point.comparison.pipelines;
        let leaders = analysis.leaders();
        match leaders.as_slice() {
            _ if pipelines.len() < 2 => alone += 1,
            [] => without += 1,
            // Alone with times is no win over others that have none.
            [_] if analysis.order.len() < pipelines.len() => open += 1,
            [winner] => {
                let name = pipelines[*winner].name.as_str();
                match wins.iter_mut().find(|(n, _)| *n == name) {
                    Some((_, count)) => *count += 1,
                    None => wins.push((name, 1)),
                }
            }
            _ => open += 1,
        }
    }
    let points = study.points.len();
    if alone == points {
        return format!(
            "Only one pipeline was measured at each of {points} points, so there is nothing to \
             compare it with."
        );
    }
    wins.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let of = |count: usize| match count == points {
        true => format!("all {points} points"),
        false => format!("{count} of {points} points"),
    };
    let mut parts: Vec<String> = wins
        .iter()
        .map(|(name, count)| format!("{} is the fastest at {}", label_of(study, name), of(*count)))
        .collect();
    if open > 0 {
        parts.push(format!(
            "at {} no single pipeline is shown to be the fastest",
            of(open)
        ));
    }
    if without > 0 {
        parts.push(format!(
            "{} have no times common to all pipelines",
            of(without)
        ));
    }
    if alone > 0 {
        parts.push(format!("{} have one pipeline alone", of(alone)));
    }
    let mut text = parts.join("; ");
    if let Some(first) = text.get_mut(0..1) {
        first.make_ascii_uppercase();
    }
    text + "."
}

/// The points that are spoken of: all of a few, else the ends of the axes.
fn spoken(study: &Study) -> Vec<usize> {
    if study.points.len() <= SPOKEN {
        return (0..study.points.len()).collect();
    }
    let mut ends: Vec<usize> = lines(study)
        .iter()
        .flat_map(|line| [line.points.first(), line.points.last()])
        .flatten()
        .map(|(_, index)| *index)
        .collect();
    if ends.is_empty() {
        ends = vec![0, study.points.len() - 1];
    }
    ends.sort_unstable();
    ends.dedup();
    ends.truncate(2 * SPOKEN);
    ends
}

/// One sentence a crossing.
fn crossed(study: &Study, analyses: &[Analysis], line: &Line) -> Vec<String> {
    let found = crossings(study, analyses, line);
    let place = line.place();
    let at = if place.is_empty() {
        String::new()
    } else {
        format!("At {place}: ")
    };
    let mut said: Vec<String> = found
        .iter()
        .take(SPOKEN)
        .map(|c| {
            format!(
                "{at}{} is faster than {} at {} {}, and slower at {}; the medians meet near {}.",
                label_of(study, &c.before),
                label_of(study, &c.after),
                line.unit(),
                c.between[0],
                c.between[1],
                significant(c.near)
            )
        })
        .collect();
    if found.len() > SPOKEN {
        said.push(format!(
            "{at}{} more pairs of curves cross; they are listed below the curves.",
            found.len() - SPOKEN
        ));
    }
    said
}

/// The point at which a picture differs most from the reference's.
fn most_different(study: &Study) -> Option<usize> {
    let largest = |index: &usize| {
        let pipelines = &study.points[*index].comparison.pipelines;
        let means = pipelines
            .iter()
            .filter_map(|p| Some(p.difference.as_ref()?.flip.mean));
        means.fold(0.0, f64::max)
    };
    (0..study.points.len())
        .filter(|index| largest(index) > 0.0)
        .max_by(|a, b| largest(a).total_cmp(&largest(b)))
}

/// Memory of the last point, and the cautions of all, each said once with the points it is about.
fn others(study: &Study, analyses: &[Analysis]) -> Vec<(Topic, String)> {
    let mut said: Vec<(Topic, String, Vec<String>)> = Vec::new();
    for (index, (point, analysis)) in study.points.iter().zip(analyses).enumerate() {
        let last = index + 1 == study.points.len();
        for statement in summarize(&point.comparison, analysis) {
            let wanted = match statement.topic {
                Topic::Memory => last,
                Topic::Caution => true,
                Topic::Speed | Topic::Pictures => false,
            };
            if !wanted {
                continue;
            }
            let at = name(study, point);
            match said.iter_mut().find(|(_, text, _)| *text == statement.text) {
                Some((_, _, points)) => points.push(at),
                None => said.push((statement.topic, statement.text, vec![at])),
            }
        }
    }
    said.into_iter()
        .map(
            |(topic, text, points)| match points.len() == study.points.len() {
                true => (topic, text),
                false => (topic, format!("At {}: {text}", list(&points))),
            },
        )
        .collect()
}

fn unfinished(study: &Study) -> Option<String> {
    (!study.missing.is_empty()).then(|| {
        let some: Vec<&str> = study
            .missing
            .iter()
            .take(SPOKEN)
            .map(String::as_str)
            .collect();
        let more = study.missing.len() - some.len();
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        format!(
            "{} of {} points are not measured to their end: {}{more}. Nothing is said of them.",
            study.missing.len(),
            study.missing.len() + study.points.len(),
            some.join("; ")
        )
    })
}

/// Pipelines whose frames were cut short, with the points.
fn cut(study: &Study) -> Option<String> {
    let mut cut: Vec<String> = Vec::new();
    for point in &study.points {
        let pipelines = point.comparison.pipelines.iter();
        let names: Vec<&str> = pipelines.filter(|p| p.cut).map(|p| p.label()).collect();
        if names.is_empty() {
            continue;
        }
        let place = name(study, point);
        cut.push(match place.is_empty() {
            true => list(&names),
            false => format!("{} at {place}", list(&names)),
        });
    }
    (!cut.is_empty()).then(|| {
        format!(
            "The time for a point was up before all frames were measured: {}. Their intervals are \
             wider for it.",
            cut.join("; ")
        )
    })
}

/// The name for people of a pipeline.
pub(crate) fn label_of(study: &Study, name: &str) -> String {
    let mut pipelines = study.points.iter().flat_map(|p| &p.comparison.pipelines);
    let found = pipelines.find(|p| p.name == name);
    found.map_or_else(|| name.to_owned(), |p| p.label().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::analysis::of_study;
    use crate::report::sample;

    fn said(study: &Study, topic: Topic) -> String {
        let all = summarize_study(study, &of_study(study)).into_iter();
        let of: Vec<String> = all.filter(|s| s.topic == topic).map(|s| s.text).collect();
        of.join(" | ")
    }

    #[test]
    fn wins_ends_and_the_crossing_are_said() {
        let study = sample::study(&[16, 64, 256], |lights| [10.0, 0.1 * lights]);
        let text = said(&study, Topic::Speed);
        assert!(
            text.starts_with(
                "Forward single pass is the fastest at 2 of 3 points; \
                 Deferred shading is the fastest at 1 of 3 points."
            ),
            "{text}"
        );
        assert!(
            text.contains("At lights = 16: Forward single pass is"),
            "{text}"
        );
        assert!(
            text.contains("is faster than Deferred shading at lights 64, and slower at 256"),
            "{text}"
        );
    }

    #[test]
    fn nothing_is_claimed_where_nothing_is_decided() {
        let study = sample::study(&[16, 64], |_| [10.0, 10.3]);
        let text = said(&study, Topic::Speed);
        assert!(
            text.starts_with("At all 2 points no single pipeline is shown to be the fastest."),
            "{text}"
        );
        assert!(!text.contains("faster than"), "{text}");
    }

    #[test]
    fn one_pipeline_no_times_and_no_points() {
        let mut study = sample::study(&[16, 64], |_| [10.0, 20.0]);
        for point in &mut study.points {
            point.comparison.pipelines.truncate(1);
        }
        assert!(said(&study, Topic::Speed).starts_with("Only one pipeline was measured"));

        let mut study = sample::study(&[16, 64], |_| [10.0, 20.0]);
        for point in &mut study.points {
            for p in &mut point.comparison.pipelines {
                p.frame_gpu_ms = None;
                p.frame_cpu_ms = vec![];
            }
        }
        let text = said(&study, Topic::Speed);
        assert!(text.starts_with("All 2 points have no times"), "{text}");
        assert!(said(&study, Topic::Caution).contains("GPU times are missing"));

        study.missing = vec!["a".into()];
        study.points.clear();
        assert!(said(&study, Topic::Speed).starts_with("No point of the study"));
        assert!(said(&study, Topic::Caution).contains("1 of 1 points"));
    }

    #[test]
    fn what_was_cut_short_is_named_with_its_point() {
        let mut study = sample::study(&[16, 64], |_| [10.0, 20.0]);
        study.points[1].comparison.pipelines[0].cut = true;
        let text = said(&study, Topic::Caution);
        assert!(text.contains("Deferred shading at lights = 64"), "{text}");
    }
}
