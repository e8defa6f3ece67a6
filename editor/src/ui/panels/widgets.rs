//! Small pieces that several panels use.

use std::ops::RangeInclusive;

use egui::{
    Color32, ComboBox, Label, Response, RichText, Sense, Slider, SliderClamping, Stroke, Ui, pos2,
};
use lightbench::render::Place;

use crate::ui::coding::is_in_a_file;
use crate::ui::messages::say;
use crate::ui::workbench::timing::{Series, WINDOW};

/// What stands where a number is missing.
pub const MISSING: &str = "-";

/// A combo box behind its label.
pub fn combo(
    ui: &mut Ui,
    label: &str,
    selected: &str,
    width: f32,
    entries: impl FnOnce(&mut Ui),
) -> Response {
    let name = ui.label(label);
    let combo = ComboBox::from_id_salt(label)
        .selected_text(selected)
        .truncate()
        .width(width);
    combo.show_ui(ui, entries).response.labelled_by(name.id)
}

/// A combo box that says what it is to those who can't see what it stands beside.
pub fn combo_of(
    ui: &mut Ui,
    label: &str,
    selected: &str,
    width: f32,
    entries: impl FnOnce(&mut Ui),
) -> Response {
    let combo = ComboBox::from_id_salt(label)
        .selected_text(selected)
        .width(width);
    let response = combo.show_ui(ui, entries).response;
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, label));
    response
}

/// The place of a mistake. Returns whether somebody wants to see it.
pub fn place(ui: &mut Ui, place: &Place, color: Color32) -> bool {
    let text = RichText::new(place.to_string()).monospace().color(color);
    if !is_in_a_file(place) {
        ui.label(text);
        return false;
    }
    let label = Label::new(text.underline()).sense(Sense::click());
    let label = ui.add(label).on_hover_text(say!("widgets.show_it_in_code"));
    label
        .on_hover_cursor(egui::CursorIcon::PointingHand)
        .clicked()
}

/// A count with thin groups of three digits.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(' ');
        }
        grouped.push(digit);
    }
    grouped
}

/// A count to three digits, as in "286 k" and "5.70 M".
pub fn short_count(value: u64) -> String {
    if value < 10_000 {
        return count(value);
    }
    let (scaled, unit) = match value as f64 {
        v if v >= 1e9 => (v / 1e9, "G"),
        v if v >= 1e6 => (v / 1e6, "M"),
        v => (v / 1e3, "k"),
    };
    let decimals = match scaled {
        s if s < 9.995 => 2,
        s if s < 99.95 => 1,
        _ => 0,
    };
    format!("{scaled:.decimals$} {unit}")
}

/// Bytes in a unit that fits, to three digits.
pub fn bytes(value: u64) -> String {
    let value = value as f64;
    let (scaled, unit) = match value {
        v if v >= 1e9 => (v / 1e9, say!("widgets.gb")),
        v if v >= 1e6 => (v / 1e6, say!("widgets.mb")),
        v if v >= 1e3 => (v / 1e3, say!("widgets.kb")),
        v => (v, "B"),
    };
    let decimals = match scaled {
        _ if unit == "B" => 0,
        s if s < 9.995 => 2,
        s if s < 99.95 => 1,
        _ => 0,
    };
    format!("{scaled:.decimals$} {unit}")
}

/// A number with as many digits as tell it from all others: of those of 32 bits, where it is one of these.
pub fn exact(number: f64) -> String {
    let single = number as f32;
    let short = single.to_string();
    let is_told = f64::from(single) == number || short.parse() == Ok(number);
    let text = if is_told { short } else { number.to_string() };
    // The sign that egui has for numbers.
    text.replace('-', "−")
}

/// A slider that shows all of its number and leaves it as it is until somebody moves it: others would round
/// it.
pub fn slider<Number: egui::emath::Numeric>(
    number: &mut Number,
    range: RangeInclusive<Number>,
) -> Slider<'_> {
    Slider::new(number, range)
        .clamping(SliderClamping::Edits)
        .custom_formatter(|number, _| exact(number))
}

/// Milliseconds, or the sign for a missing number.
pub fn ms(value: Option<f64>) -> String {
    value.map_or_else(|| MISSING.to_owned(), |ms| format!("{ms:.2}"))
}

/// The last values as a line, from 0 to `top`.
pub fn sparkline(ui: &mut Ui, size: egui::Vec2, series: &Series, top: f64, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let back = ui.visuals().extreme_bg_color;
    draw_sparkline(&ui.painter_at(rect), rect, series, top, (color, back));
}

/// The same at a place of its own.
pub fn draw_sparkline(
    painter: &egui::Painter,
    rect: egui::Rect,
    series: &Series,
    top: f64,
    (color, back): (Color32, Color32),
) {
    painter.rect_filled(rect, 2.0, back);
    let count = series.values().len();
    if count < 2 || top <= 0.0 {
        return;
    }
    let points = series.values().enumerate().map(|(i, value)| {
        let x = rect.right() - (count - 1 - i) as f32 / (WINDOW - 1) as f32 * rect.width();
        let share = (value / top).clamp(0.0, 1.0) as f32;
        pos2(x, rect.bottom() - 1.0 - share * (rect.height() - 2.0))
    });
    painter.line(points.collect(), Stroke::new(1.0, color));
}

/// `light_volumes` as "Light volumes".
pub fn words(name: &str) -> String {
    let mut text = name.replace('_', " ");
    if let Some(first) = text.get(..1) {
        let upper = first.to_uppercase();
        text.replace_range(..1, &upper);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_three_digits_and_names_become_words() {
        assert_eq!(bytes(999), "999 B");
        assert_eq!(bytes(1_500), "1.50 kB");
        assert_eq!(bytes(3_686_400), "3.69 MB");
        assert_eq!(bytes(99_960_000), "100 MB");
        assert_eq!(count(1_234_567), "1 234 567");
        assert_eq!(count(12), "12");
        assert_eq!(short_count(9_999), "9 999");
        assert_eq!(short_count(286_056), "286 k");
        assert_eq!(short_count(5_701_424), "5.70 M");
        assert_eq!(words("light_volumes"), "Light volumes");
        assert_eq!(words(""), "");
        assert_eq!(ms(None), MISSING);
    }

    #[test]
    fn a_number_is_told_exactly_and_no_more() {
        assert_eq!(exact(0.12345), "0.12345");
        assert_eq!(exact(f64::from(0.1_f32)), "0.1");
        assert_eq!(exact(0.1 + 0.2), "0.30000000000000004");
        assert_eq!(exact(-2.0), "−2");
        assert_eq!(exact(1_448.0), "1448");
        // Of all numbers of 32 bits, some thousands: what is shown reads back as the same one.
        for bits in (0..0x7f80_0000_u32).step_by(97_001) {
            let number = f32::from_bits(bits);
            let shown = exact(number.into());
            assert_eq!(shown.parse::<f32>().map(f32::to_bits), Ok(bits), "{shown}");
        }
    }
}
