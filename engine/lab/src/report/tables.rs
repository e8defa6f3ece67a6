//! Tables of a study for other texts: Markdown and LaTeX.

use super::analysis::{Analysis, Verdict};
use super::format::significant;
use super::lines;
use super::model::{Comparison, PipelineResult};
use super::theory;
use crate::diff::number;
use crate::study::Study;

/// A heading line and rows of cells.
pub(super) struct TextTable {
    caption: String,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    /// How many columns at the left hold words; the others hold numbers.
    words: usize,
}

impl TextTable {
    /// As a table of GitHub's Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| {
            let escaped = cells.iter().map(|cell| {
                cell.replace('\\', "\\\\")
                    .replace('|', "\\|")
                    .replace('<', "&lt;")
                    .replace(['\n', '\r'], " ")
            });
            format!("| {} |\n", escaped.collect::<Vec<_>>().join(" | "))
        };
        let rule = (0..self.header.len()).map(|i| if i < self.words { "---" } else { "---:" });
        let rule: Vec<String> = rule.map(str::to_owned).collect();
        let mut text = format!("{}\n\n", self.caption.replace(['\n', '\r'], " "));
        text += &line(&self.header);
        text += &line(&rule);
        self.rows.iter().for_each(|row| text += &line(row));
        text
    }

    /// As a `table` of LaTeX that needs the package booktabs.
    pub fn latex(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| latex_text(cell)).collect();
            format!("    {} \\\\\n", cells.join(" & "))
        };
        let columns: String = (0..self.header.len())
            .map(|i| if i < self.words { 'l' } else { 'r' })
            .collect();
        let mut text = format!(
            "% Needs \\usepackage{{booktabs}}\n\\begin{{table}}\n  \\centering\n  \\caption{{{}}}\n  \\begin{{tabular}}{{{columns}}}\n    \\toprule\n",
            latex_text(&self.caption)
        );
        text += &line(&self.header);
        text += "    \\midrule\n";
        self.rows.iter().for_each(|row| text += &line(row));
        text + "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n"
    }
}

/// Plain text with LaTeX's own characters escaped.
fn latex_text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                out.push('\\');
                out.push(c);
            }
            '\\' => out.push_str("\\textbackslash{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '–' => out.push_str("--"),
            '×' => out.push_str("$\\times$"),
            '·' => out.push_str("$\\cdot$"),
            '≤' => out.push_str("$\\leq$"),
            '\u{202F}' => out.push_str("\\,"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// The tables of a study with their files' names.
pub(super) fn all(study: &Study, analyses: &[Analysis]) -> Vec<(&'static str, TextTable)> {
    vec![
        ("speed", speed(study, analyses)),
        ("pictures", pictures(study)),
        ("memory", memory(study)),
    ]
}

/// The columns that name a row: the point, where there are several, and the pipeline.
fn head(study: &Study, columns: &[&str]) -> (Vec<String>, usize) {
    let mut header = Vec::new();
    if study.points.len() > 1 {
        header.push("Point".to_owned());
    }
    header.push("Pipeline".to_owned());
    let words = header.len();
    header.extend(columns.iter().map(|c| (*c).to_owned()));
    (header, words)
}

fn rows(
    study: &Study,
    cells: impl Fn(usize, usize, &Comparison, &PipelineResult) -> Vec<String>,
) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for (at, point) in study.points.iter().enumerate() {
        for (i, p) in point.comparison.pipelines.iter().enumerate() {
            let mut row = Vec::new();
            if study.points.len() > 1 {
                row.push(lines::name(study, point));
            }
            row.push(p.label().to_owned());
            row.extend(cells(at, i, &point.comparison, p));
            rows.push(row);
        }
    }
    rows
}

fn software(study: &Study) -> &'static str {
    match study.points.iter().any(|p| p.comparison.adapter.software) {
        true => " Measured on a software driver.",
        false => "",
    }
}

fn dash(text: Option<String>) -> String {
    text.unwrap_or_else(|| "–".into())
}

fn speed(study: &Study, analyses: &[Analysis]) -> TextTable {
    let (header, words) = head(
        study,
        &[
            "Frame (ms)",
            "95 % interval (ms)",
            "Speed",
            "Interval of the speed",
            "Verdict",
        ],
    );
    let rows = rows(study, |at, i, _, _| {
        let Some(analysis) = analyses.get(at) else {
            return vec!["–".into(); 5];
        };
        let time = analysis.times.get(i).copied().flatten();
        let interval = time.and_then(|t| t.median_interval);
        let ratio = analysis.against_baseline.get(i).copied().flatten();
        let range = |low: f64, high: f64| format!("{} – {}", significant(low), significant(high));
        vec![
            dash(time.map(|t| significant(t.median))),
            dash(interval.map(|i| range(i.low, i.high))),
            match ratio {
                None => "1".into(),
                Some(r) if r.speed.is_nan() => "–".into(),
                Some(r) => significant(r.speed),
            },
            dash(ratio.and_then(|r| r.interval).map(|i| range(i.low, i.high))),
            ratio.map_or("baseline", |r| verdict(r.verdict)).into(),
        ]
    });
    TextTable {
        caption: format!(
            "{}: time of a frame, and speed against {}; 2 is twice as fast.{}",
            study.plan.title,
            study.plan.reference,
            software(study)
        ),
        header,
        rows,
        words,
    }
}

/// A verdict in a word or two.
pub(super) fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Faster => "faster",
        Verdict::Slower => "slower",
        Verdict::Same => "the same",
        Verdict::Undecided => "undecided",
        Verdict::TooFew => "too few",
    }
}

fn pictures(study: &Study) -> TextTable {
    let (header, words) = head(
        study,
        &["FLIP, mean", "FLIP, 99th percentile", "SSIM", "PSNR (dB)"],
    );
    let rows = rows(study, |_, _, c, p| match &p.difference {
        None if p.name == c.reference => {
            vec!["reference".into(), "–".into(), "–".into(), "–".into()]
        }
        None => vec!["–".into(); 4],
        Some(d) => vec![
            number(d.flip.mean),
            number(d.flip.p99),
            number(d.ssim),
            match d.srgb.psnr_db.is_finite() {
                true => significant(d.srgb.psnr_db),
                false => "equal".into(),
            },
        ],
    });
    TextTable {
        caption: format!(
            "{}: pictures against that of {}.",
            study.plan.title, study.plan.reference
        ),
        header,
        rows,
        words,
    }
}

fn memory(study: &Study) -> TextTable {
    let (header, words) = head(
        study,
        &[
            "Targets (bytes)",
            "Bytes a pixel",
            "Theory, at least",
            "Formula",
        ],
    );
    let rows = rows(study, |_, _, c, p| {
        let theory = theory::of(&p.name);
        vec![
            p.target_bytes_total.to_string(),
            significant(theory::measured(p, c)),
            dash(theory.as_ref().map(|t| significant(t.bytes_a_pixel()))),
            dash(theory.as_ref().map(theory::Theory::formula)),
        ]
    });
    TextTable {
        caption: format!(
            "{}: memory of the targets against what the technique needs.",
            study.plan.title
        ),
        header,
        rows,
        words,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_escaped_for_each_language() {
        let table = TextTable {
            caption: "a_b".into(),
            header: vec!["x|y".into(), "50 %".into()],
            rows: vec![vec!["<i>".into(), "\\".into()]],
            words: 1,
        };
        assert_eq!(
            table.markdown(),
            "a_b\n\n| x\\|y | 50 % |\n| --- | ---: |\n| &lt;i> | \\\\ |\n"
        );
        let latex = table.latex();
        assert!(latex.contains("\\caption{a\\_b}") && latex.contains("{lr}"));
        assert!(latex.contains("x|y & 50 \\%"));
        assert!(latex.contains("\\textless{}i\\textgreater{} & \\textbackslash{}"));
    }
}
