//! The top of the page: what was compared, and what came out.

use super::table::{numbers, table, words};
use super::writer::Writer;
use super::{At, median_text, or_dash};
use crate::diff::{number, percent};
use crate::report::analysis::{Ratio, Verdict};
use crate::report::format::{bytes, significant};
use crate::report::model::{Comparison, PipelineResult};
use crate::report::summary::{Statement, Topic, clock_name};
use crate::study::Study;

/// Title and one line of facts.
pub fn header(w: &mut Writer, study: &Study, points: &[At], curves: bool) {
    let title = &study.plan.title;
    w.element("header", &[], |w| {
        w.leaf(
            "p",
            &[("class", "kicker")],
            "Lightbench · comparison of pipelines",
        );
        let title = if title.is_empty() {
            "Comparison"
        } else {
            title
        };
        w.leaf("h1", &[], title);
        if let Some(at) = points.first() {
            let c = at.comparison;
            w.element("p", &[("class", "subject")], |w| {
                for fact in facts(points, c) {
                    w.leaf("span", &[], &fact);
                }
            });
        }
        contents(w, points, curves);
    });
}

/// The line of facts below the title: of the first point, as far as all points share them.
fn facts(points: &[At], c: &Comparison) -> Vec<String> {
    let [width, height] = c.size;
    let software = if c.adapter.software {
        " (software driver)"
    } else {
        ""
    };
    let shared =
        |same: fn(&Comparison, &Comparison) -> bool| points.iter().all(|at| same(at.comparison, c));
    let mut facts = Vec::new();
    if shared(|a, b| a.scene == b.scene) {
        facts.push(format!("Scene {}", c.scene));
    }
    if shared(|a, b| a.size == b.size) {
        facts.push(format!("{width} × {height} pixels"));
    }
    if points.len() > 1 {
        facts.push(format!("{} points", points.len()));
    }
    facts.push(match c.processes.len() {
        0 | 1 => format!("{} frames after {} of warm-up", c.frames, c.warmup_frames),
        several => format!(
            "{} frames after {} of warm-up in each of {several} processes",
            c.frames, c.warmup_frames
        ),
    });
    facts.push(format!("{}{software}", c.adapter.name));
    facts.push(c.created.clone());
    facts.retain(|fact| !fact.is_empty());
    facts
}

fn contents(w: &mut Writer, points: &[At], curves: bool) {
    let first = |name: &str| points.first().map_or_else(|| name.into(), |at| at.id(name));
    w.element("nav", &[("aria-label", "Contents")], |w| {
        let mut link = |id: &str, name: &str| {
            w.leaf("a", &[("href", &format!("#{id}"))], name);
        };
        link("answer", "In short");
        if curves {
            link("curves", "Curves");
        }
        if points.is_empty() {
            return;
        }
        link(&first("pictures"), "Pictures");
        link(&first("times"), "Times");
        if points[0].comparison.pipelines.len() > 1 {
            link(&first("passes"), "Passes side by side");
        }
        if points[0]
            .comparison
            .pipelines
            .iter()
            .any(|p| !p.targets.is_empty())
        {
            link(&first("memory"), "Memory");
        }
        link("again", "Run it again");
        link("reading", "How to read this");
    });
}

/// The summary in words and the key numbers.
pub fn section(w: &mut Writer, study: &Study, points: &[At], statements: &[Statement]) {
    w.element(
        "section",
        &[("id", "answer"), ("aria-labelledby", "answer-h")],
        |w| {
            w.leaf("h2", &[("id", "answer-h")], "In short");
            w.element("div", &[("class", "answer")], |w| {
                for (i, statement) in statements.iter().enumerate() {
                    let class = match (i, statement.topic) {
                        (0, _) => "lead",
                        (_, Topic::Caution) => "caution",
                        _ => "point",
                    };
                    w.element("p", &[("class", class)], |w| {
                        if class == "caution" {
                            w.leaf("strong", &[], "Note. ");
                        }
                        w.text(&statement.text);
                    });
                }
            });
            if points.iter().any(|at| !at.comparison.pipelines.is_empty()) {
                key_table(w, study, points);
            }
        },
    );
}

fn key_table(w: &mut Writer, study: &Study, points: &[At]) {
    let several = points.iter().any(|at| at.comparison.pipelines.len() > 1);
    let many = points.len() > 1;
    let mut columns = vec![words("Pipeline")];
    if many {
        columns.push(words("Point"));
    }
    columns.extend([
        numbers("Frame, median"),
        numbers("95 % interval, ms"),
        numbers("95th percentile"),
    ]);
    if several {
        let first = points[0].comparison;
        let baseline = first.pipelines.get(points[0].analysis.baseline);
        let baseline = baseline.map_or(study.plan.reference.as_str(), |p| p.label());
        columns.extend([
            numbers(&format!("Speed, {baseline} = 1")),
            words("Verdict"),
            numbers("FLIP, mean"),
            numbers("FLIP, 99th pct."),
            numbers("Pixels over bound"),
        ]);
    }
    columns.extend([numbers("Targets"), numbers("Bytes / px")]);
    let mut rows: Vec<Vec<String>> = Vec::new();
    for at in points {
        let (c, analysis) = (at.comparison, at.analysis);
        for (i, p) in c.pipelines.iter().enumerate() {
            let time = analysis.times[i];
            let interval = time.and_then(|t| t.median_interval);
            let cut = if p.cut { " (cut short)" } else { "" };
            let mut row = vec![format!("{}{cut}", p.label())];
            if many {
                // A value stays beside its name.
                row.push(at.words.replace(" = ", "\u{A0}=\u{A0}"));
            }
            row.extend([
                median_text(time.as_ref()),
                or_dash(
                    interval.map(|t| format!("{} – {}", significant(t.low), significant(t.high))),
                ),
                or_dash(time.map(|t| significant(t.p95))),
            ]);
            if several {
                row.extend(speed_cells(analysis.against_baseline[i]));
                row.extend(picture_cells(p, c));
            }
            row.push(bytes(p.target_bytes_total));
            row.push(significant(bytes_a_pixel(p, c)));
            rows.push(row);
        }
    }
    let clock = points
        .first()
        .map_or("time", |at| clock_name(at.comparison, at.analysis.clock));
    let caption = format!("Key numbers. Times are {clock} in milliseconds.");
    table(w, &caption, &columns, &rows);
}

/// Modelled bytes of target memory a pixel of the picture.
pub fn bytes_a_pixel(p: &PipelineResult, c: &Comparison) -> f64 {
    p.target_bytes_total as f64 / (f64::from(c.size[0]) * f64::from(c.size[1]))
}

fn speed_cells(ratio: Option<Ratio>) -> [String; 2] {
    let Some(ratio) = ratio else {
        return ["1".into(), "baseline".into()];
    };
    let verdict = match ratio.verdict {
        Verdict::Faster => "faster",
        Verdict::Slower => "slower",
        Verdict::Same => "the same within 5 %",
        Verdict::Undecided => "undecided",
        Verdict::TooFew if ratio.speed.is_nan() => "no times",
        Verdict::TooFew => "too few processes",
    };
    let speed = match ratio.interval {
        _ if ratio.speed.is_nan() => "–".into(),
        Some(i) => format!(
            "{} ({} – {})",
            significant(ratio.speed),
            significant(i.low),
            significant(i.high)
        ),
        None => significant(ratio.speed),
    };
    [speed, verdict.into()]
}

fn picture_cells(p: &PipelineResult, c: &Comparison) -> [String; 3] {
    if p.name == c.reference {
        return ["reference".into(), "–".into(), "–".into()];
    }
    match &p.difference {
        None => ["–".into(), "–".into(), "–".into()],
        Some(d) => [
            number(d.flip.mean),
            number(d.flip.p99),
            percent(d.flip.share_over_bound),
        ],
    }
}
