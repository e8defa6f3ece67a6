//! The graph on the screen.

use egui::{
    Align2, Color32, FontId, Id, Painter, Pos2, Rect, Response, Sense, Stroke, StrokeKind, Ui,
    Visuals, pos2, vec2,
};

use super::PassGraph;
use super::layout::Way;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::passes::Row;
use crate::ui::panels::widgets::{bytes, draw_sparkline, ms, short_count};
use crate::ui::theme::Palette;

/// Something in the graph that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Picked {
    /// A pass, by its number.
    Pass(usize),
    /// A target or buffer, by its name.
    Resource(String),
}

/// Colours of everything.
pub struct Look {
    /// Those that mean something.
    pub palette: Palette,
    /// The others.
    pub visuals: Visuals,
}

/// Text smaller than this is left out, points.
const SMALLEST: f32 = 5.0;

/// The least size of a pass's name, points.
const NAME: f32 = 8.0;

/// Draws everything. Returns what was clicked.
pub fn graph(editor: &Editor, ui: &mut Ui, rect: Rect, look: &Look) -> Option<Picked> {
    let panel = &editor.passes;
    let graph = &panel.graph;
    let painter = ui.painter().clone();
    painter.rect_filled(rect, 2.0, look.visuals.extreme_bg_color);
    let mut clicked = None;
    // What is under the pointer stands out, else what is chosen.
    let mut near: Option<Picked> = None;
    let mut take = |response: &Response, what: Picked| {
        if response.clicked() {
            clicked = Some(what.clone());
        }
        if response.hovered() {
            near = Some(what);
        }
    };
    for (index, area) in graph.layout.passes.iter().enumerate() {
        let Some(row) = panel.rows.get(index) else {
            continue;
        };
        let response = node(ui, graph.area(rect, *area), ("pass", index), || {
            let left_out = if row.cost.dropped {
                say!("pass_graph.left_out")
            } else {
                ""
            };
            say!("pass_graph.pass", name = row.name, left_out = left_out)
        });
        take(&response, Picked::Pass(index));
        if graph.zoom < 0.6 {
            response.on_hover_text(pass_in_words(row));
        }
    }
    for (node_of, lane) in graph.nodes.iter().zip(&graph.layout.lanes) {
        let kind = if node_of.is_target {
            say!("pass_graph.target")
        } else {
            say!("pass_graph.buffer")
        };
        let area = graph.area(rect, lane.label);
        let response = node(ui, area, ("lane", node_of.name.as_str()), || {
            format!("{kind} {}", node_of.name)
        });
        take(&response, Picked::Resource(node_of.name.clone()));
        response.on_hover_text(format!("{}\n{}", node_of.name, node_of.about));
    }
    let lit = near.or_else(|| graph.selected.clone());
    lanes(graph, &painter, rect, look, lit.as_ref());
    for (index, area) in graph.layout.passes.iter().enumerate() {
        if let Some(row) = panel.rows.get(index) {
            let is_lit = lit == Some(Picked::Pass(index));
            pass(
                editor,
                &painter,
                graph.area(rect, *area),
                index,
                row,
                (look, is_lit),
            );
        }
    }
    clicked
}

/// A place that can be clicked.
fn node(ui: &Ui, area: Rect, id: impl egui::AsIdSalt, label: impl Fn() -> String) -> Response {
    let id: Id = ui.scope_id().with(id);
    let response = ui.interact(area.intersect(ui.clip_rect()), id, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, label()));
    response
}

fn lanes(graph: &PassGraph, painter: &Painter, rect: Rect, look: &Look, lit: Option<&Picked>) {
    let zoom = graph.zoom;
    let is_lit = |name: &str, pass: usize| match lit {
        None => true,
        Some(Picked::Pass(wanted)) => *wanted == pass,
        Some(Picked::Resource(wanted)) => wanted == name,
    };
    let faint = |color: Color32, lit: bool| {
        if lit {
            color
        } else {
            color.gamma_multiply(0.22)
        }
    };
    for (node, lane) in graph.nodes.iter().zip(&graph.layout.lanes) {
        let any = lane.lines.iter().any(|line| is_lit(&node.name, line.pass));
        let y = graph.place(rect, [0.0, lane.y]).y;
        let x = |x: f32| graph.place(rect, [x, 0.0]).x;
        let line = faint(look.visuals.weak_text_color(), any);
        let run = x(lane.x[0])..=x(lane.x[1]);
        painter.hline(run, y, Stroke::new((2.0 * zoom).max(1.0), line));
        let top = graph.place(rect, [0.0, super::SIZES.pass[1]]).y;
        for line in &lane.lines {
            let shines = is_lit(&node.name, line.pass);
            let at = x(line.x);
            let write = faint(look.palette.cpu, shines);
            let read = faint(look.palette.accent, shines);
            let stroke = |color| Stroke::new((1.5 * zoom).clamp(1.0, 3.0), color);
            match line.way {
                Way::Write => arrow(painter, pos2(at, top), pos2(at, y), stroke(write), zoom),
                Way::Read => arrow(painter, pos2(at, y), pos2(at, top), stroke(read), zoom),
                Way::Both => {
                    let aside = vec2(2.0 * zoom, 0.0);
                    let (up, down) = (pos2(at, top), pos2(at, y));
                    arrow(painter, up + aside, down + aside, stroke(write), zoom);
                    arrow(painter, down - aside, up - aside, stroke(read), zoom);
                }
            }
        }
    }
    // Above all lines.
    for (node, lane) in graph.nodes.iter().zip(&graph.layout.lanes) {
        let any = lane.lines.iter().any(|line| is_lit(&node.name, line.pass));
        let area = graph.area(rect, lane.label);
        let chosen = graph.selected == Some(Picked::Resource(node.name.clone()));
        let edge = if chosen {
            look.palette.accent
        } else {
            look.visuals.weak_text_color()
        };
        let corner = if node.is_target {
            3.0 * zoom
        } else {
            area.height() * 0.5
        };
        painter.rect(
            area,
            corner,
            look.visuals.faint_bg_color,
            Stroke::new(if chosen { 2.0 } else { 1.0 }, faint(edge, any)),
            StrokeKind::Inside,
        );
        let color = faint(look.visuals.text_color(), any);
        text(
            painter,
            area.center(),
            Align2::CENTER_CENTER,
            &node.name,
            (11.5 * zoom, color),
        );
    }
}

fn arrow(painter: &Painter, from: Pos2, to: Pos2, stroke: Stroke, zoom: f32) {
    painter.line_segment([from, to], stroke);
    let back = (from - to).normalized() * (6.0 * zoom).max(3.0);
    let aside = back.rot90() * 0.55;
    for side in [aside, -aside] {
        painter.line_segment([to, to + back + side], stroke);
    }
}

fn pass(
    editor: &Editor,
    painter: &Painter,
    area: Rect,
    index: usize,
    row: &Row,
    (look, is_lit): (&Look, bool),
) {
    let zoom = editor.passes.graph.zoom;
    let chosen = editor.passes.graph.selected == Some(Picked::Pass(index));
    let visuals = &look.visuals;
    let left_out = row.cost.dropped;
    let edge = match (chosen || is_lit, left_out) {
        (true, _) => look.palette.accent,
        (false, true) => visuals.weak_text_color().gamma_multiply(0.6),
        (false, false) => visuals.weak_text_color(),
    };
    let fill = if left_out {
        visuals.extreme_bg_color
    } else {
        visuals.window_fill
    };
    let stroke = Stroke::new(if chosen { 2.0 } else { 1.0 }, edge);
    painter.rect(area, 4.0 * zoom, fill, Stroke::NONE, StrokeKind::Inside);
    if left_out {
        dashed(painter, area, stroke);
    } else {
        painter.rect_stroke(area, 4.0 * zoom, stroke, StrokeKind::Inside);
    }
    let clip = painter.with_clip_rect(area.intersect(painter.clip_rect()));
    let strong = if left_out {
        visuals.weak_text_color()
    } else {
        visuals.strong_text_color()
    };
    let weak = visuals.weak_text_color();
    let at = |x: f32, y: f32| area.min + vec2(x, y) * zoom;
    let left = |y: f32, words: &str, size: f32, color: Color32| {
        text(
            &clip,
            at(8.0, y),
            Align2::LEFT_TOP,
            words,
            (size * zoom, color),
        );
    };
    // The name stays when all else has become too small.
    let name = format!("{} {}", index + 1, row.name);
    if zoom * 13.0 < NAME {
        let middle = area.left_center() + vec2(3.0, 0.0);
        text(&clip, middle, Align2::LEFT_CENTER, &name, (NAME, strong));
        return;
    }
    left(6.0, &name, 13.0, strong);
    left(23.0, row.kind, 10.5, weak);
    if left_out {
        left(42.0, say!("pass_graph.left_out_nobody_uses"), 11.0, weak);
        left(56.0, say!("pass_graph.what_it_writes"), 11.0, weak);
        return;
    }
    let times = say!(
        "pass_graph.times",
        gpu_ms = ms(row.gpu_ms),
        cpu_ms = ms(row.cpu_ms)
    );
    left(38.0, &times, 11.0, visuals.text_color());
    left(53.0, &work_in_words(row), 11.0, visuals.text_color());
    if let Some(times) = editor.workbench.timings.passes.get(index) {
        let line = Rect::from_min_max(at(8.0, 70.0), area.max - vec2(8.0, 6.0) * zoom);
        let colors = (look.palette.gpu, visuals.extreme_bg_color);
        draw_sparkline(&clip, line, &times.gpu_ms, editor.passes.slowest(), colors);
    }
}

/// Calls and bytes of a pass.
fn work_in_words(row: &Row) -> String {
    let cost = &row.cost;
    let calls = match (cost.draws, cost.dispatches) {
        (0, 0) => String::new(),
        (draws, 0) => say!("pass_graph.draws", count = short_count(draws.into())),
        (0, dispatches) => say!(
            "pass_graph.dispatches",
            count = short_count(dispatches.into())
        ),
        (draws, dispatches) => say!(
            "pass_graph.calls",
            count = short_count((draws + dispatches).into())
        ),
    };
    format!("{calls}{}", bytes(cost.traffic.read + cost.traffic.written))
}

fn pass_in_words(row: &Row) -> String {
    if row.cost.dropped {
        return say!(
            "pass_graph.left_out_nobody_uses_what_it",
            name = row.name,
            kind = row.kind
        );
    }
    say!(
        "pass_graph.pass_costs",
        name = row.name,
        kind = row.kind,
        gpu_ms = ms(row.gpu_ms),
        cpu_ms = ms(row.cpu_ms),
        row = work_in_words(row)
    )
}

fn dashed(painter: &Painter, area: Rect, stroke: Stroke) {
    let corners = [
        area.left_top(),
        area.right_top(),
        area.right_bottom(),
        area.left_bottom(),
        area.left_top(),
    ];
    painter.extend(egui::Shape::dashed_line(&corners, stroke, 5.0, 4.0));
}

fn text(painter: &Painter, at: Pos2, align: Align2, words: &str, (size, color): (f32, Color32)) {
    if size >= SMALLEST {
        painter.text(at, align, words, FontId::proportional(size), color);
    }
}
