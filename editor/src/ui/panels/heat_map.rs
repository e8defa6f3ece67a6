//! Heat maps in place of the picture: which, and what their colours mean.

use egui::{Color32, FontId, Rect, Ui, pos2, vec2};
use lightbench::lab::colormap::ColorMap;
use lightbench::render::PipelineDesc;
use lightbench::render::description::ParameterValue;
use lightbench::render::heat_map::{self, HeatMap};

use super::widgets;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// The choice in the toolbar.
pub fn choose(editor: &mut Editor, ui: &mut Ui) {
    let pipelines = &editor.workbench.pipelines;
    let set = pipelines.slot(pipelines.selected()).and_then(|slot| {
        let value = slot.settings.get(heat_map::PARAMETER)?.to_string();
        HeatMap::NAMES.iter().find(|(name, _)| *name == value)
    });
    let title = set.map_or(say!("heat_map.picture"), |(_, map)| map.title());
    let mut wanted = None;
    widgets::combo(ui, say!("heat_map.show"), title, 110.0, |ui| {
        if ui
            .selectable_label(set.is_none(), say!("heat_map.picture"))
            .clicked()
        {
            wanted = Some("off");
        }
        for (name, map) in HeatMap::NAMES {
            let selected = set.is_some_and(|(set, _)| *set == name);
            if ui.selectable_label(selected, map.title()).clicked() {
                wanted = Some(name);
            }
        }
    });
    if let Some(name) = wanted {
        let value = (name != "off").then(|| name.into());
        editor
            .workbench
            .set_pipeline_parameter(heat_map::PARAMETER, value);
    }
}

/// The legend over the picture, in its lower right corner.
pub fn legend(ui: &Ui, rect: Rect, desc: &PipelineDesc) {
    const STEPS: usize = 64;
    let Some(map) = HeatMap::of(desc) else {
        return;
    };
    let most = match desc.parameter(heat_map::MOST).map(|p| &p.value) {
        Some(ParameterValue::Number(most)) => *most,
        _ => return,
    };
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    let width = (rect.width() * 0.4).clamp(120.0, 320.0);
    let bar = Rect::from_min_size(
        pos2(rect.right() - width - 26.0, rect.bottom() - 44.0),
        vec2(width, 10.0),
    );
    let text = |x: f32, y: f32, align: egui::Align2, text: String| {
        painter.text(
            pos2(x, y),
            align,
            text,
            FontId::proportional(12.0),
            palette.note_text,
        );
    };
    painter.rect_filled(bar.expand2(vec2(14.0, 22.0)), 4.0, palette.note_fill);
    for step in 0..STEPS {
        let share = step as f32 / (STEPS - 1) as f32;
        let [r, g, b] = ColorMap::Viridis.color(share);
        let left = bar.left() + bar.width() * step as f32 / STEPS as f32;
        let right = bar.left() + bar.width() * (step + 1) as f32 / STEPS as f32;
        let part = Rect::from_min_max(pos2(left, bar.top()), pos2(right, bar.bottom()));
        painter.rect_filled(part, 0.0, Color32::from_rgb(r, g, b));
    }
    let (top, bottom) = (bar.top() - 3.0, bar.bottom() + 3.0);
    let title = say!("heat_map.white_more_than", title = map.title(), most = most);
    text(bar.center().x, top, egui::Align2::CENTER_BOTTOM, title);
    text(bar.left(), bottom, egui::Align2::LEFT_TOP, "0".to_owned());
    let half = format!("{}", most / 2.0);
    text(bar.center().x, bottom, egui::Align2::CENTER_TOP, half);
    text(
        bar.right(),
        bottom,
        egui::Align2::RIGHT_TOP,
        format!("{most}"),
    );
}
