//! The charts of a study as SVG files that stand alone, and as PNG files.

use lightbench_script::{Chart, ChartCurve};
use resvg::tiny_skia;

use super::analysis::Analysis;
use super::html::charts;
use super::lines::{Line, lines};
use super::summary::clock_name;
use crate::LabError;
use crate::curves::chart;
use crate::study::Study;
use crate::svg;

/// Pixels of a PNG file for a unit of its SVG.
const SHARPNESS: f32 = 2.0;

/// The charts with their files' names.
pub(super) fn all(study: &Study, analyses: &[Analysis]) -> Vec<(String, String)> {
    let mut figures = Vec::new();
    for (number, line) in lines(study).iter().enumerate() {
        figures.push((
            format!("curves-{}", number + 1),
            chart(&times(study, analyses, line)),
        ));
    }
    let names = charts::pass_names(study.points.iter().map(|p| &p.comparison));
    for (number, (point, analysis)) in study.points.iter().zip(analyses).enumerate() {
        let at = match study.points.len() {
            1 => String::new(),
            _ => format!("-{}", number + 1),
        };
        let c = &point.comparison;
        if !analysis.order.is_empty() {
            let svg = charts::alone(0, |w| charts::frames(w, c, analysis));
            figures.extend(svg.map(|svg| (format!("frames{at}"), svg)));
        }
        let svg = charts::alone(names.len(), |w| charts::passes(w, c, &names));
        figures.extend(svg.map(|svg| (format!("passes{at}"), svg)));
    }
    figures
}

/// The medians of all pipelines along a line, with their intervals.
pub(super) fn times(study: &Study, analyses: &[Analysis], line: &Line) -> Chart {
    let first = &study.points[line.points[0].1].comparison;
    let clock = analyses[line.points[0].1].clock;
    let mut names: Vec<(&str, &str)> = Vec::new();
    for (_, index) in &line.points {
        for p in &study.points[*index].comparison.pipelines {
            if !names.iter().any(|(name, _)| *name == p.name) {
                names.push((&p.name, p.label()));
            }
        }
    }
    let curves: Vec<ChartCurve> = names
        .into_iter()
        .map(|(name, label)| curve(study, analyses, line, name, label))
        .collect();
    let xs = || line.points.iter().map(|(value, _)| *value);
    let ys = || curves.iter().flat_map(|c| c.points.iter().map(|p| p[1]));
    let place = line.place();
    let at = if place.is_empty() {
        String::new()
    } else {
        format!(" at {place}")
    };
    Chart {
        title: format!(
            "{} of a frame over {}{at}",
            clock_name(first, clock),
            line.unit()
        ),
        x: line.unit(),
        y: "ms a frame, median with its 95 % interval".into(),
        logarithmic: [wide(xs()), wide(ys())],
        curves,
    }
}

/// Whether values reach over so many factors that a logarithmic axis shows them better.
fn wide(values: impl Iterator<Item = f64>) -> bool {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    low > 0.0 && high / low >= 8.0
}

fn curve(study: &Study, analyses: &[Analysis], line: &Line, name: &str, label: &str) -> ChartCurve {
    let mut curve = ChartCurve {
        name: label.to_owned(),
        ..ChartCurve::default()
    };
    for (value, index) in &line.points {
        let pipelines = &study.points[*index].comparison.pipelines;
        let place = pipelines.iter().position(|p| p.name == name);
        let Some(time) = place.and_then(|i| analyses[*index].times[i]) else {
            continue;
        };
        curve.points.push([*value, time.median]);
        let interval = time.median_interval;
        let ends = interval.map_or([time.median; 2], |i| [i.low, i.high]);
        curve.intervals.push(ends);
    }
    curve
}

/// Draws an SVG chart as a PNG file.
///
/// # Errors
/// [`LabError::Encode`] if the SVG is not well-formed or too large.
pub(super) fn png(svg: &str) -> Result<Vec<u8>, LabError> {
    let fail = |reason: String| LabError::Encode {
        format: "PNG of a chart",
        reason,
    };
    let map = svg::render(svg, SHARPNESS, tiny_skia::Color::WHITE);
    let map = map.map_err(|error| fail(error.to_string()))?;
    map.encode_png().map_err(|error| fail(error.to_string()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::analysis::of_study;
    use crate::report::sample;

    #[test]
    fn every_chart_is_drawn_with_its_text_and_colours() {
        let study = sample::study(&[16, 64, 256], |lights| [10.0, 0.1 * lights]);
        let figures = all(&study, &of_study(&study));
        let names: Vec<&str> = figures.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(
            names,
            [
                "curves-1", "frames-1", "passes-1", "frames-2", "passes-2", "frames-3", "passes-3"
            ]
        );
        for (name, svg) in &figures[..3] {
            let file = png(svg).unwrap();
            let image = image::load_from_memory(&file).unwrap().to_rgb8();
            let count =
                |wanted: fn([u8; 3]) -> bool| image.pixels().filter(|p| wanted(p.0)).count();
            let coloured = count(|[r, g, b]| r.abs_diff(g).max(g.abs_diff(b)) > 40);
            assert!(coloured > 200, "{name} has colours: {coloured}");
            // A chart without its text is paler: text alone has this many dark pixels.
            let bare = svg.replace("<text", "<g").replace("</text>", "</g>");
            let bare = image::load_from_memory(&png(&bare).unwrap())
                .unwrap()
                .to_rgb8();
            let dark = |image: &image::RgbImage| {
                image
                    .pixels()
                    .filter(|p| p.0.iter().all(|v| *v < 120))
                    .count()
            };
            assert!(dark(&image) > dark(&bare) + 500, "{name} has text");
        }
    }

    #[test]
    fn axes_are_logarithmic_where_values_reach_far() {
        assert!(wide([1.0, 8.0].into_iter()));
        assert!(!wide([1.0, 7.0].into_iter()));
        assert!(!wide([0.0, 100.0].into_iter()));
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert!(png("<svg").unwrap_err().to_string().contains("chart"));
    }
}
