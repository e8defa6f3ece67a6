//! Scene, pipeline and time at a glance.

use egui::{Button, DragValue, RichText, Ui};

use super::pipelines::{favourites, key_of};
use super::{heat_map, widgets};
use crate::ui::actions::{Action, shortcut_text};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::handles::Tool;
use crate::ui::theme::Palette;
use crate::ui::workbench::clock::{RATES, SPEEDS};
use crate::ui::workbench::flat::Side;
use crate::ui::workbench::sight::Sight;

/// Draws the toolbar.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    ui.add_space(1.0);
    ui.horizontal_wrapped(|ui| {
        // A button goes to the next line as a whole.
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        scene(editor, ui);
        ui.separator();
        pipeline(editor, ui);
        heat_map::choose(editor, ui);
        ui.separator();
        time(editor, ui);
        ui.separator();
        camera(editor, ui);
        ui.separator();
        handles(editor, ui);
    });
    ui.add_space(1.0);
}

fn scene(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let selected = workbench.scenes.selected().to_owned();
    let entries = &workbench.library.scenes;
    let title = |name: &str| {
        let entry = entries.iter().find(|entry| entry.name == name);
        entry.map_or_else(|| name.to_owned(), |entry| entry.title.clone())
    };
    let mut wanted = None;
    widgets::combo(ui, say!("toolbar.scene"), &title(&selected), 130.0, |ui| {
        for entry in entries {
            let response = ui.selectable_label(entry.name == selected, &entry.title);
            if response.clicked() {
                wanted = Some(entry.name.clone());
            }
            if !entry.description.is_empty() {
                response.on_hover_text(&entry.description);
            }
        }
    });
    if let Some(name) = wanted {
        workbench.select_scene(&name);
    }
}

fn pipeline(editor: &mut Editor, ui: &mut Ui) {
    let favourites = favourites(editor);
    let workbench = &mut editor.workbench;
    let selected = workbench.pipelines.selected().to_owned();
    let mut wanted = None;
    let title = workbench.library.pipeline_title(&selected);
    let response = widgets::combo(ui, say!("toolbar.pipeline"), title, 190.0, |ui| {
        for entry in &workbench.library.pipelines {
            let mut text = RichText::new(&entry.title);
            if entry.problem.is_some() {
                text = text.color(Palette::of(ui).error);
            }
            let mut button = Button::selectable(entry.name == selected, text);
            if let Some(key) = key_of(&favourites, &entry.name) {
                button = button.shortcut_text(key.to_string());
            }
            let response = ui.add(button);
            if response.clicked() {
                wanted = Some(entry.name.clone());
            }
            let about = match &entry.problem {
                Some(problem) => problem.to_string(),
                None => entry.description.clone(),
            };
            if !about.is_empty() {
                response.on_hover_text(about);
            }
        }
    });
    response.on_hover_text(say!("toolbar.keys_1_to_9_and_scene"));
    // Its place stays, so that nothing else moves and the picture keeps its size.
    let size = egui::Vec2::splat(ui.spacing().interact_size.y);
    let (place, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    if workbench.pipelines.is_busy() {
        egui::Spinner::new().paint_at(ui, place);
    }
    if let Some(name) = wanted {
        workbench.select_pipeline(&name);
    }
}

fn time(editor: &mut Editor, ui: &mut Ui) {
    let playing = editor.workbench.clock.playing;
    let label = if playing {
        say!("toolbar.pause")
    } else {
        say!("toolbar.play")
    };
    button(editor, ui, label, Action::PlayPause);
    button(editor, ui, say!("toolbar.step"), Action::Step);
    let in_play = editor.workbench.is_in_play();
    button_if(editor, ui, in_play, say!("toolbar.stop"), Action::Stop);
    button(editor, ui, say!("toolbar.rewind"), Action::Rewind);
    let time = editor.workbench.clock.time();
    let label = ui.label(say!("toolbar.speed"));
    let speed = DragValue::new(&mut editor.workbench.clock.speed)
        .range(SPEEDS)
        .speed(0.01)
        .fixed_decimals(2)
        .suffix(" x");
    ui.add(speed).labelled_by(label.id);
    let rate = &mut editor.workbench.clock.rate;
    let words = |rate: Option<u32>| match rate {
        None => say!("toolbar.as_drawn").to_owned(),
        Some(rate) => format!("1/{rate} s"),
    };
    let steps = widgets::combo(ui, say!("toolbar.steps"), &words(*rate), 66.0, |ui| {
        for choice in std::iter::once(None).chain(RATES.map(Some)) {
            ui.selectable_value(rate, choice, words(choice));
        }
    });
    steps.on_hover_text(say!("toolbar.how_far_the_scene_goes_in"));
    ui.label(RichText::new(format!("{time:9.3} s")).monospace());
}

fn camera(editor: &mut Editor, ui: &mut Ui) {
    button(editor, ui, say!("toolbar.frame"), Action::Frame);
    sight(editor, ui);
    let away = editor.workbench.is_camera_away();
    button_if(
        editor,
        ui,
        away,
        say!("toolbar.reset_camera"),
        Action::ResetCamera,
    );
    ui.separator();
    // Together on one line, where the toolbar takes two.
    ui.horizontal(|ui| {
        let label = ui.label(say!("toolbar.flying_speed"));
        let focus = editor.workbench.focus();
        let field = DragValue::new(&mut editor.workbench.camera_of_mut(focus).speed)
            .range(0.01..=10_000.0)
            .speed(0.05)
            .max_decimals(2)
            .suffix(" m/s");
        ui.add(field).labelled_by(label.id);
    });
}

/// What the handles of the selection do.
fn handles(editor: &mut Editor, ui: &mut Ui) {
    for tool in Tool::ALL {
        let chosen = editor.viewport.handles.tool == tool;
        let mut response = ui.selectable_label(chosen, tool.title());
        if let Some(key) = shortcut_text(ui.ctx(), Action::Tool(tool)) {
            response = response.on_hover_text(key);
        }
        if response.clicked() {
            editor.viewport.handles.tool = tool;
        }
    }
    let handles = &mut editor.viewport.handles;
    let about = say!("toolbar.handles_along_the_axes_of_the");
    ui.checkbox(&mut handles.local, say!("toolbar.local"))
        .on_hover_text(about);
    let label = ui.label(say!("toolbar.snap"));
    let (step, range, suffix) = match handles.tool {
        Tool::Move => (&mut handles.snap.distance, 0.001..=1000.0, " m"),
        Tool::Turn => (&mut handles.snap.angle, 0.1..=180.0, "°"),
        Tool::Scale => (&mut handles.snap.scale, 0.01..=10.0, " x"),
    };
    let field = DragValue::new(step)
        .range(range)
        .speed(0.01)
        .max_decimals(3)
        .suffix(suffix);
    ui.add(field)
        .labelled_by(label.id)
        .on_hover_text(say!("toolbar.the_steps_in_which_handles_go"));
}

/// What the viewport looks through.
fn sight(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let now = workbench.sight();
    let title = |sight: &Sight| match sight {
        Sight::Perspective => say!("toolbar.perspective").to_owned(),
        Sight::Camera(name) if name.is_empty() => say!("toolbar.scene").to_owned(),
        Sight::Camera(name) => name.clone(),
        Sight::Side(side) => side.title().to_owned(),
    };
    let cameras = workbench.cameras().into_iter().map(Sight::Camera);
    let all: Vec<Sight> = [Sight::Perspective]
        .into_iter()
        .chain(Side::ALL.map(Sight::Side))
        .chain(cameras)
        .collect();
    let mut wanted = None;
    widgets::combo(ui, say!("toolbar.view"), &title(&now), 90.0, |ui| {
        for (index, sight) in all.iter().enumerate() {
            ui.push_id(index, |ui| {
                if ui.selectable_label(*sight == now, title(sight)).clicked() {
                    wanted = Some(sight.clone());
                }
            });
        }
    });
    if let Some(sight) = wanted {
        workbench.look_through(sight);
    }
}

fn button(editor: &mut Editor, ui: &mut Ui, label: &str, action: Action) {
    button_if(editor, ui, true, label, action);
}

/// The same, where it may have nothing to do.
fn button_if(editor: &mut Editor, ui: &mut Ui, enabled: bool, label: &str, action: Action) {
    let mut response = ui.add_enabled(enabled, Button::new(label));
    if let Some(key) = shortcut_text(ui.ctx(), action) {
        response = response.on_hover_text(key);
    }
    if response.clicked() {
        let ctx = ui.ctx().clone();
        editor.perform(action, &ctx);
    }
}
