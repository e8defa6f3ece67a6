//! Curves as a CSV table, under a head of lines that begin with `#`.

use super::{Curves, End, Head, Point};
use crate::report::csv::{Table, cell};
use crate::statistics::Summary;

/// The table: one row a point, then, where a curve ends early, one with the reason.
///
/// An empty cell means "not measured". Times are in milliseconds.
pub fn table(curves: &Curves) -> String {
    let head = &curves.head;
    let mut table = Table::new(&[
        "pipeline",
        &head.parameter,
        "gpu_median_ms",
        "gpu_low_ms",
        "gpu_high_ms",
        "cpu_median_ms",
        "lights_evaluated_a_pixel",
        "lights_reaching_a_pixel",
        "overdraw",
        "fragments_a_pixel",
        "draws",
        "end",
    ]);
    for curve in &curves.curves {
        for point in &curve.points {
            let mut row = vec![curve.pipeline.clone(), point.at.to_string()];
            row.extend(cells(point));
            row.push(String::new());
            table.row(row);
        }
        if let Some(end) = &curve.end {
            let (End::Limit { last, .. } | End::Slow { last, .. }) = end;
            let mut row = vec![curve.pipeline.clone(), last.to_string()];
            row.extend(vec![String::new(); 9]);
            row.push(end.in_words());
            table.row(row);
        }
    }
    lines(head) + table.text().as_str()
}

fn cells(point: &Point) -> [String; 9] {
    let interval = |pick: fn(crate::statistics::Interval) -> f64| {
        let interval = point.gpu.and_then(|gpu| gpu.median_interval);
        rounded(interval.map(pick))
    };
    let median = |times: Option<Summary>| rounded(times.map(|times| times.median));
    [
        median(point.gpu),
        interval(|interval| interval.low),
        interval(|interval| interval.high),
        median(point.cpu),
        rounded(point.lights_evaluated),
        rounded(point.lights_reaching),
        rounded(point.overdraw),
        rounded(point.fragments),
        point.draws.to_string(),
    ]
}

/// Three decimals: a microsecond, or a thousandth of a light.
fn rounded(value: Option<f64>) -> String {
    cell(
        value
            .filter(|value| value.is_finite())
            .map(|value| format!("{value:.3}")),
    )
}

/// The head, with a `#` before each line.
fn lines(head: &Head) -> String {
    let mut lines = String::new();
    for (name, value) in head.facts() {
        // A line end in a name must not begin a row.
        let value: String = value
            .chars()
            .map(|c| if c.is_control() { ' ' } else { c })
            .collect();
        lines += &format!("# {name}: {value}\r\n");
    }
    lines
}

impl Head {
    /// What has to be known beside the numbers, line by line.
    pub fn facts(&self) -> Vec<(&'static str, String)> {
        let Self {
            machine, adapter, ..
        } = self;
        let scene = std::iter::once(&self.scene).chain(&self.settings);
        let scene: Vec<&str> = scene.map(String::as_str).collect();
        vec![
            ("Lightbench", self.version.clone()),
            ("command", self.command.clone()),
            ("measured", self.created.clone()),
            (
                "machine",
                format!("{}, {} cores, {}", machine.cpu, machine.cores, machine.os),
            ),
            (
                "adapter",
                format!(
                    "{}, {}, {} {}",
                    adapter.name, adapter.backend, adapter.driver, adapter.driver_info
                ),
            ),
            (
                "times",
                format!("{}, ms; median with its 95 % interval", self.clock()),
            ),
            ("resolution", format!("{} × {}", self.size.0, self.size.1)),
            ("frames at each point", self.frames.to_string()),
            ("scene", scene.join(" ")),
            ("axis", format!("{}: {}", self.parameter, self.about)),
        ]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::curves::sample;

    #[test]
    fn a_head_stands_over_one_row_a_point_and_one_an_end() {
        let mut curves = sample::curves();
        curves.head.settings = vec!["seed=1\n9,9".to_owned()];
        let text = table(&curves);
        let (head, rows): (Vec<&str>, Vec<&str>) = text
            .split_terminator("\r\n")
            .partition(|line| line.starts_with('#'));
        for wanted in [
            "software driver",
            "640 × 360",
            "Lightbench: 0.1.0",
            "axis: lights",
        ] {
            assert!(
                head.iter().any(|line| line.contains(wanted)),
                "{wanted}\n{text}"
            );
        }
        assert_eq!(rows.len(), 1 + 4 + 3 + 1, "{text}");
        // Made-up times: median 2 + x / 2, and the interval of seven values is all of them.
        assert_eq!(rows[1], "linear,4,4.000,3.600,4.400,1.000,2.000,,,,0,");
        assert_eq!(
            rows[8],
            "short,37,,,,,,,,,,limit 37; at 38: 12 × Pixels that lost lights"
        );
        let columns = rows[0].split(',').count();
        assert!(rows.iter().all(|row| row.split(',').count() == columns));
    }
}
