//! Charts as inline SVG. Every chart has its numbers in a table near it.

use super::passes::clock_caption;
use super::software_note;
use super::writer::Writer;
use crate::report::analysis::{Analysis, samples};
use crate::report::format::{milliseconds, significant};
use crate::report::model::{Comparison, PipelineResult};
use crate::statistics::{Summary, median};

/// Width of a chart in its own units.
const WIDTH: f64 = 960.0;
/// Space at the left and right, so that marks at the ends are whole.
const SIDE: f64 = 8.0;
/// Height of a pipeline's label above its band.
const LABEL: f64 = 20.0;
/// Distance from one pipeline to the next.
const STEP: f64 = 64.0;
/// Colours of passes, and line patterns of passes.
const COLOURS: usize = 8;
/// Different looks of passes, each colour with several patterns; more passes repeat them.
const LOOKS: usize = 4 * COLOURS;

/// A linear axis from 0.
struct Axis {
    end: f64,
    step: f64,
}

impl Axis {
    /// An axis that holds a value, with four to ten round steps.
    fn holding(largest: f64) -> Self {
        let largest = if largest.is_finite() && largest > 0.0 {
            largest
        } else {
            1.0
        };
        let raw = largest / 8.0;
        let power = 10.0_f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * power);
        let step = step.into_iter().find(|s| *s >= raw).unwrap_or(10.0 * power);
        Self {
            end: (largest / step).ceil() * step,
            step,
        }
    }

    fn x(&self, value: f64) -> f64 {
        SIDE + (WIDTH - 2.0 * SIDE) * (value / self.end).clamp(0.0, 1.0)
    }

    fn draw(&self, w: &mut Writer, top: f64, bottom: f64) {
        let count = (self.end / self.step).round() as u32;
        for tick in 0..=count {
            let value = f64::from(tick) * self.step;
            let x = self.x(value);
            mark(w, "grid", &format!("M{x:.1} {top:.1}V{bottom:.1}"));
            let anchor = match tick {
                0 => "start",
                t if t == count => "end",
                _ => "middle",
            };
            // Ten decimals at most: ticks are round numbers up to binary rounding.
            let text = (value * 1e10).round() / 1e10;
            let unit = if tick == count { " ms" } else { "" };
            label(
                w,
                "tick",
                x,
                bottom + 16.0,
                anchor,
                &format!("{text}{unit}"),
            );
        }
        mark(
            w,
            "axis",
            &format!("M{SIDE} {bottom:.1}H{:.1}", WIDTH - SIDE),
        );
    }
}

fn mark(w: &mut Writer, class: &str, path: &str) {
    w.element("path", &[("class", class), ("d", path)], |_| {});
}

fn label(w: &mut Writer, class: &str, x: f64, y: f64, anchor: &str, text: &str) {
    let (x, y) = (format!("{x:.1}"), format!("{y:.1}"));
    w.leaf(
        "text",
        &[
            ("class", class),
            ("x", &x),
            ("y", &y),
            ("text-anchor", anchor),
        ],
        text,
    );
}

fn rectangle(w: &mut Writer, class: &str, fill: &str, [x, y, width, height]: [f64; 4]) {
    let [x, y, width, height] = [x, y, width, height].map(|v| format!("{v:.1}"));
    let attributes = [
        ("class", class),
        ("fill", fill),
        ("x", &x),
        ("y", &y),
        ("width", &width),
        ("height", &height),
    ];
    w.element("rect", &attributes, |_| {});
}

fn chart(
    w: &mut Writer,
    height: f64,
    title: &str,
    caption: &str,
    content: impl FnOnce(&mut Writer),
) {
    w.element("figure", &[("class", "chart")], |w| {
        w.leaf("figcaption", &[("class", "above")], caption);
        w.element(
            "div",
            &[
                ("class", "wide"),
                ("tabindex", "0"),
                ("role", "region"),
                ("aria-label", title),
            ],
            |w| {
                let view = format!("0 0 {WIDTH} {height}");
                w.element(
                    "svg",
                    &[("viewBox", &view), ("role", "img"), ("aria-label", title)],
                    content,
                );
            },
        );
    });
}

/// The style of a chart that stands alone, as the page has it in light.
const ALONE: &str = "\
text{fill:#1c1d20;font-size:13px;font-family:Ubuntu,Helvetica,Arial,sans-serif}\
.tick{fill:#5b5e66;font-size:12px}\
.inside{font-size:12.5px;paint-order:stroke;stroke:#ffffff;stroke-width:4.5px;stroke-linejoin:round}\
.grid{stroke:#d9d7d0;stroke-width:1;fill:none}\
.axis{stroke:#5b5e66;stroke-width:1;fill:none}\
.dots{stroke:#0072b2;stroke-width:3.4;stroke-linecap:round;opacity:.5;fill:none}\
.median{stroke:#1c1d20;stroke-width:1.8;fill:none}\
.triangle{fill:#1c1d20}\
.interval{fill:#c65102;opacity:.35}\
.segment{stroke:#5b5e66;stroke-width:.8}\
.look path{stroke-width:1.5;stroke-linecap:round;fill:none}\
.look rect{fill-opacity:.3}\
.c0 rect{fill:#0072b2}.c0 path{stroke:#0072b2}.c1 rect{fill:#c65102}.c1 path{stroke:#c65102}\
.c2 rect{fill:#00805a}.c2 path{stroke:#00805a}.c3 rect{fill:#a0408c}.c3 path{stroke:#a0408c}\
.c4 rect{fill:#8f6b00}.c4 path{stroke:#8f6b00}.c5 rect{fill:#2f8fbf}.c5 path{stroke:#2f8fbf}\
.c6 rect{fill:#5a5d66}.c6 path{stroke:#5a5d66}.c7 rect{fill:#8b1e4b}.c7 path{stroke:#8b1e4b}";

/// The first chart that is written as a file that stands alone, with the patterns of so many passes.
pub fn alone(passes: usize, write: impl FnOnce(&mut Writer)) -> Option<String> {
    let mut page = Writer::default();
    write(&mut page);
    let page = page.finish();
    let start = page.find("<svg")?;
    let end = start + page[start..].find("</svg>")?;
    let (tag, content) = page[start..end].split_once('>')?;
    let height: f64 = tag
        .split_once("viewBox=\"")?
        .1
        .split(['"', ' '])
        .nth(3)?
        .parse()
        .ok()?;
    let mut head = Writer::default();
    head.element("style", &[], |w| w.constant(ALONE));
    head.element(
        "rect",
        &[("width", "100%"), ("height", "100%"), ("fill", "#ffffff")],
        |_| {},
    );
    head.element("defs", &[], |w| patterns(w, passes));
    let head = head.finish();
    let size =
        format!("xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\"");
    let tag = tag.replacen("<svg", &format!("<svg {size}"), 1);
    Some(format!("{tag}>{head}{content}</svg>\n"))
}

/// Every measured frame of every pipeline as a dot, with medians and their intervals.
pub fn frames(w: &mut Writer, c: &Comparison, analysis: &Analysis) {
    let largest = c
        .pipelines
        .iter()
        .flat_map(|p| samples(p, analysis.clock))
        .copied()
        .filter(|v| v.is_finite())
        .fold(0.0, f64::max);
    let axis = Axis::holding(largest);
    let bottom = STEP * c.pipelines.len() as f64;
    let clock = clock_caption(c, analysis);
    let caption = format!(
        "Every measured frame ({clock}). Each dot is a frame, the first at the top of its band and \
         the last at the bottom, so that drift shows as a slant. The line is the median, the shaded \
         box its 95 % interval. Shorter is faster."
    );
    chart(
        w,
        bottom + 24.0,
        &format!("Frame times, {clock}"),
        &caption,
        |w| {
            axis.draw(w, 0.0, bottom);
            for (i, pipeline) in c.pipelines.iter().enumerate() {
                let top = STEP * i as f64 + LABEL;
                let series = samples(pipeline, analysis.clock);
                let name = match analysis.times[i] {
                    Some(summary) => {
                        format!(
                            "{} – median {}",
                            pipeline.label(),
                            milliseconds(summary.median)
                        )
                    }
                    None => format!("{} – no times", pipeline.label()),
                };
                label(w, "name", SIDE, top - 5.0, "start", &name);
                frame_band(w, &axis, top, series, analysis.times[i]);
            }
        },
    );
}

fn frame_band(w: &mut Writer, axis: &Axis, top: f64, series: &[f64], summary: Option<Summary>) {
    let height = STEP - LABEL - 8.0;
    let Some(summary) = summary else { return };
    if let Some(interval) = summary.median_interval {
        let (low, high) = (axis.x(interval.low), axis.x(interval.high));
        rectangle(
            w,
            "interval",
            "none",
            [low, top, (high - low).max(1.0), height],
        );
    }
    let mut dots = String::new();
    let last = series.len().saturating_sub(1).max(1) as f64;
    for (i, value) in series.iter().enumerate().filter(|(_, v)| v.is_finite()) {
        let y = top + 3.0 + (height - 6.0) * i as f64 / last;
        dots.push_str(&format!("M{:.1} {y:.1}h0", axis.x(*value)));
    }
    mark(w, "dots", &dots);
    let x = axis.x(summary.median);
    mark(w, "median", &format!("M{x:.1} {top:.1}v{height:.1}"));
}

/// A pass time, its pass and its look.
struct Segment<'a> {
    name: &'a str,
    look: usize,
    median: f64,
}

/// Median pass times of every pipeline as stacked bars.
pub fn passes(w: &mut Writer, c: &Comparison, names: &[&str]) {
    let gpu = c
        .pipelines
        .iter()
        .flat_map(|p| &p.passes)
        .any(|pass| pass.gpu_ms.is_some());
    let bars: Vec<Vec<Segment>> = c
        .pipelines
        .iter()
        .map(|p| segments(p, gpu, names))
        .collect();
    if bars.iter().all(Vec::is_empty) {
        return;
    }
    let sum = |bar: &[Segment]| bar.iter().map(|s| s.median).sum::<f64>();
    let frame = |p: &PipelineResult| {
        if gpu {
            p.gpu_samples().and_then(median)
        } else {
            median(&p.frame_cpu_ms)
        }
    };
    let largest = bars.iter().map(|b| sum(b)).fold(0.0, f64::max);
    let largest = c.pipelines.iter().filter_map(frame).fold(largest, f64::max);
    let axis = Axis::holding(largest);
    let bottom = STEP * c.pipelines.len() as f64;
    let clock = if gpu { "GPU" } else { "CPU" };
    let title = format!("Median {clock} time of the passes{}", software_note(c));
    let caption = format!(
        "{title}, stacked in the order of the frame. The tick with a triangle is the median of the \
         whole frame. A pass keeps its pattern in all bars."
    );
    chart(w, bottom + 24.0, &title, &caption, |w| {
        axis.draw(w, 0.0, bottom);
        for (i, (p, bar)) in c.pipelines.iter().zip(&bars).enumerate() {
            let top = STEP * i as f64 + LABEL;
            let total = format!("{} – passes {}", p.label(), milliseconds(sum(bar)));
            label(w, "name", SIDE, top - 5.0, "start", &total);
            stack(w, &axis, top, bar);
            if let Some(frame) = frame(p) {
                let (x, y) = (axis.x(frame), top + STEP - LABEL - 12.0);
                mark(w, "median", &format!("M{x:.1} {top:.1}V{y:.1}"));
                mark(w, "triangle", &format!("M{x:.1} {y:.1}l-5 7h10z"));
            }
        }
    });
    w.element(
        "ul",
        &[
            ("class", "swatches"),
            ("aria-label", "Patterns of the passes"),
        ],
        |w| {
            let here = |name: &&str| {
                let mut passes = c.pipelines.iter().flat_map(|p| &p.passes);
                passes.any(|pass| pass.name == *name)
            };
            for (i, name) in names.iter().enumerate().filter(|(_, name)| here(name)) {
                w.element("li", &[], |w| {
                    w.element(
                        "svg",
                        &[("viewBox", "0 0 28 16"), ("aria-hidden", "true")],
                        |w| {
                            rectangle(w, "segment", &fill(i), [0.5, 0.5, 27.0, 15.0]);
                        },
                    );
                    w.text(name);
                });
            }
        },
    );
}

/// The names of all passes, each once, in the order in which they come up first.
pub fn pass_names<'a>(comparisons: impl IntoIterator<Item = &'a Comparison>) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    let pipelines = comparisons.into_iter().flat_map(|c| &c.pipelines);
    for pass in pipelines.flat_map(|p| &p.passes) {
        if !names.contains(&pass.name.as_str()) {
            names.push(&pass.name);
        }
    }
    names
}

/// The patterns of so many passes.
pub fn patterns(w: &mut Writer, passes: usize) {
    (0..passes.min(LOOKS)).for_each(|look| pattern(w, look));
}

fn segments<'a>(p: &'a PipelineResult, gpu: bool, names: &[&str]) -> Vec<Segment<'a>> {
    p.passes
        .iter()
        .filter_map(|pass| {
            let samples = if gpu {
                pass.gpu_ms.as_deref()?
            } else {
                &pass.cpu_ms
            };
            let median = median(samples)?;
            let look = names.iter().position(|n| *n == pass.name)?;
            Some(Segment {
                name: &pass.name,
                look,
                median,
            })
        })
        .collect()
}

fn stack(w: &mut Writer, axis: &Axis, top: f64, bar: &[Segment]) {
    let height = STEP - LABEL - 14.0;
    let mut from = 0.0;
    for segment in bar {
        let (x0, x1) = (axis.x(from), axis.x(from + segment.median));
        let text = format!("{}: {} ms", segment.name, significant(segment.median));
        w.element("g", &[], |w| {
            w.leaf("title", &[], &text);
            rectangle(
                w,
                "segment",
                &fill(segment.look),
                [x0, top, (x1 - x0).max(0.5), height],
            );
        });
        // Seven units a letter is wide enough for the widest usual fonts at this size.
        let fits = |text: &str| text.chars().count() as f64 * 7.0 + 10.0 < x1 - x0;
        let middle = [(x0 + x1) / 2.0, top + height / 2.0 + 4.5];
        if let Some(text) = [text.as_str(), segment.name].into_iter().find(|t| fits(t)) {
            label(w, "inside", middle[0], middle[1], "middle", text);
        }
        from += segment.median;
    }
}

fn fill(look: usize) -> String {
    format!("url(#look{})", look % LOOKS)
}

/// A tile of colour and lines; the lines tell passes apart without colour.
fn pattern(w: &mut Writer, look: usize) {
    let id = format!("look{look}");
    // The pattern moves on by one when the colours start again.
    let lines = [
        "",
        "M-2 10L10 -2M-2 2L2 -2M6 10L10 6",
        "M-2 -2L10 10M-2 6L2 10M6 -2L10 2",
        "M2 2h.01M6 6h.01",
        "M0 4H8",
        "M4 0V8",
        "M-2 10L10 -2M-2 -2L10 10",
        "M0 4H8M4 0V8",
    ][(look + look / COLOURS) % COLOURS];
    let class = format!("look c{}", look % COLOURS);
    let attributes = [
        ("id", id.as_str()),
        ("class", &class),
        ("width", "8"),
        ("height", "8"),
        ("patternUnits", "userSpaceOnUse"),
    ];
    w.element("pattern", &attributes, |w| {
        w.element("rect", &[("width", "8"), ("height", "8")], |_| {});
        if !lines.is_empty() {
            w.element("path", &[("d", lines)], |_| {});
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_round_steps_and_hold_the_value() {
        for largest in [0.003, 0.1, 1.0, 7.3, 61.7, 100.0, 1234.0, 99_999.0] {
            let axis = Axis::holding(largest);
            let steps = axis.end / axis.step;
            assert!(axis.end >= largest * 0.999_999, "{largest}");
            assert!((4.0..=10.5).contains(&steps), "{largest}: {steps}");
        }
        assert_eq!(Axis::holding(f64::NAN).end, 1.0);
        assert_eq!(Axis::holding(0.0).end, 1.0);
    }
}
