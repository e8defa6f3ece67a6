//! The numbers of a comparison as CSV tables (RFC 4180, UTF-8, one header line).
//!
//! An empty cell means "not measured". Times are in milliseconds, sizes in bytes.

use super::model::{Comparison, PipelineResult};
use crate::statistics::Summary;
use crate::study::Study;

/// A table in the making.
pub(crate) struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with its header line.
    pub(crate) fn new(header: &[&str]) -> Self {
        Self {
            header: header.iter().map(|h| (*h).to_owned()).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The table so far.
    pub(crate) fn text(self) -> String {
        let mut text = String::new();
        for row in std::iter::once(&self.header).chain(&self.rows) {
            for (i, cell) in row.iter().enumerate() {
                if i > 0 {
                    text.push(',');
                }
                if cell.contains([',', '"', '\n', '\r']) {
                    text.push('"');
                    text.push_str(&cell.replace('"', "\"\""));
                    text.push('"');
                } else {
                    text.push_str(cell);
                }
            }
            text.push_str("\r\n");
        }
        text
    }
}

/// One table of all points: before the columns of `table` the point's key and a column
/// `at_NAME` for each coordinate.
pub(crate) fn of_study(study: &Study, table: fn(&Comparison) -> Table) -> String {
    let mut names: Vec<&str> = Vec::new();
    for coordinate in study.points.iter().flat_map(|point| &point.coordinates) {
        if !names.contains(&coordinate.name.as_str()) {
            names.push(&coordinate.name);
        }
    }
    let mut all = Table::new(&["point"]);
    all.header
        .extend(names.iter().map(|name| format!("at_{name}")));
    all.header.extend(table(&Comparison::default()).header);
    for point in &study.points {
        let place = names.iter().map(|name| {
            let found = point.coordinates.iter().find(|c| c.name == *name);
            found.map_or_else(String::new, |c| c.value.clone())
        });
        let place: Vec<String> = std::iter::once(point.key.clone()).chain(place).collect();
        let rows = table(&point.comparison).rows.into_iter();
        all.rows
            .extend(rows.map(|row| [place.clone(), row].concat()));
    }
    all.text()
}

/// Makes a table of one comparison.
pub(crate) type MakeTable = fn(&Comparison) -> Table;

/// The tables of a report with their files' names.
pub(crate) const TABLES: [(&str, MakeTable); 6] = [
    ("pipelines.csv", pipelines),
    ("systems.csv", systems),
    ("passes.csv", passes),
    ("frames.csv", frames),
    ("targets.csv", targets),
    ("counters.csv", counters),
];

pub(crate) fn cell<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// One row a pipeline: frame times, memory and picture metrics.
pub(crate) fn pipelines(c: &Comparison) -> Table {
    let mut table = Table::new(&[
        "pipeline",
        "scene",
        "width",
        "height",
        "adapter",
        "software",
        "frames",
        "gpu_median_ms",
        "gpu_low_ms",
        "gpu_high_ms",
        "gpu_p95_ms",
        "cpu_median_ms",
        "cpu_low_ms",
        "cpu_high_ms",
        "cpu_p95_ms",
        "processes",
        "cut",
        "target_bytes",
        "flip_mean",
        "flip_p99",
        "flip_max",
        "flip_bound",
        "flip_share_over_bound",
        "rmse_srgb",
        "psnr_srgb_db",
        "ssim",
        "rmse_linear",
        "relmse_linear",
    ]);
    for p in &c.pipelines {
        let mut row = vec![
            p.name.clone(),
            c.scene.clone(),
            c.size[0].to_string(),
            c.size[1].to_string(),
            c.adapter.name.clone(),
            c.adapter.software.to_string(),
            c.frames.to_string(),
        ];
        row.extend(times(p.gpu_samples().and_then(Summary::of)));
        row.extend(times(Summary::of(&p.frame_cpu_ms)));
        row.push(c.processes.len().max(1).to_string());
        row.push(p.cut.to_string());
        row.push(p.target_bytes_total.to_string());
        row.extend(picture(p));
        table.row(row);
    }
    table
}

fn times(summary: Option<Summary>) -> [String; 4] {
    let interval = summary.and_then(|s| s.median_interval);
    [
        cell(summary.map(|s| s.median)),
        cell(interval.map(|i| i.low)),
        cell(interval.map(|i| i.high)),
        cell(summary.map(|s| s.p95)),
    ]
}

fn picture(p: &PipelineResult) -> [String; 10] {
    let d = p.difference.as_ref();
    let l = p.linear_difference.as_ref();
    [
        cell(d.map(|d| d.flip.mean)),
        cell(d.map(|d| d.flip.p99)),
        cell(d.map(|d| d.flip.max)),
        cell(d.map(|d| d.flip.bound)),
        cell(d.map(|d| d.flip.share_over_bound)),
        cell(d.map(|d| d.srgb.rmse)),
        cell(d.and_then(|d| finite(d.srgb.psnr_db))),
        cell(d.map(|d| d.ssim)),
        cell(l.and_then(|l| finite(l.rmse))),
        cell(l.and_then(|l| finite(l.rel_mse))),
    ]
}

/// One row a pass: times, counts and modelled bytes.
pub(crate) fn passes(c: &Comparison) -> Table {
    let mut table = Table::new(&[
        "pipeline",
        "pass",
        "kind",
        "software",
        "gpu_median_ms",
        "gpu_low_ms",
        "gpu_high_ms",
        "gpu_p95_ms",
        "cpu_median_ms",
        "cpu_low_ms",
        "cpu_high_ms",
        "cpu_p95_ms",
        "draws",
        "instances",
        "triangles",
        "fragments",
        "vertices",
        "dispatches",
        "bytes_read_modelled",
        "bytes_written_modelled",
        "bytes_stencil_modelled",
        "bytes_loaded_modelled",
        "bytes_stored_modelled",
        "bytes_overdraw_modelled",
        "why_not",
    ]);
    for p in &c.pipelines {
        for pass in &p.passes {
            let mut row = vec![
                p.name.clone(),
                pass.name.clone(),
                pass.kind.clone(),
                c.adapter.software.to_string(),
            ];
            row.extend(times(pass.gpu_ms.as_deref().and_then(Summary::of)));
            row.extend(times(Summary::of(&pass.cpu_ms)));
            row.extend([pass.draws, pass.instances, pass.triangles].map(|n| n.to_string()));
            row.extend([pass.fragments, pass.vertices].map(cell));
            row.push(pass.dispatches.to_string());
            row.extend([pass.bytes_read, pass.bytes_written].map(|n| n.to_string()));
            row.extend(
                [pass.bytes_stencil, pass.bytes_loaded, pass.bytes_stored].map(|n| n.to_string()),
            );
            row.push(cell(pass.bytes_overdraw));
            row.push(pass.why_not.clone().unwrap_or_default());
            table.row(row);
        }
    }
    table
}

/// One row a system of a pipeline's frames: CPU time of the thread that ran it.
pub(crate) fn systems(c: &Comparison) -> Table {
    let mut table = Table::new(&[
        "pipeline",
        "system",
        "thread_median_ms",
        "thread_low_ms",
        "thread_high_ms",
        "thread_p95_ms",
    ]);
    for p in &c.pipelines {
        for system in &p.systems {
            let mut row = vec![p.name.clone(), system.name.clone()];
            row.extend(times(Summary::of(&system.thread_ms)));
            table.row(row);
        }
    }
    table
}

/// One row a measured frame of a pipeline, with the process that measured it.
pub(crate) fn frames(c: &Comparison) -> Table {
    let mut table = Table::new(&[
        "pipeline", "process", "frame", "gpu_ms", "cpu_ms", "wall_ms",
    ]);
    for p in &c.pipelines {
        let series = [
            p.frame_gpu_ms.as_deref().unwrap_or_default(),
            &p.frame_cpu_ms,
            &p.frame_wall_ms,
        ];
        let parts = series.map(|series| p.by_process(series));
        for process in 0..parts[0].len() {
            let parts = parts.each_ref().map(|parts| parts[process]);
            let longest = parts.iter().map(|part| part.len()).max().unwrap_or(0);
            for frame in 0..longest {
                let mut row = vec![p.name.clone(), process.to_string(), frame.to_string()];
                row.extend(parts.map(|part| cell(part.get(frame).copied().and_then(finite))));
                table.row(row);
            }
        }
    }
    table
}

/// One row a counter of a pipeline: the median over the measured frames.
pub(crate) fn counters(c: &Comparison) -> Table {
    let mut table = Table::new(&["pipeline", "counter", "description", "median"]);
    for p in &c.pipelines {
        for counter in &p.counters {
            table.row([
                p.name.clone(),
                counter.name.clone(),
                counter.description.clone(),
                cell(Summary::of(&counter.values).map(|s| s.median)),
            ]);
        }
    }
    table
}

/// One row a target.
pub(crate) fn targets(c: &Comparison) -> Table {
    let mut table = Table::new(&[
        "pipeline", "target", "format", "width", "height", "samples", "bytes",
    ]);
    for p in &c.pipelines {
        for t in &p.targets {
            let [width, height] = t.size.map(|s| s.to_string());
            let (samples, bytes) = (t.samples.to_string(), t.bytes.to_string());
            table.row([
                p.name.clone(),
                t.name.clone(),
                t.format.clone(),
                width,
                height,
                samples,
                bytes,
            ]);
        }
    }
    table
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::sample;

    #[test]
    fn every_row_has_the_cells_of_the_header() {
        let mut c = sample::comparison();
        c.adapter.name = "llvmpipe".into();
        c.pipelines[0].frame_gpu_ms = None;
        for text in [
            pipelines(&c),
            systems(&c),
            passes(&c),
            frames(&c),
            targets(&c),
        ] {
            let text = text.text();
            let mut lines = text.split("\r\n");
            let columns = lines.next().unwrap().split(',').count();
            let rows: Vec<&str> = lines.filter(|l| !l.is_empty()).collect();
            assert!(!rows.is_empty());
            assert!(
                rows.iter().all(|r| r.split(',').count() == columns),
                "{text}"
            );
        }
        assert_eq!(
            frames(&c).text().lines().count(),
            1 + c.pipelines.len() * c.frames as usize
        );
    }

    #[test]
    fn a_study_says_of_each_row_at_which_point_and_in_which_process() {
        let study = sample::study(&[16, 64], |lights| [lights, 2.0 * lights]);
        let text = of_study(&study, frames);
        let mut lines = text.lines();
        assert_eq!(
            lines.next(),
            Some("point,at_scene,at_lights,pipeline,process,frame,gpu_ms,cpu_ms,wall_ms")
        );
        // Two points, two pipelines, five processes, twelve frames.
        assert_eq!(lines.clone().count(), 2 * 2 * 5 * 12);
        let second = lines.nth(12).unwrap();
        assert!(
            second.starts_with("\"scene=atrium,lights=16\",atrium,16,deferred_shading,1,0,"),
            "{second}"
        );
    }

    #[test]
    fn hostile_cells_are_quoted() {
        let mut table = Table::new(&["a", "b"]);
        table.row(["x,\"y\"\n".to_owned(), "<b>".to_owned()]);
        assert_eq!(table.text(), "a,b\r\n\"x,\"\"y\"\"\n\",<b>\r\n");
    }
}
