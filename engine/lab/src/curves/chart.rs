//! Curves that a script has computed, as a picture.

use lightbench_script::{Chart, ChartCurve};

use super::drawing::{line, mark, plain, sheet, stroke, text, whisker};
use super::linear_scale::LinearScale;

use super::scale::LogScale;
use super::style::Style;
use crate::report::html::writer::Writer;

const WIDTH: f64 = 900.0;
const LEFT: f64 = 80.0;
const RIGHT: f64 = 660.0;
const TOP: f64 = 64.0;
const BOTTOM: f64 = 420.0;
const HEIGHT: f64 = 480.0;
/// From one line of the legend to the next.
const ROW: f64 = 22.0;
/// Width of a character of the legend: more than most have in any sans serif.
const CHARACTER: f64 = 8.0;
/// Points beyond which their marks would hide the curve.
const MOST_MARKS: usize = 40;

/// An axis of either kind.
enum Scale {
    Linear(LinearScale),
    Log(LogScale),
}

impl Scale {
    fn holding(logarithmic: bool, values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        match logarithmic {
            true => Self::Log(LogScale::holding(values, from, to)),
            false => Self::Linear(LinearScale::holding(values, from, to)),
        }
    }

    fn at(&self, value: f64) -> f64 {
        match self {
            Self::Linear(scale) => scale.at(value),
            Self::Log(scale) => scale.at(value),
        }
    }

    fn ticks(&self) -> Vec<(f64, bool)> {
        match self {
            Self::Linear(scale) => scale.ticks(),
            Self::Log(scale) => scale.ticks(),
        }
    }
}

/// Draws a chart as SVG.
pub fn chart(chart: &Chart) -> String {
    let points = || chart.curves.iter().flat_map(|curve| &curve.points);
    let ends = || chart.curves.iter().flat_map(|curve| &curve.intervals);
    let [log_x, log_y] = chart.logarithmic;
    let x = Scale::holding(log_x, points().map(|point| point[0]), LEFT, RIGHT);
    let values = points().map(|point| point[1]);
    let y = Scale::holding(log_y, values.chain(ends().flatten().copied()), BOTTOM, TOP);

    let legend = TOP + ROW * chart.curves.len() as f64;
    sheet([width(chart), HEIGHT.max(legend + ROW)], |w| {
        text(w, [LEFT, 28.0], 18, "start", &chart.title);
        axes(w, chart, &x, &y);
        for (index, curve) in chart.curves.iter().enumerate() {
            let style = Style::of(index);
            draw(w, curve, style, &x, &y);
            let at = TOP + 8.0 + ROW * index as f64;
            stroke(w, &format!("M{} {at}h36", RIGHT + 24.0), style);
            mark(w, [RIGHT + 42.0, at], style);
            text(w, [RIGHT + 70.0, at + 5.0], 14, "start", &curve.name);
        }
    })
}

/// Wide enough for the longest name beside the curves, and for the title over them.
fn width(chart: &Chart) -> f64 {
    let characters = |text: &str| text.chars().count() as f64;
    let names = chart.curves.iter().map(|curve| characters(&curve.name));
    let names = RIGHT + 80.0 + CHARACTER * names.fold(0.0, f64::max);
    let title = LEFT + 10.0 + CHARACTER * 18.0 / 14.0 * characters(&chart.title);
    WIDTH.max(names).max(title)
}

fn axes(w: &mut Writer, chart: &Chart, x: &Scale, y: &Scale) {
    let shade = |labelled: bool| if labelled { "#c4c4c4" } else { "#ececec" };
    for (value, labelled) in y.ticks() {
        let at = y.at(value);
        line(w, &format!("M{LEFT} {at:.1}H{RIGHT}"), shade(labelled), 1.0);
        if labelled {
            text(w, [LEFT - 8.0, at + 4.5], 14, "end", &plain(value));
        }
    }
    for (value, labelled) in x.ticks() {
        let at = x.at(value);
        line(w, &format!("M{at:.1} {TOP}V{BOTTOM}"), shade(labelled), 1.0);
        if labelled {
            text(w, [at, BOTTOM + 20.0], 14, "middle", &plain(value));
        }
    }
    let frame = format!("M{LEFT} {TOP}V{BOTTOM}H{RIGHT}");
    line(w, &frame, "#1a1a1a", 1.2);
    let middle = (LEFT + RIGHT) / 2.0;
    text(w, [middle, BOTTOM + 44.0], 15, "middle", &chart.x);
    text(w, [LEFT, TOP - 10.0], 14, "start", &chart.y);
}

fn draw(w: &mut Writer, curve: &ChartCurve, style: Style, x: &Scale, y: &Scale) {
    let places: Vec<[f64; 2]> = curve
        .points
        .iter()
        .map(|[a, b]| [x.at(*a), y.at(*b)])
        .collect();
    let steps = places.iter().enumerate().map(|(index, [a, b])| {
        let command = if index == 0 { 'M' } else { 'L' };
        format!("{command}{a:.1} {b:.1}")
    });
    stroke(w, &steps.collect::<String>(), style);
    for ([at, _], [low, high]) in places.iter().zip(&curve.intervals) {
        if low < high {
            let (low, high) = (y.at(*low), y.at(*high));
            whisker(w, *at, [low, high], style);
        }
    }
    if places.len() <= MOST_MARKS {
        for place in places {
            mark(w, place, style);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(logarithmic: bool) -> Chart {
        let curve = |name: &str, factor: f64| ChartCurve {
            name: name.to_owned(),
            points: [1.0, 10.0, 100.0].map(|x| [x, factor * x]).to_vec(),
            intervals: vec![
                [factor, factor],
                [9.0 * factor, 11.0 * factor],
                [99.0, 99.0],
            ],
        };
        Chart {
            title: "a < b".to_owned(),
            x: "lights".to_owned(),
            y: "ms".to_owned(),
            logarithmic: [logarithmic; 2],
            curves: vec![curve("one", 1.0), curve("two", 2.0)],
        }
    }

    /// The points of the first curve's stroke.
    fn stroke(svg: &str) -> Vec<[f64; 2]> {
        let stroke = svg.split("stroke-width=\"2\"").next().unwrap_or_default();
        let path = stroke.rsplit("d=\"M").next().unwrap_or_default();
        let path = path.split('"').next().unwrap_or_default();
        let pair = |point: &str| {
            let mut numbers = point.split(' ').filter_map(|number| number.parse().ok());
            Some([numbers.next()?, numbers.next()?])
        };
        path.split('L').filter_map(pair).collect()
    }

    #[test]
    fn long_names_and_titles_have_room() {
        let named = |name: &str, title: &str| {
            let curve = ChartCurve {
                name: name.to_owned(),
                ..ChartCurve::default()
            };
            width(&Chart {
                title: title.to_owned(),
                curves: vec![curve],
                ..Chart::default()
            })
        };
        assert_eq!(named("short", "short"), WIDTH);
        // 31 characters, which browsers draw some 220 units wide.
        assert!(named("World-space light-indexed forward", "") > RIGHT + 70.0 + 240.0);
        assert!(named("", &"a".repeat(120)) > 1200.0);
    }

    #[test]
    fn a_power_law_is_straight_on_logarithmic_axes_alone() {
        for logarithmic in [true, false] {
            let svg = chart(&sample(logarithmic));
            let [a, b, c] = stroke(&svg)[..] else {
                panic!("three points: {svg}");
            };
            let middle = (b[0] - a[0]) / (c[0] - a[0]);
            let expected = if logarithmic { 0.5 } else { 9.0 / 99.0 };
            assert!((middle - expected).abs() < 2e-3, "{middle}");
            assert!(a[1] > b[1] && b[1] > c[1], "larger values stand higher");
        }
    }

    #[test]
    fn names_are_escaped_and_intervals_drawn_where_there_are_some() {
        let svg = chart(&sample(false));
        assert!(svg.contains("a &lt; b") && svg.contains("two"));
        assert_eq!(svg.matches("m-3 0h6").count(), 2);
        // Three marks a curve and one in the legend.
        assert_eq!(svg.matches("translate(").count(), 8);
    }
}
