//! The systems of the world and the passes of the pipeline on screen, and what each costs.

use std::time::{Duration, Instant};

use egui::{Align, Layout, RichText, ScrollArea, Sense, Ui, vec2};
use egui_extras::{Column, TableBuilder};
use lightbench::render::PassStatistics;

use super::pass_graph::{self, PassGraph};
use super::widgets::{MISSING, bytes, count, ms, short_count, sparkline};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// How often the numbers change: often enough to follow, seldom enough to read.
const REFRESH: Duration = Duration::from_millis(250);

/// One row.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    pub name: String,
    pub kind: &'static str,
    pub gpu_ms: Option<f64>,
    pub cpu_ms: Option<f64>,
    fragments: Option<u64>,
    vertices: Option<u64>,
    pub cost: PassStatistics,
}

/// What the panel shows at the moment.
#[derive(Default)]
pub struct PassesPanel {
    /// The graph, where that is shown instead of the list.
    pub(super) graph: PassGraph,
    as_graph: bool,
    pub(super) rows: Vec<Row>,
    /// Name and median of each system.
    systems: Vec<(&'static str, Option<f64>)>,
    /// What each counter of the pipeline counts, and its value; then lights without a place.
    counters: Vec<(String, Option<u32>)>,
    target_bytes: u64,
    pipeline: String,
    refreshed: Option<Instant>,
}

impl PassesPanel {
    /// The GPU time of the slowest pass.
    pub(super) fn slowest(&self) -> f64 {
        let times = self.rows.iter().filter_map(|row| row.gpu_ms);
        times.fold(0.0_f64, f64::max)
    }

    fn refresh(&mut self, editor: &mut crate::ui::workbench::Workbench, now: Instant) {
        let shown = editor.pipelines.shown().unwrap_or_default().to_owned();
        let due = self.refreshed.is_none_or(|at| now - at >= REFRESH);
        if !due && shown == self.pipeline {
            return;
        }
        self.refreshed = Some(now);
        self.pipeline = shown;
        self.rows.clear();
        self.systems.clear();
        let systems = editor.timings.systems.iter();
        self.systems
            .extend(systems.map(|system| (system.name, system.thread_ms.median())));
        let statistics = editor.statistics().clone();
        self.target_bytes = statistics.target_bytes;
        let Some(pipeline) = editor.pipelines.shown_pipeline() else {
            return;
        };
        self.graph.follow(&pipeline.desc);
        let counters = pipeline.desc.counters.iter().enumerate();
        self.counters = counters
            .map(|(index, counter)| {
                let value = editor.timings.counters.get(index).copied();
                (counter.description.clone(), value)
            })
            .collect();
        let passes = pipeline.desc.passes.iter().zip(&statistics.passes);
        self.counters.extend(passes.filter_map(|(pass, cost)| {
            Some((pass.unplaced_in_words()?, Some(cost.unplaced_lights)))
        }));
        if statistics.unconfined_lights > 0 {
            let about = say!("passes.lights_that_shine_beyond_their_clip").to_owned();
            self.counters
                .push((about, Some(statistics.unconfined_lights)));
        }
        for (index, pass) in pipeline.desc.passes.iter().enumerate() {
            let times = editor.timings.passes.get(index);
            self.rows.push(Row {
                name: pass.name.clone(),
                kind: pass.kind.name(),
                gpu_ms: times.and_then(|times| times.gpu_ms.median()),
                cpu_ms: times.and_then(|times| times.cpu_ms.median()),
                fragments: times.and_then(|times| times.fragments),
                vertices: times.and_then(|times| times.vertices),
                cost: statistics.passes.get(index).cloned().unwrap_or_default(),
            });
        }
    }
}

/// Draws the pass list.
pub fn show(editor: &mut Editor, ui: &mut Ui, now: Instant) {
    editor.passes.refresh(&mut editor.workbench, now);
    ui.horizontal(|ui| {
        let as_graph = &mut editor.passes.as_graph;
        ui.selectable_value(as_graph, false, say!("passes.list"));
        ui.selectable_value(as_graph, true, say!("passes.graph"));
    });
    if editor.passes.as_graph {
        pass_graph::show(editor, ui);
    } else {
        list(editor, ui);
    }
}

fn list(editor: &Editor, ui: &mut Ui) {
    let panel = &editor.passes;
    let workbench = &editor.workbench;
    let palette = Palette::of(ui);
    let missing = &workbench.gpu().summary.missing;
    let why = |feature: &str| {
        let lost = missing.iter().find(|text| text.starts_with(feature));
        lost.map_or_else(
            || say!("passes.not_measured_yet").to_owned(),
            |text| say!("passes.this_adapter_lacks", text = text),
        )
    };
    let (no_time, no_count) = (why("timestamp"), why("pipeline statistics"));

    totals(editor, ui, palette);
    ui.add_space(4.0);
    let slowest = panel.slowest();
    let height = 20.0;
    ScrollArea::horizontal().show(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let columns = [46.0, 52.0, 48.0, 38.0, 56.0, 58.0, 56.0, 56.0];
        let mut table = TableBuilder::new(ui).striped(true).column(
            Column::auto_with_initial_suggestion(96.0)
                .at_least(80.0)
                .clip(true),
        );
        for width in columns {
            table = table.column(Column::exact(width));
        }
        let titles = [
            (
                say!("passes.pass"),
                say!("passes.in_the_order_in_which_they"),
            ),
            ("", say!("passes.gpu_time_of_the_last_frames")),
            (
                say!("passes.gpu_ms"),
                say!("passes.time_on_the_gpu_median_of"),
            ),
            (
                say!("passes.cpu_ms"),
                say!("passes.time_to_record_the_pass_median"),
            ),
            (
                say!("passes.calls"),
                say!("passes.draw_calls_or_dispatches"),
            ),
            (
                say!("passes.triangles"),
                say!("passes.sent_to_the_rasteriser_before_clipping"),
            ),
            (
                say!("passes.fragments"),
                say!("passes.fragments_shaded_as_the_driver_counts"),
            ),
            (
                say!("passes.read"),
                say!("passes.bytes_read_from_targets_modelled_from"),
            ),
            (
                say!("passes.written"),
                say!("passes.bytes_written_to_targets_modelled_from"),
            ),
        ];
        table
            .header(height, |mut header| {
                for (index, (title, about)) in titles.into_iter().enumerate() {
                    header.col(|ui| {
                        let layout = if index == 0 {
                            Layout::left_to_right(Align::Center)
                        } else {
                            Layout::right_to_left(Align::Center)
                        };
                        ui.with_layout(layout, |ui| {
                            ui.label(RichText::new(title).small().weak())
                                .on_hover_text(about);
                        });
                    });
                }
            })
            .body(|body| {
                body.rows(height, panel.rows.len(), |mut table_row| {
                    let index = table_row.index();
                    let row = &panel.rows[index];
                    table_row.col(|ui| {
                        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                            let name = RichText::new(&row.name);
                            if row.cost.dropped {
                                let why = say!("passes.left_out_nobody_uses_what_it");
                                ui.label(name.weak()).on_hover_text(why);
                            } else {
                                ui.label(name).on_hover_text(row.kind);
                            }
                        });
                    });
                    table_row.col(|ui| {
                        if let Some(times) = workbench.timings.passes.get(index) {
                            sparkline(ui, vec2(44.0, 16.0), &times.gpu_ms, slowest, palette.gpu);
                        }
                    });
                    let mut cell = |text: String, about: &str| {
                        table_row.col(|ui| {
                            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                                let missing = text == MISSING;
                                let text = RichText::new(text).monospace();
                                let response = ui.label(if missing { text.weak() } else { text });
                                if !about.is_empty() {
                                    response.on_hover_text(about);
                                }
                            });
                        });
                    };
                    let about = |missing: bool, why| if missing { why } else { "" };
                    cell(ms(row.gpu_ms), about(row.gpu_ms.is_none(), &no_time));
                    cell(
                        ms(row.cpu_ms),
                        about(row.cpu_ms.is_none(), say!("passes.not_recorded_yet")),
                    );
                    let calls = u64::from(row.cost.draws + row.cost.dispatches);
                    cell(short_count(calls), &calls_in_words(&row.cost));
                    let triangles = row.cost.triangles;
                    cell(short_count(triangles), &triangles_in_words(row));
                    match row.fragments {
                        Some(fragments) => cell(short_count(fragments), &count(fragments)),
                        None => cell(MISSING.to_owned(), &no_count),
                    }
                    let apart = traffic_in_words(row, &no_count);
                    cell(bytes(row.cost.traffic.read), &apart);
                    cell(bytes(row.cost.traffic.written), &apart);
                });
            });
    });
    counters(panel, ui);
    systems(panel, ui);
}

fn calls_in_words(cost: &PassStatistics) -> String {
    let workgroups = match cost.workgroups {
        Some(workgroups) => say!("passes.of_workgroups", workgroups = count(workgroups)),
        None if cost.dispatches > 0 => say!("passes.as_large_as_a_buffer_says").to_owned(),
        None => String::new(),
    };
    say!(
        "passes.draws_of_instances_dispatches",
        draws = cost.draws,
        instances = cost.instances,
        dispatches = cost.dispatches,
        workgroups = workgroups
    )
}

fn triangles_in_words(row: &Row) -> String {
    let triangles = count(row.cost.triangles);
    row.vertices.map_or_else(
        || say!("passes.triangles_sent", triangles = triangles),
        |vertices| {
            say!(
                "passes.triangles_vertices_shaded",
                triangles = triangles,
                vertices = count(vertices)
            )
        },
    )
}

/// What the byte model keeps apart.
fn traffic_in_words(row: &Row, no_count: &str) -> String {
    let traffic = &row.cost.traffic;
    let overdraw = match row.fragments {
        Some(fragments) => bytes(traffic.overdraw(fragments)),
        None => say!("passes.unknown", no_count = no_count),
    };
    say!(
        "passes.stencil_a_gpu_that_works_in",
        stencil = bytes(traffic.stencil),
        loaded = bytes(traffic.loaded),
        stored = bytes(traffic.stored),
        overdraw = overdraw
    )
}

/// What the pipeline's shaders counted, and what of the scene found no room.
fn counters(panel: &PassesPanel, ui: &mut Ui) {
    if panel.counters.is_empty() {
        return;
    }
    ui.add_space(4.0);
    ui.label(RichText::new(say!("passes.counted")).small().weak());
    let table = egui::Grid::new("counters").num_columns(2);
    table.striped(true).show(ui, |ui| {
        for (description, value) in &panel.counters {
            ui.label(description);
            let value = value.map_or_else(|| MISSING.to_owned(), |v| count(v.into()));
            ui.label(RichText::new(value).monospace());
            ui.end_row();
        }
    });
}

/// What the world cost before the first pass.
fn systems(panel: &PassesPanel, ui: &mut Ui) {
    if panel.systems.is_empty() {
        return;
    }
    ui.add_space(4.0);
    let about = say!("passes.cpu_time_of_the_thread_that");
    let title = RichText::new(say!("passes.systems_cpu_thread_ms"))
        .small()
        .weak();
    ui.label(title).on_hover_text(about);
    let table = egui::Grid::new("systems").num_columns(2);
    table.striped(true).show(ui, |ui| {
        for (name, time) in &panel.systems {
            ui.label(*name);
            // Finer than passes: a system of a small scene takes microseconds.
            let time = time.map_or_else(|| MISSING.to_owned(), |ms| format!("{ms:.3}"));
            ui.label(RichText::new(time).monospace());
            ui.end_row();
        }
    });
}

/// The whole frame, and how its GPU time is shared out between the passes.
fn totals(editor: &Editor, ui: &mut Ui, palette: Palette) {
    let panel = &editor.passes;
    let timings = &editor.workbench.timings;
    ui.horizontal(|ui| {
        let value =
            |label: &str, text: String| RichText::new(format!("{label} {text}")).monospace();
        ui.label(value(
            say!("passes.gpu"),
            say!(
                "passes.ms",
                ms = format_args!("{:>7}", ms(timings.gpu_ms.median()))
            ),
        ));
        ui.label(value(
            say!("passes.cpu"),
            say!(
                "passes.ms",
                ms = format_args!("{:>6}", ms(timings.cpu_ms.median()))
            ),
        ));
        ui.label(value(say!("passes.targets"), bytes(panel.target_bytes)));
    });
    let total: f64 = panel.rows.iter().filter_map(|row| row.gpu_ms).sum();
    if total <= 0.0 {
        return;
    }
    let size = vec2(ui.available_width(), 10.0);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let mut left = rect.left();
    for (index, row) in panel.rows.iter().enumerate() {
        let Some(gpu_ms) = row.gpu_ms else {
            continue;
        };
        let share = gpu_ms / total;
        let right = left + share as f32 * rect.width();
        let part = egui::Rect::from_x_y_ranges(left..=right, rect.y_range());
        let shade = if index % 2 == 0 { 1.0 } else { 0.6 };
        ui.painter()
            .rect_filled(part, 1.0, palette.gpu.gamma_multiply(shade));
        let id = ui.scope_id().with(("share", index));
        ui.interact(part, id, Sense::hover()).on_hover_text(say!(
            "passes.of_the_gpu_time",
            name = row.name,
            share = format_args!("{:.0}", share * 100.0)
        ));
        left = right;
    }
}
