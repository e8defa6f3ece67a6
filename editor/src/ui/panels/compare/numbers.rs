//! What both sides cost, and how far their pictures are apart.

use egui::{Grid, RichText, Ui};
use lightbench::lab::diff::LdrDifference;

use super::super::widgets::{MISSING, bytes, count, ms};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::workbench::Workbench;
use crate::ui::workbench::comparing::{Cost, Costs};

/// The width at which what it costs and how far the pictures are apart stand beside each other.
const BESIDE: f32 = 470.0;

/// Frames that the button adds to the medians.
const MORE: u32 = 20;

/// Draws the numbers.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &editor.workbench;
    let sides = workbench.costs();
    if ui.available_width() < BESIDE {
        pictures(workbench, ui);
        ui.add_space(4.0);
        costs(workbench, &sides, ui);
    } else {
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| costs(workbench, &sides, ui));
            ui.add_space(6.0);
            ui.vertical(|ui| pictures(workbench, ui));
        });
    }
    for (name, side) in ["A", "B"].into_iter().zip(&sides) {
        for (what, value) in side.iter().flat_map(|side| &side.counters) {
            let text = format!("{name}: {what}: {}", count(u64::from(*value)));
            ui.label(RichText::new(text).small());
        }
    }
    ui.horizontal_wrapped(|ui| {
        let about = say!("compare.draws_the_same_moment_so_many");
        let title = say!("compare.draw_more", more = MORE);
        if ui.small_button(title).on_hover_text(about).clicked() {
            editor.workbench.draw_more(MORE);
        }
        let text = if editor.workbench.gpu().summary.software {
            say!("compare.drawn_in_turn_by_the_processor")
        } else {
            say!("compare.drawn_in_turn_for_times_to")
        };
        ui.label(RichText::new(text).small().weak());
    });
}

/// The numbers of a difference, as they are shown and kept: what, the value, and what it means.
pub fn lines(difference: &LdrDifference) -> [(&'static str, String, &'static str); 5] {
    let psnr = match difference.srgb.psnr_db {
        db if db.is_finite() => say!("compare.db", db = format_args!("{db:.2}")),
        _ => say!("compare.equal").to_owned(),
    };
    [
        (
            say!("compare.flip_mean"),
            format!("{:.5}", difference.flip.mean),
            say!("compare.flip_mean_is"),
        ),
        (
            say!("compare.flip_largest"),
            format!("{:.5}", difference.flip.max),
            say!("compare.of_the_pixel_that_differs_most"),
        ),
        (
            say!("compare.mse"),
            format!("{:.3e}", difference.srgb.mse),
            say!("compare.mean_of_the_squares_of_display"),
        ),
        (say!("compare.psnr"), psnr, say!("compare.psnr_is")),
        (
            say!("compare.largest_difference"),
            format!("{} / 255", difference.srgb.max_steps),
            say!("compare.of_any_channel_of_any_pixel"),
        ),
    ]
}

/// How far the pictures are apart.
fn pictures(workbench: &Workbench, ui: &mut Ui) {
    let Some(judgement) = workbench.judgement() else {
        let text = if workbench.judgement_is_coming() {
            say!("compare.the_pictures_are_compared_as_soon")
        } else {
            say!("compare.the_pictures_are_not_compared_yet")
        };
        ui.label(RichText::new(text).weak());
        return;
    };
    let (width, height) = judgement.judged.size;
    let of = match judgement.frames_ago {
        0 => say!("compare.of_the_picture_on_screen").to_owned(),
        1 => say!("compare.of_the_picture_1_frame_ago").to_owned(),
        ago => say!("compare.of_the_picture_frames_ago", ago = count(ago)),
    };
    Grid::new("how far apart")
        .num_columns(2)
        .spacing([9.0, 2.0])
        .show(ui, |ui| {
            for (what, value, about) in lines(&judgement.judged.difference) {
                ui.label(what).on_hover_text(about);
                ui.label(RichText::new(value).monospace());
                ui.end_row();
            }
        });
    ui.label(
        RichText::new(say!(
            "compare.eight_bits",
            width = width,
            height = height,
            of = of
        ))
        .small()
        .weak(),
    );
}

/// What the frames of both cost.
fn costs(workbench: &Workbench, sides: &[Option<Costs>; 2], ui: &mut Ui) {
    let cell = |of: &dyn Fn(&Costs) -> String, side: &Option<Costs>| {
        side.as_ref().map_or_else(|| MISSING.to_owned(), of)
    };
    let time = |cost: Cost| match cost.median_ms {
        Some(_) => say!(
            "compare.ms",
            median_ms = ms(cost.median_ms),
            frames = cost.frames
        ),
        None => MISSING.to_owned(),
    };
    let why_no_time = if workbench.gpu().has_timestamps() {
        say!("compare.from_the_first_pass_to_the")
    } else {
        say!("compare.this_adapter_has_no_timestamps")
    };
    type Row<'a> = (&'a str, &'a dyn Fn(&Costs) -> String, &'a str);
    let rows: [Row<'_>; 6] = [
        (say!("compare.gpu_time"), &|c| time(c.gpu), why_no_time),
        (
            say!("compare.cpu_time"),
            &|c| time(c.cpu),
            say!("compare.to_extract_and_record_a_frame"),
        ),
        (
            say!("compare.draws_dispatches"),
            &|c| count(c.calls),
            say!("compare.of_the_last_frame"),
        ),
        (
            say!("compare.bytes_moved"),
            &|c| bytes(c.moved_bytes),
            say!("compare.read_and_written_in_a_frame"),
        ),
        (
            say!("compare.memory"),
            &|c| bytes(c.target_bytes),
            say!("compare.all_targets_and_buffers_of_the"),
        ),
        (
            say!("compare.lights_in_view"),
            &|c| count(u64::from(c.lights)),
            say!("compare.that_reach_into_what_the_camera"),
        ),
    ];
    Grid::new("what it costs")
        .num_columns(3)
        .spacing([9.0, 2.0])
        .striped(true)
        .show(ui, |ui| {
            ui.label("");
            for (name, side) in ["A", "B"].into_iter().zip(sides) {
                let title = cell(&|c| c.title.clone(), side);
                ui.label(RichText::new(name).strong()).on_hover_text(title);
            }
            ui.end_row();
            for (what, of, about) in rows {
                ui.label(what).on_hover_text(about);
                for side in sides {
                    ui.label(RichText::new(cell(of, side)).monospace());
                }
                ui.end_row();
            }
        });
}
