//! The passes of the pipeline on screen as a graph: who writes what, who reads it, and what it costs.

mod draw;
pub mod layout;
pub mod model;

use egui::{Pos2, Rect, Sense, Ui, Vec2, vec2};
use lightbench::render::PipelineDesc;
use lightbench::render::inspect::{last_writer, pictures_of};

use self::draw::{Look, Picked};
use self::layout::{Area, Layout, Sizes, lay_out};
use self::model::{Node, nodes};
use crate::ui::editor::Editor;
use crate::ui::layout::Panel;
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Sizes at a zoom of 1.
const SIZES: Sizes = Sizes {
    pass: [156.0, 92.0],
    gap: 26.0,
    lane: 34.0,
    label: 20.0,
};

/// The least zoom at which all words can be read.
const READABLE: f32 = 0.65;

/// The least and the greatest zoom.
const ZOOMS: (f32, f32) = (0.1, 4.0);

/// What the graph remembers from frame to frame.
#[derive(Default)]
pub struct PassGraph {
    pipeline: String,
    passes: usize,
    nodes: Vec<Node>,
    layout: Layout,
    /// Points of the screen for one of the graph.
    zoom: f32,
    /// Where the graph's corner is, from the panel's.
    pan: Vec2,
    /// Whether it is another graph, whose beginning is to be shown.
    is_new: bool,
    selected: Option<Picked>,
}

impl PassGraph {
    /// Lays out a pipeline, unless it is the same as before.
    pub fn follow(&mut self, desc: &PipelineDesc) {
        let nodes = nodes(desc);
        let same =
            self.pipeline == desc.name && self.passes == desc.passes.len() && self.nodes == nodes;
        if same {
            return;
        }
        let resources: Vec<_> = nodes.iter().map(|node| node.resource.clone()).collect();
        // Names have at most so many points a letter.
        let width = |node: &Node| 7.2 * node.name.chars().count() as f32 + 16.0;
        let widths: Vec<f32> = nodes.iter().map(width).collect();
        self.layout = lay_out(desc.passes.len(), &resources, &widths, &SIZES);
        if self.pipeline != desc.name {
            self.selected = None;
        }
        self.pipeline.clone_from(&desc.name);
        self.passes = desc.passes.len();
        self.nodes = nodes;
        self.is_new = true;
    }

    /// Shows all of it in a place.
    fn fit_to(&mut self, rect: Rect) {
        let size = vec2(self.layout.size[0].max(1.0), self.layout.size[1].max(1.0));
        let room = (rect.size() - vec2(16.0, 16.0)).max(vec2(1.0, 1.0));
        let zoom = (room.x / size.x).min(room.y / size.y);
        self.zoom = zoom.clamp(ZOOMS.0, 1.0);
        self.pan = (rect.size() - size * self.zoom) * 0.5;
    }

    /// Shows all of it, or its beginning where all would be too small to read.
    fn begin_in(&mut self, rect: Rect) {
        self.is_new = false;
        self.fit_to(rect);
        if self.zoom < READABLE {
            self.zoom = READABLE;
            self.pan = vec2(8.0, 8.0);
        }
    }

    /// Zooms about a place of the panel, which stays where it is.
    fn zoom_about(&mut self, at: Vec2, factor: f32) {
        let zoom = (self.zoom * factor).clamp(ZOOMS.0, ZOOMS.1);
        self.pan = at + (self.pan - at) * (zoom / self.zoom);
        self.zoom = zoom;
    }

    fn place(&self, rect: Rect, at: [f32; 2]) -> Pos2 {
        rect.min + self.pan + vec2(at[0], at[1]) * self.zoom
    }

    fn area(&self, rect: Rect, area: Area) -> Rect {
        Rect::from_min_max(self.place(rect, area.min), self.place(rect, area.max))
    }
}

/// Draws the graph, and does what clicks ask for.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let fit = controls(editor, ui);
    let size = ui.available_size().max(vec2(1.0, 1.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Image, true, say!("pass_graph.graph"))
    });
    let graph = &mut editor.passes.graph;
    if graph.is_new || graph.zoom <= 0.0 {
        graph.begin_in(rect);
    }
    if fit {
        graph.fit_to(rect);
    }
    graph.pan += response.drag_delta();
    if let Some(at) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let factor = (scroll / 400.0).exp() * pinch;
        if factor != 1.0 {
            graph.zoom_about(at - rect.min, factor);
        }
    }
    if response.double_clicked() {
        graph.fit_to(rect);
    }
    let mut clip = ui.new_child(egui::UiBuilder::new().max_rect(rect));
    clip.set_clip_rect(rect.intersect(ui.clip_rect()));
    let look = Look {
        palette: Palette::of(ui),
        visuals: ui.visuals().clone(),
    };
    let clicked = draw::graph(editor, &mut clip, rect, &look);
    if response.clicked() && clicked.is_none() {
        editor.passes.graph.selected = None;
    }
    if let Some(clicked) = clicked {
        select(editor, clicked);
    }
}

/// Draws what stands above the graph. Says whether all of it shall be shown.
fn controls(editor: &mut Editor, ui: &mut Ui) -> bool {
    let palette = Palette::of(ui);
    let center = ui.available_size() * 0.5;
    let graph = &mut editor.passes.graph;
    ui.horizontal(|ui| {
        let fit = ui
            .button(say!("pass_graph.fit"))
            .on_hover_text(say!("pass_graph.or_double_click"))
            .clicked();
        for (sign, factor) in [("+", 1.25), ("-", 0.8)] {
            if ui
                .button(sign)
                .on_hover_text(say!("pass_graph.or_the_wheel"))
                .clicked()
            {
                graph.zoom_about(center, factor);
            }
        }
        ui.colored_label(palette.cpu, say!("pass_graph.writes"));
        ui.colored_label(palette.accent, say!("pass_graph.reads"));
        let crossings = graph.layout.crossings;
        if crossings > 0 {
            ui.weak(say!("pass_graph.crossings", crossings = crossings));
        }
        fit
    })
    .inner
}

/// Marks what was clicked, and shows it in the panel Targets.
fn select(editor: &mut Editor, clicked: Picked) {
    editor.passes.graph.selected = Some(clicked.clone());
    let Some(desc) = editor
        .workbench
        .pipelines
        .shown_pipeline()
        .map(|pipeline| pipeline.desc.clone())
    else {
        return;
    };
    let shown = match &clicked {
        // What a pass left; where it wrote no picture nothing else comes.
        Picked::Pass(index) => desc.passes.get(*index).and_then(|pass| {
            let target = pictures_of(&desc, pass)
                .first()
                .map(|name| (*name).to_owned());
            Some((*index, target?))
        }),
        // Later passes may have put another target into the same texture.
        Picked::Resource(name) => last_writer(&desc, name)
            .ok()
            .map(|pass| (pass, name.clone())),
    };
    if let Some((pass, target)) = shown {
        editor.targets.look(&mut editor.workbench, pass, &target);
        editor.bring = Some(Panel::Targets);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zoom_keeps_its_place_and_fitting_shows_all() {
        let mut graph = PassGraph {
            layout: Layout {
                size: [1000.0, 300.0],
                ..Layout::default()
            },
            ..PassGraph::default()
        };
        let rect = Rect::from_min_size(Pos2::new(40.0, 60.0), vec2(400.0, 300.0));
        graph.fit_to(rect);
        for corner in [[0.0, 0.0], [1000.0, 300.0]] {
            assert!(rect.contains(graph.place(rect, corner)));
        }
        let at = vec2(130.0, 70.0);
        let before = (at - graph.pan) / graph.zoom;
        graph.zoom_about(at, 1.7);
        let after = (at - graph.pan) / graph.zoom;
        assert!((before - after).length() < 1e-3);
        for _ in 0..50 {
            graph.zoom_about(at, 2.0);
        }
        assert_eq!(graph.zoom, ZOOMS.1);
    }
}
