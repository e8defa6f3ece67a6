//! What the tree of panels asks for: the contents and the words of each tab.

use std::time::Instant;

use egui_tiles::{SimplificationOptions, TileId, UiResponse};

use super::editor::Editor;
use super::layout::Panel;
use super::panels;
use super::workbench::viewports::Viewport;

/// Draws the panels of the tree.
pub(super) struct Panes<'a> {
    pub(super) editor: &'a mut Editor,
    pub(super) now: Instant,
}

impl egui_tiles::Behavior<Panel> for Panes<'_> {
    fn pane_ui(&mut self, ui: &mut egui::Ui, _: TileId, panel: &mut Panel) -> UiResponse {
        let viewport = match panel {
            Panel::Viewport => Some(Viewport::First),
            Panel::Second => Some(Viewport::Second),
            _ => None,
        };
        if let Some(viewport) = viewport {
            panels::viewport::show(self.editor, ui, self.now, viewport);
            return UiResponse::None;
        }
        let fill = ui.visuals().panel_fill;
        ui.painter().rect_filled(ui.max_rect(), 0.0, fill);
        let inner = ui.max_rect().shrink(8.0);
        let mut ui = ui.new_child(egui::UiBuilder::new().max_rect(inner));
        ui.set_clip_rect(inner.expand(2.0));
        let ui = &mut ui;
        match panel {
            Panel::Targets => panels::targets::show(self.editor, ui, self.now),
            Panel::Pixel => panels::pixel::show(self.editor, ui),
            Panel::Passes => panels::passes::show(self.editor, ui, self.now),
            Panel::Pipeline => panels::parameters::pipeline(self.editor, ui),
            Panel::Pipelines => panels::pipelines::show(self.editor, ui),
            Panel::Scene => panels::parameters::scene(self.editor, ui),
            Panel::Entities => panels::entities::show(self.editor, ui),
            Panel::Materials => panels::materials::show(self.editor, ui),
            Panel::Assets => panels::assets::show(self.editor, ui),
            Panel::Environment => panels::environment::show(self.editor, ui),
            Panel::Log => panels::log::show(self.editor, ui),
            Panel::Console => panels::console::show(self.editor, ui),
            Panel::Actions => panels::actions::show(self.editor, ui),
            Panel::Plots => panels::plots::show(self.editor, ui),
            Panel::History => panels::history::show(self.editor, ui),
            Panel::Compare => panels::compare::show(self.editor, ui),
            Panel::Notebook => panels::notebook::show(self.editor, ui),
            Panel::Code => panels::code::show(self.editor, ui),
            Panel::Lesson => panels::lesson::show(self.editor, ui),
            Panel::Viewport | Panel::Second => {}
        }
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, panel: &Panel) -> egui::WidgetText {
        if *panel == Panel::Code && self.editor.code.unsaved().next().is_some() {
            return format!("{} •", panel.title()).into();
        }
        panel.title().into()
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions {
            all_panes_must_have_tabs: true,
            ..SimplificationOptions::default()
        }
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        4.0
    }
}
