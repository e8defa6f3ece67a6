//! The eye and the padlock before an entity's name.

use egui::{Color32, Response, Sense, Stroke, StrokeKind, Ui, pos2, vec2};

use crate::ui::messages::say;

/// An eye, open or struck through; none where nothing could be shown.
pub fn eye(ui: &mut Ui, shown: Option<bool>, name: &str) -> bool {
    let (response, color) = place(ui);
    let Some(shown) = shown else {
        return false;
    };
    let center = response.rect.center();
    let color = if shown {
        color
    } else {
        color.gamma_multiply(0.5)
    };
    let stroke = Stroke::new(1.2, color);
    let painter = ui.painter();
    let corner = |x: f32, y: f32| center + vec2(x, y);
    for side in [-1.0, 1.0] {
        let lid = [
            corner(-6.0, 0.0),
            corner(-2.5, 3.0 * side),
            corner(2.5, 3.0 * side),
            corner(6.0, 0.0),
        ];
        painter.line(lid.to_vec(), stroke);
    }
    if shown {
        painter.circle_filled(center, 1.7, color);
    } else {
        painter.line_segment([corner(-5.0, 5.0), corner(5.0, -5.0)], stroke);
    }
    let label = format!(
        "{} {name}",
        if shown {
            say!("entities.hide")
        } else {
            say!("entities.show")
        }
    );
    clicked(response, label)
}

/// A padlock, closed or hardly to be seen.
pub fn padlock(ui: &mut Ui, locked: bool, name: &str) -> bool {
    let (response, color) = place(ui);
    let color = if locked {
        color
    } else {
        color.gamma_multiply(0.35)
    };
    let center = response.rect.center();
    let painter = ui.painter();
    let body = egui::Rect::from_center_size(center + vec2(0.0, 2.5), vec2(8.0, 5.5));
    let stroke = Stroke::new(1.2, color);
    if locked {
        painter.rect_filled(body, 1.0, color);
    } else {
        painter.rect_stroke(body, 1.0, stroke, StrokeKind::Inside);
    }
    let lift = if locked { 0.0 } else { 1.5 };
    let right = if locked { body.top() } else { body.top() - 2.5 };
    let bow = [
        pos2(center.x - 2.5, body.top()),
        pos2(center.x - 2.5, body.top() - 2.5 - lift),
        pos2(center.x, body.top() - 4.5 - lift),
        pos2(center.x + 2.5, body.top() - 2.5 - lift),
        pos2(center.x + 2.5, right),
    ];
    painter.line(bow.to_vec(), stroke);
    let label = format!(
        "{} {name}",
        if locked {
            say!("entities.unlock")
        } else {
            say!("entities.lock")
        }
    );
    clicked(response, label)
}

fn place(ui: &mut Ui) -> (Response, Color32) {
    let size = vec2(16.0, ui.spacing().interact_size.y);
    let (_, response) = ui.allocate_exact_size(size, Sense::click());
    let color = ui.style().interact(&response).fg_stroke.color;
    (response, color)
}

fn clicked(response: Response, label: String) -> bool {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
    response.on_hover_text(label).clicked()
}
