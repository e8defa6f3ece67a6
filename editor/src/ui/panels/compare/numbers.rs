//! What both sides cost, and how far their pictures are apart.

use egui::{Grid, RichText, Ui};
use lightbench::lab::diff::LdrDifference;

use super::super::widgets::{MISSING, bytes, count, ms};
use crate::ui::editor::Editor;
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
        let about = "Draws the same moment so many times more, in turn, for medians of more frames";
        let title = format!("Draw {MORE} more");
        if ui.small_button(title).on_hover_text(about).clicked() {
            editor.workbench.draw_more(MORE);
        }
        let text = if editor.workbench.gpu().summary.software {
            "Drawn in turn by the processor: for times to rely on, write a report."
        } else {
            "Drawn in turn: for times to rely on, write a report."
        };
        ui.label(RichText::new(text).small().weak());
    });
}

/// The numbers of a difference, as they are shown and kept: what, the value, and what it means.
pub fn lines(difference: &LdrDifference) -> [(&'static str, String, &'static str); 5] {
    let psnr = match difference.srgb.psnr_db {
        db if db.is_finite() => format!("{db:.2} dB"),
        _ => "equal".to_owned(),
    };
    [
        (
            "FLIP, mean",
            format!("{:.5}", difference.flip.mean),
            "0 where nobody sees a difference, 1 where it is largest. A is the reference.",
        ),
        (
            "FLIP, largest",
            format!("{:.5}", difference.flip.max),
            "Of the pixel that differs most.",
        ),
        (
            "MSE",
            format!("{:.3e}", difference.srgb.mse),
            "Mean of the squares, of display-ready values from 0 to 1.",
        ),
        ("PSNR", psnr, "10 log10 (1 / MSE)."),
        (
            "Largest difference",
            format!("{} / 255", difference.srgb.max_steps),
            "Of any channel of any pixel, in steps of 8 bits.",
        ),
    ]
}

/// How far the pictures are apart.
fn pictures(workbench: &Workbench, ui: &mut Ui) {
    let Some(judgement) = workbench.judgement() else {
        let text = if workbench.judgement_is_coming() {
            "The pictures are compared as soon as nothing moves."
        } else {
            "The pictures are not compared yet."
        };
        ui.label(RichText::new(text).weak());
        return;
    };
    let (width, height) = judgement.judged.size;
    let of = match judgement.frames_ago {
        0 => "of the picture on screen".to_owned(),
        1 => "of the picture 1 frame ago".to_owned(),
        ago => format!("of the picture {} frames ago", count(ago)),
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
        RichText::new(format!("8 bits, sRGB, {width} x {height}, {of}"))
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
        Some(_) => format!("{} ms ({})", ms(cost.median_ms), cost.frames),
        None => MISSING.to_owned(),
    };
    let why_no_time = if workbench.gpu().has_timestamps() {
        "From the first pass to the last: median, and of how many frames."
    } else {
        "This adapter has no timestamps."
    };
    type Row<'a> = (&'a str, &'a dyn Fn(&Costs) -> String, &'a str);
    let rows: [Row<'_>; 6] = [
        ("GPU time", &|c| time(c.gpu), why_no_time),
        (
            "CPU time",
            &|c| time(c.cpu),
            "To extract and record a frame: median, and of how many frames.",
        ),
        (
            "Draws, dispatches",
            &|c| count(c.calls),
            "Of the last frame.",
        ),
        (
            "Bytes moved",
            &|c| bytes(c.moved_bytes),
            "Read and written in a frame: modelled from formats and sizes.",
        ),
        (
            "Memory",
            &|c| bytes(c.target_bytes),
            "All targets and buffers of the pipeline.",
        ),
        (
            "Lights in view",
            &|c| count(u64::from(c.lights)),
            "That reach into what the camera sees.",
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
