//! How often which values occur in the target that is looked at.

use std::time::Instant;

use egui::{Color32, Rect, RichText, Sense, Stroke, Ui, pos2, vec2};
use lightbench::render::inspect::{BINS, Inspection, Measured};

use super::widgets::{count, short_count};
use crate::ui::editor::Editor;
use crate::ui::messages::say;

/// How the histogram is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Histogram {
    /// Whether it is shown.
    on: bool,
    /// Whether its height is the logarithm of the count.
    logarithmic: bool,
}

const HEIGHT: f32 = 64.0;

/// Red, green, blue and alpha, or the only channel.
const COLORS: [Color32; 4] = [
    Color32::from_rgb(220, 80, 70),
    Color32::from_rgb(80, 180, 90),
    Color32::from_rgb(90, 140, 230),
    Color32::from_rgb(160, 160, 160),
];

/// The share of the height that a count has.
fn height(value: u32, most: u32, logarithmic: bool) -> f32 {
    if most == 0 {
        return 0.0;
    }
    let part = |count: u32| match logarithmic {
        // One is seen too.
        true => f64::from(count).ln_1p(),
        false => f64::from(count),
    };
    (part(value) / part(most)) as f32
}

/// Draws the histogram with its switches, and keeps it measured.
pub fn show(editor: &mut Editor, ui: &mut Ui, request: &Inspection, now: Instant) {
    let options = &mut editor.targets.histogram;
    ui.horizontal(|ui| {
        ui.checkbox(&mut options.on, say!("histogram.histogram"));
        if options.on {
            ui.checkbox(
                &mut options.logarithmic,
                say!("histogram.logarithmic_counts"),
            );
        }
        if editor.workbench.measuring.is_waiting() {
            ui.spinner();
        }
    });
    let options = *options;
    if options.on || editor.workbench.measuring.automatic {
        editor.workbench.measure(now);
    }
    if !options.on {
        return;
    }
    let Some(measured) = editor.workbench.measured() else {
        ui.label(RichText::new(say!("histogram.the_next_frame_is_measured")).weak());
        return;
    };
    bars(ui, measured, options.logarithmic);
    words(ui, measured, request);
}

fn bars(ui: &mut Ui, measured: &Measured, logarithmic: bool) {
    let size = vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Image, true, say!("histogram.histogram"))
    });
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
    let all = measured.shown().flat_map(|(_, channel)| &channel.bins);
    let most = all.copied().max().unwrap_or(0);
    let single = measured.shown().count() == 1;
    let width = rect.width() / BINS as f32;
    for (index, channel) in measured.shown() {
        let color = COLORS[if single { 3 } else { index.min(3) }];
        for (bin, value) in channel.bins.iter().enumerate() {
            let top = rect.bottom() - height(*value, most, logarithmic) * rect.height();
            let left = rect.left() + bin as f32 * width;
            let bar = Rect::from_min_max(pos2(left, top), pos2(left + width, rect.bottom()));
            if *value > 0 {
                painter.rect_filled(bar, 0.0, color.gamma_multiply(0.45));
                let line = Stroke::new(1.0, color);
                painter.hline(bar.x_range(), top.min(rect.bottom() - 1.0), line);
            }
        }
    }
    if let Some(at) = response.hover_pos() {
        let bin = (((at.x - rect.left()) / width) as usize).min(BINS - 1);
        response.on_hover_text(bin_in_words(measured, bin));
    }
}

fn bin_in_words(measured: &Measured, bin: usize) -> String {
    let request = &measured.request;
    let end = |bin: usize| request.low + (request.high - request.low) * bin as f32 / BINS as f32;
    let mut text = say!(
        "histogram.bin_range",
        least = format_args!("{:.4}", end(bin)),
        greatest = format_args!("{:.4}", end(bin + 1))
    );
    for (index, channel) in measured.shown() {
        let name = [
            say!("histogram.red"),
            say!("histogram.green"),
            say!("histogram.blue"),
            say!("histogram.alpha"),
        ][index.min(3)];
        let value = channel.bins.get(bin).copied().unwrap_or(0);
        text += &format!("\n{name}: {}", count(value.into()));
    }
    text
}

fn words(ui: &mut Ui, measured: &Measured, request: &Inspection) {
    let range = match measured.range() {
        Some([least, most]) => say!(
            "histogram.least_greatest",
            least = format_args!("{least:.5}"),
            most = format_args!("{most:.5}")
        ),
        None => say!("histogram.no_finite_value").to_owned(),
    };
    let sum = |of: fn(&lightbench::render::inspect::ChannelMeasure) -> u32| -> u64 {
        measured
            .shown()
            .map(|(_, channel)| u64::from(of(channel)))
            .sum()
    };
    let mut parts = vec![range];
    for (number, what) in [
        (sum(|channel| channel.below), say!("histogram.below")),
        (sum(|channel| channel.above), say!("histogram.above")),
        (sum(|channel| channel.invalid), say!("histogram.no_numbers")),
        (u64::from(measured.empty), say!("histogram.not_drawn_to")),
    ] {
        if number > 0 {
            parts.push(format!("{} {what}", short_count(number)));
        }
    }
    let text = RichText::new(parts.join("  ")).monospace().small();
    let about = say!(
        "histogram.counted_between_and_in_equal_parts",
        low = request.low,
        high = request.high,
        bins = BINS
    );
    ui.label(text).on_hover_text(about);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_grow_with_counts_and_a_logarithm_shows_small_ones() {
        assert_eq!(height(0, 1000, false), 0.0);
        assert_eq!(height(500, 1000, false), 0.5);
        assert_eq!(height(1000, 1000, true), 1.0);
        assert_eq!(height(0, 1000, true), 0.0);
        assert!(height(1, 1000, true) > 0.1 && height(1, 1000, false) < 0.01);
        assert_eq!(height(0, 0, false), 0.0);
    }
}
