//! Two pipelines beside each other: what is shown of them, and what they cost.

mod numbers;
mod over;
pub mod report;

use egui::{Button, RichText, ScrollArea, Slider, Ui};

use super::{parameters, widgets};
use crate::ui::compare_actions::{self, CompareAction};
use crate::ui::editor::Editor;
use crate::ui::theme::Palette;
use crate::ui::workbench::comparing::{FASTEST, Mode};
use crate::ui::workbench::fields::Field;

pub use over::{interact, over};

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut on = editor.workbench.comparing.is_on();
    ui.horizontal_wrapped(|ui| {
        if ui.checkbox(&mut on, "Compare two pipelines").changed() {
            editor.workbench.compare(on);
        }
        let ctx = ui.ctx().clone();
        for (title, action, about) in [
            (
                "Copy view",
                CompareAction::CopyView,
                "What is on screen as a line of text: Ctrl+L",
            ),
            (
                "Paste view",
                CompareAction::PasteView,
                "Goes to what such a line says: Ctrl+G",
            ),
        ] {
            if ui.small_button(title).on_hover_text(about).clicked() {
                compare_actions::perform(editor, action, &ctx);
            }
        }
    });
    if !on {
        let text = "A is the pipeline of the toolbar. B is drawn beside it, on the same scene, camera and time. \
                    Key C begins and ends it.";
        ui.label(RichText::new(text).weak());
        ui.separator();
        report::show(editor, ui);
        return;
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        sides(editor, ui);
        how(editor, ui);
        ui.separator();
        numbers::show(editor, ui);
        ui.separator();
        report::show(editor, ui);
        ui.separator();
        values(editor, ui);
    });
}

/// Which pipeline B is.
fn sides(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let Some(side) = workbench.comparing.side() else {
        return;
    };
    let selected = side.pipelines.selected().to_owned();
    let busy = side.pipelines.is_busy() || side.pipelines.is_warming();
    let title = workbench.library.pipeline_title(&selected).to_owned();
    let first = workbench.pipelines.shown().unwrap_or_default();
    let first = format!("A: {}", workbench.library.pipeline_title(first));
    let mut wanted = None;
    ui.horizontal_wrapped(|ui| {
        ui.label(first);
        widgets::combo(ui, "Pipeline B", &title, 170.0, |ui| {
            for entry in &workbench.library.pipelines {
                let mut text = RichText::new(&entry.title);
                if entry.problem.is_some() {
                    text = text.color(Palette::of(ui).error);
                }
                let button = Button::selectable(entry.name == selected, text);
                if ui.add(button).clicked() {
                    wanted = Some(entry.name.clone());
                }
            }
        });
        if busy {
            ui.spinner();
        }
    });
    ui.horizontal_wrapped(|ui| {
        let ctx = ui.ctx().clone();
        for (title, action, about) in [
            (
                "Swap A and B",
                CompareAction::Swap,
                "The other panels show A. Shift+C",
            ),
            (
                "Give B what A has",
                CompareAction::Like,
                "The same pipeline with the same values, to change one of them",
            ),
        ] {
            if ui.button(title).on_hover_text(about).clicked() {
                compare_actions::perform(editor, action, &ctx);
            }
        }
    });
    if let Some(name) = wanted {
        editor.workbench.select_other(&name);
    }
}

/// What is shown of both.
fn how(editor: &mut Editor, ui: &mut Ui) {
    let comparing = &mut editor.workbench.comparing;
    ui.horizontal_wrapped(|ui| {
        for mode in Mode::ALL {
            ui.selectable_value(&mut comparing.mode, mode, mode.title());
        }
    });
    ui.horizontal_wrapped(|ui| match comparing.mode {
        Mode::Split => {
            let label = ui.label("Split at");
            let slider = Slider::new(&mut comparing.split, 0.0..=1.0).max_decimals(3);
            ui.add(slider).labelled_by(label.id).on_hover_text(
                "Drag the line in the picture, or Shift and the arrows left and right",
            );
        }
        Mode::Flicker => {
            let shown = if comparing.flicker.shows_b { "B" } else { "A" };
            if ui.button("Show the other").on_hover_text("Key B").clicked() {
                comparing.flicker.change();
            }
            ui.label(format!("{shown} is shown"));
            ui.checkbox(&mut comparing.flicker.automatic, "By itself");
            let label = ui.label("Changes a second");
            let slider = Slider::new(&mut comparing.flicker.rate, 0.25..=FASTEST).max_decimals(2);
            ui.add(slider).labelled_by(label.id).on_hover_text(
                "Not faster than this: quick flashes can bring on seizures (WCAG 2.2, 2.3.1).",
            );
        }
        Mode::Difference => {
            let label = ui.label("Gain");
            let slider = Slider::new(&mut comparing.gain, 1.0..=256.0)
                .logarithmic(true)
                .max_decimals(1);
            ui.add(slider).labelled_by(label.id);
            ui.checkbox(&mut comparing.false_colors, "False colours")
                .on_hover_text("The largest of the three channels in the colours of viridis");
        }
        Mode::Flip => {
            let label = ui.label("Opacity");
            let slider = Slider::new(&mut comparing.opacity, 0.0..=1.0).max_decimals(2);
            ui.add(slider).labelled_by(label.id);
        }
    });
}

/// The parameters of B.
fn values(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let Some(side) = workbench.comparing.side() else {
        return;
    };
    let slot = side.pipelines.slot(side.pipelines.selected());
    let fields = slot.and_then(|slot| {
        let desc = slot.desc()?;
        Some(Field::of_pipeline(&desc.parameters, &slot.settings))
    });
    let Some(fields) = fields else {
        ui.label(RichText::new("Pipeline B is not built yet.").weak());
        return;
    };
    ui.label(RichText::new("Parameters of B").strong());
    let changed = ui.push_id("parameters of B", |ui| parameters::edit(ui, &fields));
    if let Some((name, value)) = changed.inner {
        workbench.set_other_parameter(&name, value);
    }
}
