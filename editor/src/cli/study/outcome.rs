//! What a study ends in: its report on disk, and its summary on the terminal.

use std::path::Path;

use lightbench::lab::report::analysis::{Analysis, of_study, samples};
use lightbench::lab::report::format::{bytes, milliseconds};
use lightbench::lab::report::summary::{clock_name, summarize_study};
use lightbench::lab::report::{Comparison, write_study};
use lightbench::lab::statistics::Summary;
use lightbench::lab::study::Study;

use crate::cli::report::say;

/// Writes the report and says in short what came out.
///
/// # Errors
/// A disk that can't be written.
pub fn write(study: &mut Study, folder: &Path) -> anyhow::Result<()> {
    write_study(study, folder)?;
    print(study)?;
    say(folder.join("report.html").display().to_string())
}

/// The summary and a small table for each point.
fn print(study: &Study) -> anyhow::Result<()> {
    let analyses = of_study(study);
    for statement in summarize_study(study, &analyses) {
        say(statement.text)?;
    }
    for (point, analysis) in study.points.iter().zip(&analyses) {
        say("")?;
        if study.points.len() > 1 {
            say(&point.key)?;
        }
        table(&point.comparison, analysis)?;
    }
    Ok(())
}

fn table(comparison: &Comparison, analysis: &Analysis) -> anyhow::Result<()> {
    let clock = clock_name(comparison, analysis.clock);
    let names = comparison.pipelines.iter().map(|p| p.name.chars().count());
    let width = names.max().unwrap_or(0).max("pipeline".len());
    say(format!(
        "{:<width$}  {:>10}  {:>10}  {:>12}  {:>10}",
        "pipeline", "median", "p95", "targets", "FLIP mean"
    ))?;
    for pipeline in &comparison.pipelines {
        let times = Summary::of(samples(pipeline, analysis.clock));
        let time = |pick: fn(Summary) -> f64| {
            times.map_or_else(|| "n/a".to_owned(), |times| milliseconds(pick(times)))
        };
        let flip = match &pipeline.difference {
            Some(difference) => format!("{:.4}", difference.flip.mean),
            None => "reference".to_owned(),
        };
        let cut = if pipeline.cut { "  cut short" } else { "" };
        say(format!(
            "{:<width$}  {:>10}  {:>10}  {:>12}  {:>10}{cut}",
            pipeline.name,
            time(|t| t.median),
            time(|t| t.p95),
            bytes(pipeline.target_bytes_total),
            flip
        ))?;
    }
    say(format!("Times are {clock} of a frame.\n"))
}
