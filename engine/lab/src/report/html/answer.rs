//! The top of the page: what was compared, and what came out.

use super::table::{numbers, table, words};
use super::writer::Writer;
use super::{median_text, or_dash};
use crate::diff::{number, percent};
use crate::report::analysis::{Analysis, Ratio, Verdict};
use crate::report::format::{bytes, significant};
use crate::report::model::{Comparison, PipelineResult};
use crate::report::summary::{Statement, Topic, clock_name};

/// Title and one line of facts.
pub fn header(w: &mut Writer, c: &Comparison) {
    w.element("header", &[], |w| {
        w.leaf(
            "p",
            &[("class", "kicker")],
            "Lightbench · comparison of pipelines",
        );
        w.leaf(
            "h1",
            &[],
            if c.title.is_empty() {
                "Comparison"
            } else {
                &c.title
            },
        );
        w.element("p", &[("class", "subject")], |w| {
            let [width, height] = c.size;
            let software = if c.adapter.software {
                " (software driver)"
            } else {
                ""
            };
            let facts = [
                format!("Scene {}", c.scene),
                format!("{width} × {height} pixels"),
                format!("{} frames after {} of warm-up", c.frames, c.warmup_frames),
                format!("{}{software}", c.adapter.name),
                c.created.clone(),
            ];
            for fact in facts {
                w.leaf("span", &[], &fact);
            }
        });
        w.element("nav", &[("aria-label", "Contents")], |w| {
            for (id, name) in [
                ("answer", "In short"),
                ("pictures", "Pictures"),
                ("times", "Times"),
                ("memory", "Memory"),
                ("again", "Run it again"),
                ("reading", "How to read this"),
            ] {
                w.leaf("a", &[("href", &format!("#{id}"))], name);
            }
        });
    });
}

/// The summary in words and the key numbers.
pub fn section(w: &mut Writer, c: &Comparison, analysis: &Analysis, statements: &[Statement]) {
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
            if !c.pipelines.is_empty() {
                key_table(w, c, analysis);
            }
        },
    );
}

fn key_table(w: &mut Writer, c: &Comparison, analysis: &Analysis) {
    let clock = clock_name(c, analysis.clock);
    let baseline = c.pipelines[analysis.baseline].label();
    let several = c.pipelines.len() > 1;
    let mut columns = vec![
        words("Pipeline"),
        numbers("Frame, median"),
        numbers("95 % interval, ms"),
        numbers("95th percentile"),
    ];
    if several {
        columns.extend([
            numbers(&format!("Speed, {baseline} = 1")),
            words("Verdict"),
            numbers("FLIP, mean"),
            numbers("FLIP, 99th pct."),
            numbers("Pixels over bound"),
        ]);
    }
    columns.extend([numbers("Targets"), numbers("Bytes / px")]);
    let rows: Vec<Vec<String>> = c
        .pipelines
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let time = analysis.times[i];
            let interval = time.and_then(|t| t.median_interval);
            let mut row = vec![
                p.label().to_owned(),
                median_text(time.as_ref()),
                or_dash(
                    interval.map(|t| format!("{} – {}", significant(t.low), significant(t.high))),
                ),
                or_dash(time.map(|t| significant(t.p95))),
            ];
            if several {
                row.extend(speed_cells(analysis.against_baseline[i]));
                row.extend(picture_cells(p, c));
            }
            row.push(bytes(p.target_bytes_total));
            row.push(significant(bytes_a_pixel(p, c)));
            row
        })
        .collect();
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
        Verdict::TooFew => "too few frames",
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
