//! The light at the probed pixel: lamp by lamp, and under another pipeline.

use egui::{Grid, RichText, ScrollArea, Ui};
use lightbench::world::Entity;
use lightbench::world::glam::DVec3;

use super::widgets::{MISSING, combo};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::lighting::Lit;

/// Lamps that are listed; the rest is summed up.
const MOST_LAMPS: usize = 40;

/// The switches of both parts.
pub fn choose(editor: &mut Editor, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        let workbench = &mut editor.workbench;
        let about = say!("pixel_light.what_each_light_adds_to_the");
        let on = ui.checkbox(
            &mut workbench.lighting.on,
            say!("pixel_light.light_by_light"),
        );
        if on.on_hover_text(about).changed() && workbench.lighting.on {
            workbench.light_pixel();
        }
        if workbench.lighting.is_waiting() {
            ui.spinner();
        }
        choose_beside(editor, ui);
    });
}

/// Draws both parts, where they are switched on.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &editor.workbench;
    let compares = workbench.lighting.on || workbench.beside.pipeline.is_some();
    if compares && workbench.clock.playing {
        let text = say!("pixel_light.while_time_runs_what_is_compared");
        ui.colored_label(Palette::of(ui).warning, text);
    }
    beside(editor, ui);
    lamps(editor, ui);
}

/// A table that may be wider than the panel.
fn wide(ui: &mut Ui, name: &str, rows: impl FnOnce(&mut Ui)) {
    ScrollArea::horizontal().id_salt(name).show(ui, |ui| {
        Grid::new(name).striped(true).show(ui, rows);
    });
}

fn numbers(values: [f64; 3]) -> String {
    values.map(|value| format!("{value:8.5}")).join(" ")
}

fn lamps(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    if !workbench.lighting.on {
        return;
    }
    let Some(lit) = workbench.lit() else {
        return;
    };
    for warning in &lit.warnings {
        ui.label(RichText::new(warning).weak());
    }
    if !lit.meets {
        ui.label(say!("pixel_light.nothing_is_drawn_there_the_pixel"));
    }
    let clicked = table(ui, lit);
    let [behind, outside, beyond] = lit.others;
    let others = [
        (behind, say!("pixel_light.shine_from_behind_the_surface")),
        (outside, say!("pixel_light.have_it_outside_of_their_cone")),
        (beyond, say!("pixel_light.are_too_far_off")),
    ];
    let others: Vec<String> = others
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, why)| format!("{count} {why}"))
        .collect();
    if !others.is_empty() {
        ui.label(
            RichText::new(say!("pixel_light.other_lights", lights = others.join(", "))).weak(),
        );
    }
    let hdr = workbench.probing.results.hdr;
    ui.label(match hdr {
        Some([r, g, b, _]) => against(lit.sum, DVec3::new(r.into(), g.into(), b.into())),
        None => say!("pixel_light.the_pipeline_names_no_target_of").to_owned(),
    });
    if let Some(scene) = workbench.scenes.scene()
        && let Some(entity) = clicked.filter(|entity| scene.world.contains(*entity))
    {
        workbench.selection.set(scene, [entity]);
    }
}

/// The sum and what the pipeline has, in words.
fn against(sum: DVec3, hdr: DVec3) -> String {
    let apart = (hdr - sum).abs().max_element();
    let share = apart / sum.abs().max_element().max(1e-9);
    say!(
        "pixel_light.the_pipeline_light_is_off_by",
        light = numbers(hdr.to_array()).trim_start(),
        apart = format_args!("{apart:.5}"),
        share = format_args!("{:.2}", share * 100.0)
    )
}

/// Draws the lamps. Returns the one that was clicked.
fn table(ui: &mut Ui, lit: &Lit) -> Option<Entity> {
    let mut clicked = None;
    let mono = |text: String| RichText::new(text).monospace();
    wide(ui, "lamps", |ui| {
        for title in [
            say!("pixel_light.light"),
            say!("pixel_light.kind"),
            say!("pixel_light.metres"),
            say!("pixel_light.radiance"),
        ] {
            ui.strong(title);
        }
        ui.end_row();
        for lamp in lit.lamps.iter().take(MOST_LAMPS) {
            let name = ui.selectable_label(false, &lamp.name);
            if name.on_hover_text(say!("pixel_light.chooses_it")).clicked() {
                clicked = Some(lamp.entity);
            }
            ui.label(lamp.kind);
            let metres = lamp.distance.map(|metres| format!("{metres:.2}"));
            ui.label(mono(metres.unwrap_or_else(|| MISSING.to_owned())));
            ui.label(mono(numbers(lamp.radiance.to_array())));
            ui.end_row();
        }
        let mut line = |name: String, value: DVec3| {
            ui.label(RichText::new(name).weak());
            ui.label("");
            ui.label("");
            ui.label(mono(numbers(value.to_array())));
            ui.end_row();
        };
        let rest = &lit.lamps[lit.lamps.len().min(MOST_LAMPS)..];
        if !rest.is_empty() {
            let sum = rest.iter().map(|lamp| lamp.radiance).sum();
            line(say!("pixel_light.more", rest = rest.len()), sum);
        }
        for (name, value) in [
            (say!("pixel_light.emitted"), lit.emitted),
            (say!("pixel_light.sky"), lit.sky),
        ] {
            if value != DVec3::ZERO {
                line(name.to_owned(), value);
            }
        }
        line(say!("pixel_light.sum").to_owned(), lit.sum);
    });
    clicked
}

fn choose_beside(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let chosen = workbench.beside.pipeline.clone();
    let title = |name: &str| workbench.library.pipeline_title(name).to_owned();
    let shown = chosen
        .as_deref()
        .map_or_else(|| say!("pixel_light.none").to_owned(), title);
    let here = workbench.pipelines.shown().unwrap_or_default().to_owned();
    let mut wanted = None;
    let response = combo(ui, say!("pixel_light.compare_with"), &shown, 170.0, |ui| {
        if ui
            .selectable_label(chosen.is_none(), say!("pixel_light.none"))
            .clicked()
        {
            wanted = Some(None);
        }
        for entry in &workbench.library.pipelines {
            let is_chosen = chosen.as_ref() == Some(&entry.name);
            if entry.name != here && ui.selectable_label(is_chosen, &entry.title).clicked() {
                wanted = Some(Some(entry.name.clone()));
            }
        }
    });
    response.on_hover_text(say!("pixel_light.draws_the_same_moment_once_with"));
    if workbench.beside.is_waiting() {
        ui.spinner();
    }
    if let Some(wanted) = wanted {
        workbench.put_beside(wanted.as_deref());
    }
}

/// What both pipelines leave in the pixel.
fn beside(editor: &Editor, ui: &mut Ui) {
    let workbench = &editor.workbench;
    if let Some(problem) = &workbench.beside.problem {
        ui.label(problem);
    }
    let Some(there) = workbench.pixel_beside() else {
        return;
    };
    let now = workbench.probing.results;
    let rgb = |value: Option<[f32; 4]>| value.map(|[r, g, b, _]| [r, g, b].map(f64::from));
    let apart = |here: Option<[f64; 3]>, there: Option<[f64; 3]>| {
        let both = here.zip(there);
        both.map(|(here, there)| [0, 1, 2].map(|channel| there[channel] - here[channel]))
    };
    let (light, picture) = (
        [rgb(now.hdr), rgb(there.hdr)],
        [rgb(now.output), rgb(there.output)],
    );
    wide(ui, "beside", |ui| {
        for title in ["", say!("pixel_light.light"), say!("pixel_light.picture")] {
            ui.strong(title);
        }
        ui.end_row();
        let rows = [
            (say!("pixel_light.here"), light[0], picture[0]),
            (say!("pixel_light.there"), light[1], picture[1]),
            (
                say!("pixel_light.difference"),
                apart(light[0], light[1]),
                apart(picture[0], picture[1]),
            ),
        ];
        for (name, light, picture) in rows {
            ui.label(name);
            for value in [light, picture] {
                let text = value.map_or_else(|| MISSING.to_owned(), numbers);
                ui.label(RichText::new(text).monospace());
            }
            ui.end_row();
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_difference_is_that_of_the_worst_channel() {
        let text = against(DVec3::new(1.0, 2.0, 4.0), DVec3::new(1.0, 2.5, 4.0));
        assert!(
            text.ends_with("off by 0.50000, 12.50 % of the sum."),
            "{text}"
        );
    }
}
