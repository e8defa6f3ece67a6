//! The report as one HTML file that needs no other file and no network.
//!
//! Everything is there without the script; the script only adds the picture viewer and a button
//! that copies the command. The page sets light or dark by the reader's preference and prints
//! light.

mod answer;
mod charts;
mod passes;
mod pictures;
mod provenance;
mod table;
pub(crate) mod writer;

use self::writer::Writer;
use super::analysis::Analysis;
use super::format::milliseconds;
use super::images::{self, Encoded};
use super::model::Comparison;
use super::summary;
use crate::LabError;

const STYLE: &str = include_str!("report.css");
const SCRIPT: &str = include_str!("report.js");

/// What may be loaded: nothing but what is in the file.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; \
                      script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The whole page.
///
/// # Errors
/// [`LabError::Encode`] if a picture can't be encoded as PNG.
pub fn page(comparison: &Comparison) -> Result<String, LabError> {
    Ok(page_with(comparison, &images::encode(comparison)?))
}

/// The whole page with pictures that are encoded already.
pub(super) fn page_with(comparison: &Comparison, images: &[Encoded]) -> String {
    let analysis = Analysis::of(comparison);
    let statements = summary::summarize(comparison, &analysis);
    let mut w = Writer::default();
    w.constant("<!DOCTYPE html>\n");
    w.element("html", &[("lang", "en")], |w| {
        head(w, &comparison.title);
        w.element("body", &[], |w| {
            answer::header(w, comparison);
            w.element("main", &[], |w| {
                answer::section(w, comparison, &analysis, &statements);
                pictures::section(w, comparison, images);
                passes::times_section(w, comparison, &analysis);
                passes::memory_section(w, comparison);
                provenance::run_again_section(w, comparison);
                provenance::reading_section(w, comparison, &analysis);
            });
            w.element("footer", &[], |w| {
                w.leaf("p", &[], &footer(comparison));
            });
            w.element("script", &[], |w| w.constant(SCRIPT));
        });
    });
    w.finish()
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
