//! What stands over the picture while two are compared: the line between them, and which is which.

use egui::{
    Align2, Color32, CursorIcon, EventFilter, FontId, Id, Key, Modifiers, Rect, Sense, Stroke, Ui,
    pos2, vec2,
};
use lightbench::lab::colormap::ColorMap;

use super::super::viewport;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::comparing::Mode;

/// Points beside the line in which it can be taken.
const REACH: f32 = 6.0;

/// By how much a key moves the line that has the focus.
const STEP: f32 = 0.01;

/// Lets the line be moved by mouse and keys.
pub fn interact(editor: &mut Editor, ui: &mut Ui, rect: Rect) {
    let comparing = &mut editor.workbench.comparing;
    if !comparing.is_on() || comparing.mode != Mode::Split || rect.width() < 1.0 {
        return;
    }
    let x = rect.left() + comparing.split * rect.width();
    let strip = Rect::from_min_max(pos2(x - REACH, rect.top()), pos2(x + REACH, rect.bottom()));
    let id = Id::unique("split");
    let response = ui.interact(strip.intersect(rect), id, Sense::drag());
    response.widget_info(|| {
        egui::WidgetInfo::slider(true, f64::from(comparing.split), say!("compare.split"))
    });
    if response.dragged()
        && let Some(at) = response.interact_pointer_pos()
    {
        comparing.split = ((at.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
    }
    if response.hovered() || response.dragged() {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    if response.has_focus() {
        let filter = EventFilter {
            horizontal_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
        let pressed = |key| ui.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
        let by = pressed(Key::ArrowRight) as f32 - pressed(Key::ArrowLeft) as f32;
        comparing.split = (comparing.split + by * STEP).clamp(0.0, 1.0);
    }
}

/// Draws the line and the names of both sides.
pub fn over(editor: &Editor, ui: &Ui, rect: Rect) {
    let workbench = &editor.workbench;
    let comparing = &workbench.comparing;
    let Some(side) = comparing.side().filter(|_| comparing.is_on()) else {
        return;
    };
    let title = |name: Option<&str>| {
        let name = name.unwrap_or_default();
        workbench.library.pipeline_title(name).to_owned()
    };
    let first = format!("A: {}", title(workbench.pipelines.shown()));
    let second = match side.pipelines.shown() {
        Some(name) => format!("B: {}", title(Some(name))),
        None => say!("compare.b_is_being_built").to_owned(),
    };
    match comparing.mode {
        Mode::Split => split(ui, rect, comparing.split, &first, &second),
        Mode::Flicker => {
            let text = if comparing.flicker.shows_b {
                second
            } else {
                first
            };
            viewport::note(ui, rect, Align2::CENTER_BOTTOM, &text);
        }
        Mode::Difference => {
            let text = say!(
                "compare.difference_x",
                first = first,
                second = second,
                gain = format_args!("{:.0}", comparing.gain)
            );
            viewport::note(ui, rect, Align2::CENTER_BOTTOM, &text);
        }
        Mode::Flip => flip(editor, ui, rect, &format!("{first}, {second}")),
    }
}

fn split(ui: &Ui, rect: Rect, at: f32, first: &str, second: &str) {
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    let x = rect.left() + at * rect.width();
    let focused = ui.memory(|memory| memory.has_focus(Id::unique("split")));
    let width = if focused { 3.0 } else { 1.0 };
    // Dark beside light, to be seen on any picture.
    painter.vline(
        x,
        rect.y_range(),
        Stroke::new(width + 2.0, Color32::from_black_alpha(160)),
    );
    let color = if focused {
        palette.accent
    } else {
        Color32::WHITE
    };
    painter.vline(x, rect.y_range(), Stroke::new(width, color));
    let bottom = rect.bottom() - 12.0;
    for (text, align, from) in [
        (first, Align2::RIGHT_BOTTOM, x - 12.0),
        (second, Align2::LEFT_BOTTOM, x + 12.0),
    ] {
        let font = FontId::proportional(12.0);
        let galley = painter.layout_no_wrap(text.to_owned(), font, palette.note_text);
        let mut place = align.anchor_size(pos2(from, bottom), galley.size());
        // A name that has no room beside the line stays in the picture, as far as it is its side.
        let room = if align == Align2::RIGHT_BOTTOM {
            x - rect.left()
        } else {
            rect.right() - x
        };
        if room < 24.0 {
            continue;
        }
        if room < place.width() + 20.0 {
            place = place.translate(vec2(0.0, if text == first { -22.0 } else { 0.0 }));
            let least = rect.left() + 8.0;
            let most = (rect.right() - 8.0 - place.width()).max(least);
            let left = place.left().clamp(least, most);
            place = Rect::from_min_size(pos2(left, place.top()), place.size());
        }
        painter.rect_filled(place.expand2(vec2(7.0, 4.0)), 3.0, palette.note_fill);
        painter.galley(place.min, galley, palette.note_text);
    }
}

/// Of which picture the map is, and what its colours mean.
fn flip(editor: &Editor, ui: &Ui, rect: Rect, names: &str) {
    const STEPS: usize = 64;
    // A map of a picture of another size is not shown.
    let size = editor.workbench.drawn_size();
    let judgement = editor.workbench.judgement();
    let judgement = judgement.filter(|judgement| Some(judgement.judged.size) == size);
    let is_shown = judgement.is_some();
    let text = match judgement {
        None => say!("compare.flip_comes_as_soon_as_nothing", names = names),
        Some(judgement) => {
            let mean = judgement.judged.difference.flip.mean;
            match judgement.frames_ago {
                0 => say!(
                    "compare.flip_in_the_mean",
                    names = names,
                    mean = format_args!("{mean:.4}")
                ),
                ago => {
                    say!(
                        "compare.flip_in_the_mean_of_the",
                        names = names,
                        mean = format_args!("{mean:.4}"),
                        ago = ago
                    )
                }
            }
        }
    };
    viewport::note(ui, rect, Align2::CENTER_BOTTOM, &text);
    if !is_shown {
        return;
    }
    let palette = Palette::of(ui);
    let painter = ui.painter_at(rect);
    let bar = Rect::from_min_size(
        pos2(rect.right() - 150.0, rect.bottom() - 64.0),
        vec2(128.0, 8.0),
    );
    painter.rect_filled(bar.expand2(vec2(14.0, 5.0)), 4.0, palette.note_fill);
    for step in 0..STEPS {
        let [r, g, b] = ColorMap::Magma.color(step as f32 / (STEPS - 1) as f32);
        let left = bar.left() + bar.width() * step as f32 / STEPS as f32;
        let size = vec2(bar.width() / STEPS as f32, bar.height());
        let part = Rect::from_min_size(pos2(left, bar.top()), size);
        painter.rect_filled(part, 0.0, Color32::from_rgb(r, g, b));
    }
    for (text, align, at) in [
        (
            "0",
            Align2::RIGHT_CENTER,
            bar.left_center() - vec2(3.0, 0.0),
        ),
        (
            "1",
            Align2::LEFT_CENTER,
            bar.right_center() + vec2(3.0, 0.0),
        ),
    ] {
        painter.text(
            at,
            align,
            text,
            FontId::proportional(11.0),
            palette.note_text,
        );
    }
}
