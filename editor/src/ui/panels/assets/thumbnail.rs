//! A small picture in its place.

use egui::{Align2, Color32, CornerRadius, FontId, Pos2, Rect, Ui, vec2};

use crate::ui::messages::say;
use crate::ui::pictures::{Order, Pictures, State};

/// Paints a small picture, or what stands in its place.
pub fn paint(pictures: &mut Pictures, ui: &Ui, order: Order, place: Rect) {
    let painter = ui.painter();
    painter.rect_filled(place, CornerRadius::same(3), ui.visuals().extreme_bg_color);
    let note = |text: &str| {
        if place.width() < 60.0 {
            return;
        }
        let color = ui.visuals().weak_text_color();
        let font = FontId::proportional(11.0);
        let galley = painter.layout(text.to_owned(), font, color, place.width() - 8.0);
        let at = Align2::CENTER_CENTER.anchor_size(place.center(), galley.size());
        painter.with_clip_rect(place).galley(at.min, galley, color);
    };
    match pictures.small(ui.ctx(), order) {
        State::There(texture) => {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            // Pictures that are not square keep their shape.
            let [width, height] = texture.size().map(|side| side as f32);
            let scale = place.width() / width.max(height).max(1.0);
            let size = vec2(width * scale, height * scale);
            let place = Rect::from_center_size(place.center(), size);
            painter.image(texture.id(), place, whole, Color32::WHITE);
        }
        State::None(why) => note(why.lines().next().unwrap_or_default()),
        State::Waiting | State::Drawn(_) => note(say!("assets.is_being_drawn")),
    }
}
