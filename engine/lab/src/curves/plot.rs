//! Curves as an SVG picture with logarithmic axes.

use super::drawing::{line, mark, plain, sheet, stroke, text, whisker};
use super::scale::LogScale;
use super::style::Style;
use super::{Curve, Curves, End, Head};
use crate::report::format::significant;
use crate::report::html::writer::Writer;

/// The picture.
const WIDTH: f64 = 1180.0;
const HEIGHT: f64 = 700.0;
/// The rectangle in which curves lie.
const LEFT: f64 = 78.0;
const RIGHT: f64 = 760.0;
const TOP: f64 = 84.0;
const BOTTOM: f64 = 600.0;
/// From one line of the legend to the next.
const ROW: f64 = 37.0;

/// Draws the curves: a mark at each point with the interval of its median, and a bar across the end of
/// a curve that ends at a limit.
pub fn plot(curves: &Curves) -> String {
    let points = || curves.curves.iter().flat_map(|curve| &curve.points);
    let x = LogScale::holding(points().map(|point| f64::from(point.at)), LEFT, RIGHT);
    let times = points().filter_map(|point| point.gpu);
    let ends = times.flat_map(|gpu| {
        let interval = gpu.median_interval;
        let (low, high) = interval.map_or((gpu.min, gpu.max), |i| (i.low, i.high));
        [low, high, gpu.median]
    });
    let y = LogScale::holding(ends, BOTTOM, TOP);

    sheet([WIDTH, HEIGHT], |w| {
        heading(w, &curves.head);
        axes(w, curves, &x, &y);
        for (index, curve) in curves.curves.iter().enumerate() {
            draw(w, curve, Style::of(index), &x, &y);
        }
        legend(w, curves);
    })
}

fn heading(w: &mut Writer, head: &Head) {
    let scene = std::iter::once(&head.scene).chain(&head.settings);
    let scene: Vec<&str> = scene.map(String::as_str).collect();
    let title = format!("{}: {}", scene.join(" "), head.clock());
    text(w, [LEFT, 28.0], 18, "start", &title);
    let about = format!(
        "{} × {}, median of {} frames with its 95 % interval; {}, {} {}; {}, {} cores; Lightbench {}",
        head.size.0,
        head.size.1,
        head.frames,
        head.adapter.name,
        head.adapter.driver,
        head.adapter.driver_info,
        head.machine.cpu,
        head.machine.cores,
        head.version
    );
    text(w, [LEFT, 50.0], 12, "start", &about);
}

fn axes(w: &mut Writer, curves: &Curves, x: &LogScale, y: &LogScale) {
    for (value, labelled) in y.ticks() {
        let at = y.at(value);
        let shade = if labelled { "#c4c4c4" } else { "#ececec" };
        line(w, &format!("M{LEFT} {at:.1}H{RIGHT}"), shade, 1.0);
        if labelled {
            text(w, [LEFT - 8.0, at + 4.5], 14, "end", &plain(value));
        }
    }
    // A line at each value that was swept; limits lie between.
    let mut values: Vec<u32> = curves.curves.iter().flat_map(swept).collect();
    values.sort_unstable();
    values.dedup();
    for value in values {
        let at = x.at(f64::from(value));
        line(w, &format!("M{at:.1} {TOP}V{BOTTOM}"), "#c4c4c4", 1.0);
        text(w, [at, BOTTOM + 20.0], 14, "middle", &value.to_string());
    }
    line(
        w,
        &format!("M{LEFT} {TOP}V{BOTTOM}H{RIGHT}"),
        "#1a1a1a",
        1.2,
    );
    let head = &curves.head;
    let about = match head.about.is_empty() {
        true => head.parameter.clone(),
        false => format!("{}: {}", head.parameter, head.about),
    };
    text(
        w,
        [(LEFT + RIGHT) / 2.0, BOTTOM + 44.0],
        15,
        "middle",
        &about,
    );
    text(w, [LEFT, TOP - 10.0], 14, "start", "ms a frame");
}

/// The values at which a curve was measured because they were asked for.
fn swept(curve: &Curve) -> Vec<u32> {
    let limit = match &curve.end {
        Some(End::Limit { last, .. }) => Some(*last),
        _ => None,
    };
    let points = curve.points.iter().map(|point| point.at);
    points.filter(|at| Some(*at) != limit).collect()
}

fn draw(w: &mut Writer, curve: &Curve, style: Style, x: &LogScale, y: &LogScale) {
    let places: Vec<_> = curve
        .points
        .iter()
        .filter_map(|point| Some((x.at(f64::from(point.at)), point.gpu?)))
        .collect();
    let steps = places.iter().enumerate().map(|(index, (at, gpu))| {
        let command = if index == 0 { 'M' } else { 'L' };
        format!("{command}{at:.1} {:.1}", y.at(gpu.median))
    });
    stroke(w, &steps.collect::<String>(), style);
    for (at, gpu) in &places {
        if let Some(interval) = gpu.median_interval {
            let (low, high) = (y.at(interval.low), y.at(interval.high));
            whisker(w, *at, [low, high], style);
        }
        mark(w, [*at, y.at(gpu.median)], style);
    }
    if let (Some(end), Some((at, gpu))) = (&curve.end, places.last()) {
        let at_y = y.at(gpu.median);
        let path = match end {
            // A wall that the curve runs into.
            End::Limit { .. } => format!("M{:.1} {:.1}v26", at + 9.0, at_y - 13.0),
            // An arrow: it goes on, unmeasured.
            End::Slow { .. } => format!("M{:.1} {at_y:.1}h14m-5 -4l5 4l-5 4", at + 8.0),
        };
        line(w, &path, style.colour, 3.0);
    }
}

/// One line a curve, the costliest at the top, with what its end means below its name.
fn legend(w: &mut Writer, curves: &Curves) {
    let mut order: Vec<(usize, &Curve)> = curves.curves.iter().enumerate().collect();
    let last = |curve: &Curve| {
        let point = curve.points.last();
        let time = point
            .and_then(|point| point.gpu)
            .map_or(0.0, |gpu| gpu.median);
        (point.map_or(0, |point| point.at), time)
    };
    order.sort_by(|(_, a), (_, b)| {
        let ((at_a, time_a), (at_b, time_b)) = (last(a), last(b));
        at_b.cmp(&at_a).then(time_b.total_cmp(&time_a))
    });
    for (row, (index, curve)) in order.into_iter().enumerate() {
        let style = Style::of(index);
        let (left, at) = (RIGHT + 36.0, TOP + 8.0 + ROW * row as f64);
        stroke(w, &format!("M{left} {at}h40"), style);
        mark(w, [left + 20.0, at], style);
        let at_name = [left + 50.0, at + 5.0];
        let name = match curve
            .points
            .last()
            .and_then(|point| Some((point.at, point.gpu?)))
        {
            Some((value, gpu)) => {
                format!("{}: {} ms at {value}", curve.title, significant(gpu.median))
            }
            None => format!("{}: not measured", curve.title),
        };
        text(w, at_name, 14, "start", &name);
        if let Some(end) = &curve.end {
            text(
                w,
                [at_name[0], at_name[1] + 15.0],
                11,
                "start",
                &end.in_words(),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curves::sample;

    #[test]
    fn points_lie_where_their_values_are_and_limits_are_marked() {
        let mut curves = sample::curves();
        let svg = plot(&curves);
        // Four and three points, and a sample of each in the legend.
        assert_eq!(svg.matches("translate(").count(), 7 + 2);
        assert_eq!(svg.matches("v26").count(), 1, "one curve ends at a limit");
        assert!(svg.contains("limit 37; at 38: 12 × Pixels that lost lights"));
        assert!(svg.contains("software driver"));
        // Names of drivers and scenes are somebody else's text.
        assert!(svg.contains("llvmpipe, &quot;soft&quot;"));

        // Time doubles from 9 to 18 ms over the same length wherever it does.
        curves.curves = vec![sample::curve("a", &[1, 2, 4], |x| 9.0 * x, None)];
        let svg = plot(&curves);
        // The first path with lines from point to point; axes have none.
        let mut paths = svg.split("d=\"M").skip(1);
        let path = paths.find_map(|rest| {
            let path = rest.split('"').next()?;
            path.contains('L').then_some(path)
        });
        let path = path.unwrap_or_default();
        let numbers: Vec<f64> = path
            .split(['M', 'L', ' '])
            .filter_map(|number| number.parse().ok())
            .collect();
        let [x0, y0, x1, y1, x2, y2] = numbers[..] else {
            panic!("three points in `{path}`");
        };
        assert!((x2 - x1 - (x1 - x0)).abs() < 0.25 && (y2 - y1 - (y1 - y0)).abs() < 0.25);
        assert!(x1 > x0 && y1 < y0, "up and to the right: {path}");
    }

    #[test]
    fn nothing_measured_is_drawn_too() {
        let mut curves = sample::curves();
        curves.curves[0].points.clear();
        curves.curves.truncate(1);
        assert!(plot(&curves).contains("not measured"));
        curves.curves.clear();
        assert!(plot(&curves).starts_with("<svg"));
    }
}
