//! The frame pass by pass, in the picture's place.

use egui::{
    Align2, Color32, CornerRadius, Id, Margin, Pos2, Rect, RichText, Slider, TextureOptions, Ui,
    vec2,
};

use crate::ui::actions::{Action, shortcut_text};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::screen::Place;
use crate::ui::theme::Palette;
use crate::ui::workbench::stepping::Stopped;

use super::widgets::combo;

/// Draws what a pass left over the whole frame, and the bar that goes on to others.
pub fn show(editor: &mut Editor, ui: &mut Ui, rect: Rect) {
    let Some(stopped) = editor.workbench.stopped() else {
        return;
    };
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, CornerRadius::ZERO, ui.visuals().extreme_bg_color);
    if stopped.shown.is_some()
        && let Some(texture) = editor.workbench.stopped_picture()
    {
        let options = TextureOptions {
            magnification: egui::TextureFilter::Nearest,
            ..TextureOptions::LINEAR
        };
        let id = editor.screen.show(Place::Pass, &texture, options);
        let size = vec2(texture.width() as f32, texture.height() as f32);
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        painter.image(id, fitted(rect, size), whole, Color32::WHITE);
    }
    bar(editor, ui, rect, &stopped);
}

/// The largest place of a picture's shape in the middle. One that nearly has the viewport's shape takes
/// all of it, as the whole frame does.
fn fitted(rect: Rect, size: egui::Vec2) -> Rect {
    let (wide, tall) = (
        rect.width() / size.x.max(1.0),
        rect.height() / size.y.max(1.0),
    );
    if (wide / tall - 1.0).abs() < 0.02 {
        return rect;
    }
    Rect::from_center_size(rect.center(), size * wide.min(tall))
}

/// What stands in the picture's place, in words.
fn title(stopped: &Stopped) -> String {
    let number = stopped.index + 1;
    let mut text = say!(
        "stepping.after_pass_of",
        number = number,
        count = stopped.count,
        pass = stopped.pass
    );
    if let Some((target, _)) = &stopped.shown {
        text += &format!(", {target}");
    }
    text
}

fn bar(editor: &mut Editor, ui: &Ui, rect: Rect, stopped: &Stopped) {
    let palette = Palette::of(ui);
    egui::Area::new(Id::unique("stepping"))
        .constrain_to(rect)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(rect.center_top() + vec2(0.0, 8.0))
        .show(ui.ctx(), |ui| {
            egui::Frame::new()
                .fill(palette.note_fill)
                .corner_radius(CornerRadius::same(4))
                .inner_margin(Margin::symmetric(10, 6))
                .show(ui, |ui| {
                    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
                    let text = RichText::new(title(stopped)).strong();
                    ui.label(text.color(palette.note_text));
                    notes(ui, stopped, palette);
                    ui.horizontal(|ui| controls(editor, ui, stopped));
                });
        });
}

/// What a person would wonder at.
fn notes(ui: &mut Ui, stopped: &Stopped, palette: Palette) {
    let mut note = |text: String| {
        ui.label(RichText::new(text).small().color(palette.note_text));
    };
    if stopped.is_left_out {
        note(say!("stepping.nobody_uses_what_it_writes_it").to_owned());
    }
    if stopped.targets.is_empty() {
        let what = match stopped.buffers.as_slice() {
            [] => say!("stepping.it_writes_nothing_that_can_be").to_owned(),
            buffers => say!("stepping.it_writes_buffers", buffers = buffers.join(", ")),
        };
        note(match stopped.shown {
            Some(_) => say!("stepping.the_picture_is_the_one_before", what = what),
            None => say!("stepping.nothing_was_drawn_before", what = what),
        });
    }
}

fn controls(editor: &mut Editor, ui: &mut Ui, stopped: &Stopped) {
    let mut button = |ui: &mut Ui, label: &str, action: Action| {
        let mut response = ui.button(label);
        if let Some(key) = shortcut_text(ui.ctx(), action) {
            response = response.on_hover_text(key);
        }
        if response.clicked() {
            let ctx = ui.ctx().clone();
            editor.perform(action, &ctx);
        }
    };
    button(ui, say!("stepping.previous"), Action::PassBefore);
    button(ui, say!("stepping.next"), Action::PassAfter);
    button(ui, say!("stepping.whole_frame"), Action::WholeFrame);
    let mut number = stopped.index + 1;
    let label = ui.label(say!("stepping.pass"));
    let slider = Slider::new(&mut number, 1..=stopped.count).show_value(false);
    if ui.add(slider).labelled_by(label.id).changed() {
        editor.workbench.stop_after(Some(number - 1));
    }
    if stopped.targets.len() > 1 {
        let shown = stopped.shown.as_ref().map_or("", |(target, _)| target);
        let mut wanted = None;
        combo(ui, say!("stepping.of"), shown, 110.0, |ui| {
            for target in &stopped.targets {
                if ui.selectable_label(target == shown, target).clicked() {
                    wanted = Some(target.clone());
                }
            }
        });
        if let Some(target) = wanted {
            editor.workbench.stop_at_target(&target);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_another_shape_are_shown_whole() {
        let rect = Rect::from_min_size(Pos2::new(10.0, 20.0), vec2(400.0, 200.0));
        assert_eq!(fitted(rect, vec2(801.0, 400.0)), rect);
        let square = fitted(rect, vec2(512.0, 512.0));
        assert_eq!(square.size(), vec2(200.0, 200.0));
        assert_eq!(square.center(), rect.center());
    }
}
