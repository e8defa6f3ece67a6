//! Curves over time: what the scene's scripts plot, and what frames cost.

use egui::{Align2, Color32, FontId, Pos2, Rect, RichText, Sense, Stroke, Ui, pos2, vec2};
use lightbench::script::plots::Plot;

use crate::ui::editor::Editor;
use crate::ui::messages::{say, text};
use crate::ui::theme::Palette;
use crate::ui::workbench::trends::Trend;

/// Colours that are told apart by every kind of colour blindness (Okabe and Ito 2008), without black.
const COLORS: [Color32; 7] = [
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(202, 190, 40),
];

/// What the panel remembers from frame to frame.
#[derive(Debug, Default)]
pub struct PlotsPanel {
    /// What frames cost, or without it what scripts plot.
    trend: Option<Trend>,
    /// Names of curves that somebody has hidden.
    hidden: Vec<String>,
}

/// The part of the plane that is drawn: from the first to the last moment, from the least to the
/// greatest value.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extent {
    time: (f64, f64),
    value: (f64, f64),
}

impl Extent {
    fn of<'a>(plots: impl Iterator<Item = &'a Plot>) -> Option<Self> {
        let values = plots.flat_map(|plot| plot.values.iter());
        let all = values.fold(None, |all: Option<Self>, &(time, value)| {
            let wider = |(least, most): (f64, f64), x: f64| (least.min(x), most.max(x));
            Some(match all {
                None => Self {
                    time: (time, time),
                    value: (value, value),
                },
                Some(all) => Self {
                    time: wider(all.time, time),
                    value: wider(all.value, value),
                },
            })
        })?;
        // A single value, or a constant, lies in the middle.
        let room = |(least, most): (f64, f64), by: f64| {
            if most - least > 0.0 {
                (least, most)
            } else {
                (least - by, most + by)
            }
        };
        Some(Self {
            time: room(all.time, 0.5),
            value: room(all.value, all.value.0.abs().max(1.0) * 0.5),
        })
    }

    fn place(&self, rect: Rect, (time, value): (f64, f64)) -> Pos2 {
        let share = |(least, most): (f64, f64), x: f64| ((x - least) / (most - least)) as f32;
        pos2(
            rect.left() + share(self.time, time) * rect.width(),
            rect.bottom() - share(self.value, value) * rect.height(),
        )
    }

    fn time_at(&self, rect: Rect, x: f32) -> f64 {
        let share = f64::from((x - rect.left()) / rect.width());
        self.time.0 + share * (self.time.1 - self.time.0)
    }
}

/// The value of a curve that is nearest to a moment.
fn nearest(plot: &Plot, time: f64) -> Option<(f64, f64)> {
    let far = |(at, _): &(f64, f64)| (at - time).abs();
    plot.values
        .iter()
        .min_by(|a, b| far(a).total_cmp(&far(b)))
        .copied()
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    choose(editor, ui);
    let plots = match (editor.plots.trend, editor.workbench.scenes.scene()) {
        (Some(trend), _) => editor.workbench.trends.curves(trend).to_vec(),
        (None, Some(scene)) => scene.plots(),
        (None, None) => Vec::new(),
    };
    if plots.is_empty() && editor.plots.trend.is_some() {
        ui.label(RichText::new(say!("plots.each_frame_that_is_drawn_adds")).weak());
        return;
    }
    if plots.is_empty() {
        let text = say!("plots.a_script_of_the_scene_that");
        ui.label(RichText::new(text).weak());
        return;
    }
    let hidden = &mut editor.plots.hidden;
    ui.horizontal_wrapped(|ui| {
        for (index, plot) in plots.iter().enumerate() {
            let mut on = !hidden.contains(&plot.name);
            let text = RichText::new(&plot.name).color(COLORS[index % COLORS.len()]);
            if ui.checkbox(&mut on, text).changed() {
                match on {
                    true => hidden.retain(|name| *name != plot.name),
                    false => hidden.push(plot.name.clone()),
                }
            }
        }
    });
    let shown: Vec<(usize, &Plot)> = plots
        .iter()
        .enumerate()
        .filter(|(_, plot)| !hidden.contains(&plot.name))
        .collect();
    chart(ui, &shown);
}

/// Whose curves are drawn.
fn choose(editor: &mut Editor, ui: &mut Ui) {
    let trend = &mut editor.plots.trend;
    ui.horizontal_wrapped(|ui| {
        ui.selectable_value(trend, None, say!("plots.scripts"));
        for (choice, title) in Trend::ALL {
            ui.selectable_value(trend, Some(choice), text(title));
        }
        if trend.is_some() {
            let about = say!("plots.forgets_all_curves_of_frames");
            if ui
                .button(say!("plots.clear"))
                .on_hover_text(about)
                .clicked()
            {
                editor.workbench.trends.clear();
            }
        }
    });
}

fn chart(ui: &mut Ui, shown: &[(usize, &Plot)]) {
    let line = ui.text_style_height(&egui::TextStyle::Body) + 8.0;
    let size = vec2(
        ui.available_width(),
        (ui.available_height() - line).max(40.0),
    );
    let (whole, response) = ui.allocate_exact_size(size, Sense::hover());
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, say!("plots.curves")));
    let Some(extent) = Extent::of(shown.iter().map(|(_, plot)| *plot)) else {
        return;
    };
    let rect = Rect::from_min_max(whole.min + vec2(58.0, 4.0), whole.max - vec2(8.0, 18.0));
    let painter = ui.painter_at(whole);
    painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
    axes(ui, &painter, rect, extent);
    let inside = painter.with_clip_rect(rect.expand(1.0));
    for (index, plot) in shown {
        let color = COLORS[index % COLORS.len()];
        for run in runs(plot) {
            let points: Vec<Pos2> = run.iter().map(|v| extent.place(rect, *v)).collect();
            match points.as_slice() {
                [only] => {
                    inside.circle_filled(*only, 2.0, color);
                }
                _ => {
                    inside.line(points, Stroke::new(1.5, color));
                }
            }
        }
    }
    let mut said = " ".to_owned();
    if let Some(at) = response.hover_pos() {
        let time = extent.time_at(rect, at.x.clamp(rect.left(), rect.right()));
        let color = ui.visuals().weak_text_color();
        inside.vline(at.x, rect.y_range(), Stroke::new(1.0, color));
        said = format!("{time:.3} s");
        for (index, plot) in shown {
            if let Some(value) = nearest(plot, time) {
                let place = extent.place(rect, value);
                inside.circle_filled(place, 3.0, COLORS[index % COLORS.len()]);
                said += &format!("   {} {}", plot.name, short(value.1));
            }
        }
    }
    ui.add(egui::Label::new(RichText::new(said).monospace()).truncate());
}

/// Least and greatest value and moment.
fn axes(ui: &Ui, painter: &egui::Painter, rect: Rect, extent: Extent) {
    let color = ui.visuals().weak_text_color();
    let font = FontId::proportional(11.0);
    let text = |at: Pos2, align: Align2, text: String| {
        painter.text(at, align, text, font.clone(), color);
    };
    let left = rect.left() - 5.0;
    let (least, most) = extent.value;
    text(pos2(left, rect.top()), Align2::RIGHT_TOP, short(most));
    text(
        pos2(left, rect.bottom()),
        Align2::RIGHT_BOTTOM,
        short(least),
    );
    let below = rect.bottom() + 3.0;
    let (first, last) = extent.time;
    text(
        pos2(rect.left(), below),
        Align2::LEFT_TOP,
        format!("{first:.2} s"),
    );
    text(
        pos2(rect.right(), below),
        Align2::RIGHT_TOP,
        format!("{last:.2} s"),
    );
    if least < 0.0 && most > 0.0 {
        let zero = extent.place(rect, (first, 0.0)).y;
        let faint = Palette::of(ui).accent.gamma_multiply(0.35);
        painter.hline(rect.x_range(), zero, Stroke::new(1.0, faint));
        // Where it does not stand on the least or the greatest.
        if rect.shrink2(vec2(0.0, 16.0)).y_range().contains(zero) {
            text(pos2(left, zero), Align2::RIGHT_CENTER, "0".to_owned());
        }
    }
}

/// A number to four digits.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.3e}");
    }
    let decimals = match size {
        s if s >= 1000.0 => 0,
        s if s >= 100.0 => 1,
        s if s >= 10.0 => 2,
        _ => 3,
    };
    format!("{value:.decimals$}")
}

/// The parts of a curve in which time goes on: it goes back where it was rewound.
fn runs(plot: &Plot) -> Vec<Vec<(f64, f64)>> {
    let mut runs: Vec<Vec<(f64, f64)>> = Vec::new();
    for &(time, value) in &plot.values {
        match runs.last_mut() {
            Some(run) if run.last().is_some_and(|(last, _)| *last <= time) => {
                run.push((time, value));
            }
            _ => runs.push(vec![(time, value)]),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(values: &[(f64, f64)]) -> Plot {
        Plot {
            name: "a".to_owned(),
            values: values.iter().copied().collect(),
        }
    }

    #[test]
    fn curves_fill_their_room_and_break_where_time_goes_back() {
        let curve = plot(&[(0.0, -1.0), (1.0, 3.0), (0.5, 0.0)]);
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(100.0, 40.0));
        let extent = Extent::of([&curve].into_iter());
        let Some(extent) = extent else {
            panic!("no extent");
        };
        assert_eq!(extent.place(rect, (0.0, -1.0)), rect.left_bottom());
        assert_eq!(extent.place(rect, (1.0, 3.0)), rect.right_top());
        assert_eq!(extent.time_at(rect, 35.0), 0.25);
        assert_eq!(nearest(&curve, 0.6), Some((0.5, 0.0)));
        assert_eq!(runs(&curve).len(), 2);
        let flat = plot(&[(2.0, 0.0)]);
        let extent = Extent::of([&flat].into_iter());
        let place = extent.map(|extent| extent.place(rect, (2.0, 0.0)));
        assert_eq!(place, Some(rect.center()));
        assert_eq!(Extent::of(std::iter::empty()), None);
    }

    #[test]
    fn numbers_keep_four_digits() {
        assert_eq!(short(0.0), "0.000");
        assert_eq!(short(12.345_6), "12.35");
        assert_eq!(short(-123.46), "-123.5");
        assert_eq!(short(1e-6), "1.000e-6");
        assert_eq!(short(2e7), "2.000e7");
    }
}
