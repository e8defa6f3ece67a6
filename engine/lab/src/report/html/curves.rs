//! Curves over the axes of a study, and where they cross.

use super::table::{numbers, table, words};
use super::writer::Writer;
use crate::curves::chart;
use crate::report::analysis::Analysis;
use crate::report::figures::times;
use crate::report::format::significant;
use crate::report::lines::{Line, crossings};
use crate::report::summary::label_of;
use crate::study::Study;

/// One chart a line, each with its numbers behind it and the crossings on it.
pub fn section(w: &mut Writer, study: &Study, analyses: &[Analysis], lines: &[Line]) {
    if lines.is_empty() {
        return;
    }
    w.element(
        "section",
        &[("id", "curves"), ("aria-labelledby", "curves-h")],
        |w| {
            w.leaf("h2", &[("id", "curves-h")], "How the time grows");
            for line in lines {
                curves(w, study, analyses, line);
            }
        },
    );
}

fn curves(w: &mut Writer, study: &Study, analyses: &[Analysis], line: &Line) {
    let drawn = times(study, analyses, line);
    let caption = format!(
        "{}. Marks are medians, whiskers their 95 % intervals; the table below has the numbers.",
        drawn.title
    );
    w.element("figure", &[("class", "chart curves")], |w| {
        w.leaf("figcaption", &[("class", "above")], &caption);
        let region = [
            ("class", "wide"),
            ("tabindex", "0"),
            ("role", "region"),
            ("aria-label", drawn.title.as_str()),
        ];
        w.element("div", &region, |w| {
            let image = [("role", "img"), ("aria-label", drawn.title.as_str())];
            // Within a page of HTML an SVG needs no name space.
            let svg = chart(&drawn).replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
            w.element("div", &image, |w| w.drawing(&svg));
        });
    });
    found(w, study, analyses, line);
    w.element("details", &[], |w| {
        w.leaf("summary", &[], "The numbers of these curves");
        let mut columns = vec![words("Pipeline")];
        columns.extend(
            line.points
                .iter()
                .map(|(value, _)| numbers(&format!("{} {value}", line.axis))),
        );
        let rows: Vec<Vec<String>> = drawn
            .curves
            .iter()
            .map(|curve| {
                let mut row = vec![curve.name.clone()];
                row.extend(line.points.iter().map(|(value, _)| {
                    let at = curve.points.iter().position(|p| p[0] == *value);
                    at.map_or_else(
                        || "–".into(),
                        |i| {
                            let [low, high] = curve.intervals[i].map(significant);
                            format!("{} ({low} – {high})", significant(curve.points[i][1]))
                        },
                    )
                }));
                row
            })
            .collect();
        table(
            w,
            &format!("{}, ms, median (95 % interval).", drawn.title),
            &columns,
            &rows,
        );
    });
}

/// The crossings, or that none is supported.
fn found(w: &mut Writer, study: &Study, analyses: &[Analysis], line: &Line) {
    let crossings = crossings(study, analyses, line);
    if crossings.is_empty() {
        let text = "No two curves cross here with intervals that support both sides.";
        w.leaf("p", &[("class", "note")], text);
        return;
    }
    let rows: Vec<Vec<String>> = crossings
        .iter()
        .map(|c| {
            vec![
                label_of(study, &c.before),
                label_of(study, &c.after),
                format!("{} – {}", c.between[0], c.between[1]),
                significant(c.near),
            ]
        })
        .collect();
    let columns = [
        words("Faster before"),
        words("Faster after"),
        numbers(&format!("Between, {}", line.unit())),
        numbers("Near"),
    ];
    let caption = format!(
        "Crossings over {}. The intervals support both sides; \"near\" is where straight lines \
         between the medians meet.",
        line.unit()
    );
    table(w, &caption, &columns, &rows);
}
