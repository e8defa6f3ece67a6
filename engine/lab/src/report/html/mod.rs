//! The report as one HTML file that needs no other file and no network.
//!
//! All words, tables and charts are there without the script, and so are all pictures while they are
//! small enough to be held whole. The script adds the picture viewer, tables that sort, the choice
//! of the point that is shown, and a button that copies the command. The page sets light or dark by the reader's preference and prints
//! light.

mod answer;
pub(super) mod charts;
mod curves;
mod passes;
mod pictures;
mod provenance;
mod side_by_side;
mod table;
mod viewer;
pub(crate) mod writer;

use self::writer::Writer;
use super::analysis::{Analysis, of_study};
use super::format::milliseconds;
use super::images::{self, Encoded};
use super::model::Comparison;
use super::{lines, summary};
use crate::LabError;
use crate::study::Study;

const STYLE: &str = include_str!("report.css");
const SCRIPT: &str = include_str!("report.js");
const VIEWER: &str = include_str!("viewer.js");

/// What may be loaded: nothing but what is in the file.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; \
                      script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// A point of the page.
pub(super) struct At<'a> {
    /// What was measured there.
    pub comparison: &'a Comparison,
    /// What its numbers allow to be said.
    pub analysis: &'a Analysis,
    /// The pictures of its pipelines.
    pub images: &'a [Encoded],
    /// Which point it is, from 1; 0 where there is no other.
    pub number: usize,
    /// The point in words; empty where there is no other.
    pub words: String,
}

impl At<'_> {
    /// An id that no other point has.
    fn id(&self, name: &str) -> String {
        match self.number {
            0 => name.to_owned(),
            number => format!("{name}-{number}"),
        }
    }

    /// A heading that says at which point.
    fn heading(&self, text: &str) -> String {
        match self.words.is_empty() {
            true => text.to_owned(),
            false => format!("{text}, {}", self.words),
        }
    }
}

/// The page of one comparison.
///
/// # Errors
/// [`LabError::Encode`] if a picture can't be encoded as PNG.
pub fn page(comparison: &Comparison) -> Result<String, LabError> {
    let study = super::write::of_one(comparison.clone());
    let images = images::encode(&[&study.points[0].comparison])?;
    Ok(study_page(&study, &of_study(&study), &images))
}

/// The page of a study, with pictures that are encoded already.
pub(super) fn study_page(study: &Study, analyses: &[Analysis], images: &[Vec<Encoded>]) -> String {
    let statements = summary::summarize_study(study, analyses);
    let several = study.points.len() > 1;
    let parts = study.points.iter().zip(analyses).zip(images).enumerate();
    let points: Vec<At> = parts
        .map(|(index, ((point, analysis), images))| At {
            comparison: &point.comparison,
            analysis,
            images,
            number: if several { index + 1 } else { 0 },
            words: if several {
                lines::name(study, point)
            } else {
                String::new()
            },
        })
        .collect();
    let names = charts::pass_names(points.iter().map(|at| at.comparison));
    let lines = lines::lines(study);
    let mut w = Writer::default();
    w.constant("<!DOCTYPE html>\n");
    w.element("html", &[("lang", "en")], |w| {
        head(w, &study.plan.title);
        w.element("body", &[], |w| {
            definitions(w, names.len());
            answer::header(w, study, &points, !lines.is_empty());
            w.element("main", &[], |w| {
                answer::section(w, study, &points, &statements);
                curves::section(w, study, analyses, &lines);
                chooser(w, &points);
                viewer::section(w, &points);
                for at in &points {
                    w.element("div", &[("class", "at"), ("id", &at.id("at"))], |w| {
                        pictures::section(w, at);
                        passes::times_section(w, at, &names);
                        side_by_side::section(w, at);
                        passes::memory_section(w, at);
                    });
                }
                if let Some(at) = points.first() {
                    provenance::run_again_section(w, study, at.comparison);
                    provenance::reading_section(w, &points, at.analysis);
                }
            });
            w.element("footer", &[], |w| {
                if let Some(at) = points.first() {
                    w.leaf("p", &[], &footer(at.comparison));
                }
            });
            w.element("script", &[], |w| {
                w.constant(SCRIPT);
                w.constant(VIEWER);
            });
        });
    });
    w.finish()
}

/// What charts of all points refer to.
fn definitions(w: &mut Writer, passes: usize) {
    let svg = [
        ("class", "definitions"),
        ("aria-hidden", "true"),
        ("width", "0"),
        ("height", "0"),
    ];
    w.element("svg", &svg, |w| {
        w.element("defs", &[], |w| {
            charts::patterns(w, passes);
            pictures::gradient(w);
        });
    });
}

/// Which point the sections below show; without the script all are there, one after the other.
fn chooser(w: &mut Writer, points: &[At]) {
    if points.len() < 2 {
        return;
    }
    w.element(
        "div",
        &[("class", "chooser"), ("id", "chooser"), ("hidden", "")],
        |w| {
            w.element("label", &[], |w| {
                w.text("Point of the study ");
                w.element("select", &[("id", "point")], |w| {
                    for at in points {
                        let value = at.number.to_string();
                        w.leaf("option", &[("value", &value)], &at.words);
                    }
                    w.leaf("option", &[("value", "")], "all, one below the other");
                });
            });
            w.leaf(
                "span",
                &[("class", "note")],
                "The sections below are of this point.",
            );
        },
    );
}

fn head(w: &mut Writer, title: &str) {
    w.element("head", &[], |w| {
        w.void("meta", &[("charset", "utf-8")]);
        w.void(
            "meta",
            &[
                ("name", "viewport"),
                ("content", "width=device-width, initial-scale=1"),
            ],
        );
        w.void(
            "meta",
            &[
                ("http-equiv", "Content-Security-Policy"),
                ("content", POLICY),
            ],
        );
        w.void(
            "meta",
            &[("name", "color-scheme"), ("content", "light dark")],
        );
        let title = if title.is_empty() {
            "Comparison"
        } else {
            title
        };
        w.leaf("title", &[], &format!("{title} – Lightbench report"));
        w.element("style", &[], |w| w.constant(STYLE));
    });
}

fn footer(c: &Comparison) -> String {
    format!(
        "Lightbench {} · {} · {}",
        c.program_version, c.scene, c.created
    )
}

/// "– " where there is no number.
fn or_dash(value: Option<String>) -> String {
    value.unwrap_or_else(|| "–".into())
}

/// A median with its interval, for tables.
fn median_text(summary: Option<&crate::statistics::Summary>) -> String {
    or_dash(summary.map(|s| milliseconds(s.median)))
}

/// The words that label a time measured on a software driver.
fn software_note(c: &Comparison) -> &'static str {
    if c.adapter.software {
        ", software driver"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests;
