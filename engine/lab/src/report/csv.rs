//! The numbers of a comparison as CSV tables (RFC 4180, UTF-8, one header line).
//!
//! An empty cell means "not measured". Times are in milliseconds, sizes in bytes.

use super::model::{Comparison, PipelineResult};
use crate::statistics::Summary;

/// A table in the making.
pub(crate) struct Table {
    text: String,
}

impl Table {
    /// A table with its header line.
    pub(crate) fn new(header: &[&str]) -> Self {
        let mut table = Self {
            text: String::new(),
        };
        table.row(header.iter().map(|h| (*h).to_owned()));
        table
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        for (i, cell) in cells.into_iter().enumerate() {
            if i > 0 {
                self.text.push(',');
            }
            if cell.contains([',', '"', '\n', '\r']) {
                self.text.push('"');
                self.text.push_str(&cell.replace('"', "\"\""));
                self.text.push('"');
            } else {
                self.text.push_str(&cell);
            }
        }
        self.text.push_str("\r\n");
    }

    /// The table so far.
    pub(crate) fn text(self) -> String {
        self.text
    }
}

pub(crate) fn cell<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// One row a pipeline: frame times, memory and picture metrics.
pub fn pipelines(c: &Comparison) -> String {
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
        row.push(p.target_bytes_total.to_string());
        row.extend(picture(p));
        table.row(row);
    }
    table.text
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
pub fn passes(c: &Comparison) -> String {
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
    table.text
}

/// One row a system of a pipeline's frames: CPU time of the thread that ran it.
pub fn systems(c: &Comparison) -> String {
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
    table.text
}

/// One row a measured frame of a pipeline.
pub fn frames(c: &Comparison) -> String {
    let mut table = Table::new(&["pipeline", "frame", "gpu_ms", "cpu_ms"]);
    for p in &c.pipelines {
        let gpu = p.frame_gpu_ms.as_deref().unwrap_or_default();
        for frame in 0..gpu.len().max(p.frame_cpu_ms.len()) {
            let at = |samples: &[f64]| cell(samples.get(frame).copied().and_then(finite));
            table.row([
                p.name.clone(),
                frame.to_string(),
                at(gpu),
                at(&p.frame_cpu_ms),
            ]);
        }
    }
    table.text
}

/// One row a target.
pub fn targets(c: &Comparison) -> String {
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
    table.text
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
            frames(&c).lines().count(),
            1 + c.pipelines.len() * c.frames as usize
        );
    }

    #[test]
    fn hostile_cells_are_quoted() {
        let mut table = Table::new(&["a", "b"]);
        table.row(["x,\"y\"\n".to_owned(), "<b>".to_owned()]);
        assert_eq!(table.text, "a,b\r\n\"x,\"\"y\"\"\n\",<b>\r\n");
    }
}
