//! Two pipelines beside each other: what is shown of them, and what they cost.

mod numbers;
mod over;
pub mod report;

use egui::{Button, RichText, ScrollArea, Slider, Ui};

use super::{parameters, widgets};
use crate::ui::compare_actions::{self, CompareAction};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::comparing::{FASTEST, Mode};
use crate::ui::workbench::fields::Field;

pub use over::{interact, over};

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut on = editor.workbench.comparing.is_on();
    ui.horizontal_wrapped(|ui| {
        if ui
            .checkbox(&mut on, say!("compare.compare_two_pipelines"))
            .changed()
        {
            editor.workbench.compare(on);
        }
        let ctx = ui.ctx().clone();
        for (title, action, about) in [
            (
                say!("compare.copy_view"),
                CompareAction::CopyView,
                say!("compare.what_is_on_screen_as_a"),
            ),
            (
                say!("compare.paste_view"),
                CompareAction::PasteView,
                say!("compare.goes_to_what_such_a_line"),
            ),
        ] {
            if ui.small_button(title).on_hover_text(about).clicked() {
                compare_actions::perform(editor, action, &ctx);
            }
        }
    });
    if !on {
        let text = say!("compare.a_is_the_pipeline_of_the");
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
        widgets::combo(ui, say!("compare.pipeline_b"), &title, 170.0, |ui| {
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
                say!("compare.swap_a_and_b"),
                CompareAction::Swap,
                say!("compare.the_other_panels_show_a_shift"),
            ),
            (
                say!("compare.give_b_what_a_has"),
                CompareAction::Like,
                say!("compare.the_same_pipeline_with_the_same"),
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
            let label = ui.label(say!("compare.split_at"));
            let slider = Slider::new(&mut comparing.split, 0.0..=1.0).max_decimals(3);
            ui.add(slider)
                .labelled_by(label.id)
                .on_hover_text(say!("compare.drag_the_line_in_the_picture"));
        }
        Mode::Flicker => {
            let shown = if comparing.flicker.shows_b { "B" } else { "A" };
            if ui
                .button(say!("compare.show_the_other"))
                .on_hover_text(say!("compare.key_b"))
                .clicked()
            {
                comparing.flicker.change();
            }
            ui.label(say!("compare.is_shown", shown = shown));
            ui.checkbox(&mut comparing.flicker.automatic, say!("compare.by_itself"));
            let label = ui.label(say!("compare.changes_a_second"));
            let slider = Slider::new(&mut comparing.flicker.rate, 0.25..=FASTEST).max_decimals(2);
            ui.add(slider)
                .labelled_by(label.id)
                .on_hover_text(say!("compare.not_faster_than_this_quick_flashes"));
        }
        Mode::Difference => {
            let label = ui.label(say!("compare.gain"));
            let slider = Slider::new(&mut comparing.gain, 1.0..=256.0)
                .logarithmic(true)
                .max_decimals(1);
            ui.add(slider).labelled_by(label.id);
            ui.checkbox(&mut comparing.false_colors, say!("compare.false_colours"))
                .on_hover_text(say!("compare.the_largest_of_the_three_channels"));
        }
        Mode::Flip => {
            let label = ui.label(say!("compare.opacity"));
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
        ui.label(RichText::new(say!("compare.pipeline_b_is_not_built_yet")).weak());
        return;
    };
    ui.label(RichText::new(say!("compare.parameters_of_b_heading")).strong());
    let changed = ui.push_id("parameters of B", |ui| parameters::edit(ui, &fields));
    if let Some((name, value)) = changed.inner {
        workbench.set_other_parameter(&name, value);
    }
}
