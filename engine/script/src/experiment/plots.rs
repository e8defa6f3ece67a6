//! `plot(…)`: curves as a picture.

use rhai::{Array, Dynamic, Map};

use super::bench::Bench;
use super::images::out_path;
use super::laboratory::{Chart, ChartCurve};
use super::options::Options;
use crate::api::{Api, Arguments, Mistake, as_number};

/// The most curves of a plot, and points of a curve.
const MOST_CURVES: usize = 64;
const MOST_POINTS: usize = 100_000;

pub(super) fn register(api: &mut Api, bench: &Bench) {
    api.section("Plots");
    for form in ["plot(path, curves)", "plot(path, curves, options)"] {
        let bench = bench.clone();
        api.function(
            form,
            "Draws curves and writes them to a file of the project's folder `out` that ends in `.svg`. `curves` is \
             a map: a name for each curve, and its points, `[x, y]` or, with an interval in which y may lie too, \
             `[x, y, low, high]`. Options: `title`; `x` and `y`, what the axes are; `logarithmic`, for axes on \
             which each factor of ten has the same length. Gives the path.",
            move |arguments| {
                let path = out_path(arguments, "plot", &[".svg"])?;
                let chart = chart(arguments)?;
                bench.work(|laboratory| Ok(bench.write(&path, &laboratory.plot(&chart))))??;
                Ok(path)
            },
        );
    }
}

fn chart(arguments: &Arguments) -> Result<Chart, Mistake> {
    let options = Options::read(arguments, 2, "plot", &["title", "x", "y", "logarithmic"])?;
    let logarithmic = options.switch("logarithmic")?;
    let Some(given) = arguments.value(1).read_lock::<Map>() else {
        return Err(arguments.wrong(
            1,
            "a map of curves, as in `#{ forward: [[4, 2.1], [8, 3.9]] }`",
        ));
    };
    if given.is_empty() || given.len() > MOST_CURVES {
        let count = given.len();
        let message = format!("a plot has 1 to {MOST_CURVES} curves, not {count}");
        return Err(Mistake::new(message));
    }
    let curves = given.iter().map(|(name, points)| {
        curve(arguments, name, points, logarithmic).map_err(|mistake| Mistake {
            message: format!("`{name}`: {}", mistake.message),
            ..mistake
        })
    });
    let text = |name| Ok::<_, Mistake>(options.text(name)?.unwrap_or_default());
    Ok(Chart {
        title: text("title")?,
        x: text("x")?,
        y: text("y")?,
        logarithmic: [logarithmic; 2],
        curves: curves.collect::<Result<_, _>>()?,
    })
}

fn curve(
    arguments: &Arguments,
    name: &str,
    points: &Dynamic,
    logarithmic: bool,
) -> Result<ChartCurve, Mistake> {
    let pairs = "a point is written `[x, y]`, or `[x, y, low, high]`";
    let Some(points) = points.read_lock::<Array>() else {
        let message = format!(
            "a curve is an array of points, not {}",
            arguments.describe(points)
        );
        return Err(Mistake::new(message).with_hint(pairs));
    };
    if points.len() > MOST_POINTS {
        let count = points.len();
        let message = format!("a curve has at most {MOST_POINTS} points, not {count}");
        return Err(Mistake::new(message));
    }
    let mut curve = ChartCurve {
        name: name.to_owned(),
        ..ChartCurve::default()
    };
    for (index, point) in points.iter().enumerate() {
        let number = index + 1;
        let wrong =
            || Mistake::new(format!("point {number} is no pair of numbers")).with_hint(pairs);
        let point = point.read_lock::<Array>().ok_or_else(wrong)?;
        let numbers: Option<Vec<f64>> = point.iter().map(as_number).collect();
        let numbers = numbers.ok_or_else(wrong)?;
        if let Some(odd) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(crate::api::not_finite(&format!("point {number}"), *odd));
        }
        if logarithmic && numbers.iter().any(|number| *number <= 0.0) {
            let message =
                format!("point {number} is not above 0, and has no place on a logarithmic axis");
            return Err(Mistake::new(message));
        }
        match *numbers.as_slice() {
            [x, y] => {
                curve.points.push([x, y]);
                curve.intervals.push([y, y]);
            }
            [x, y, low, high] => {
                curve.points.push([x, y]);
                curve.intervals.push([low.min(high), high.max(low)]);
            }
            _ => return Err(wrong()),
        }
    }
    Ok(curve)
}
