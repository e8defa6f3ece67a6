//! Parameters as widgets: of the pipeline and of the scene.

use egui::{Align, ComboBox, Layout, RichText, ScrollArea, TextEdit, Ui};
use lightbench::script::{Scene, SettingValue, Settings};
use lightbench::world::{Entity, Name};

use super::widgets::{slider, words};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::workbench::fields::{Field, FieldKind};

/// What somebody did to a field.
enum Change {
    Set(SettingValue),
    Reset,
}

impl Change {
    /// The value that was set; `None` for the default.
    fn value(self) -> Option<SettingValue> {
        match self {
            Self::Set(value) => Some(value),
            Self::Reset => None,
        }
    }
}

/// Draws the parameters of the selected pipeline.
pub fn pipeline(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let selected = workbench.pipelines.selected().to_owned();
    let Some(slot) = workbench.pipelines.slot(&selected) else {
        return;
    };
    let Some(desc) = slot.desc() else {
        ui.label(RichText::new(say!("parameters.the_pipeline_is_not_built_yet")).weak());
        return;
    };
    let description = desc.description.clone();
    let fields = Field::of_pipeline(&desc.parameters, &slot.settings);
    let scroll = ScrollArea::vertical().auto_shrink(false);
    let changed = scroll.show(ui, |ui| list(ui, &description, &fields)).inner;
    if let Some((name, change)) = changed {
        workbench.set_pipeline_parameter(&name, change.value());
    }
}

/// Draws fields without a description. Returns the name of the one that changed, with the value that it
/// is given, or `None` for its default.
pub(super) fn edit(ui: &mut Ui, fields: &[Field]) -> Option<(String, Option<SettingValue>)> {
    rows(ui, fields).map(|(name, change)| (name, change.value()))
}

/// Draws the parameters of the scene.
pub fn scene(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &mut editor.workbench;
    let scenes = &workbench.scenes;
    let Some(scene) = scenes.scene() else {
        ui.label(RichText::new(say!("parameters.the_scene_is_not_loaded_yet")).weak());
        return;
    };
    let settings = scenes.settings().cloned().unwrap_or_default();
    let fields = Field::of_scene(&scene.parameters, &settings);
    let entry = workbench.library.scene(scenes.selected());
    let description = entry.map_or(String::new(), |entry| entry.description.clone());
    let behaviours = behaviours(scene);
    let (mut changed, mut behaving) = (None, None);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        changed = list(ui, &description, &fields);
        for (entity, title, fields) in &behaviours {
            ui.add_space(6.0);
            ui.label(RichText::new(title).strong());
            ui.push_id(entity, |ui| {
                if let Some((name, change)) = rows(ui, fields) {
                    behaving = Some((*entity, name, change));
                }
            });
        }
    });
    if let Some((name, change)) = changed {
        workbench.set_scene_parameter(&name, change.value());
    }
    let Some((entity, name, change)) = behaving else {
        return;
    };
    let fields = behaviours.iter().find(|(owner, ..)| *owner == entity);
    let field = fields.and_then(|(.., fields)| fields.iter().find(|field| field.name == name));
    let value = match (change, field) {
        (Change::Set(value), _) => value,
        (Change::Reset, Some(field)) => field.default.clone(),
        (Change::Reset, None) => return,
    };
    workbench.set_behaviour_parameter(entity, &name, &value);
}

/// Behaviours whose parameters are shown; a scene may have thousands.
const MOST_BEHAVIOURS: usize = 32;

/// The first behaviours of a scene that have parameters: whose they are, a title, and what can be set.
fn behaviours(scene: &Scene) -> Vec<(Entity, String, Vec<Field>)> {
    let all = scene.behaviours().into_iter();
    all.filter(|behaviour| !behaviour.parameters.is_empty())
        .take(MOST_BEHAVIOURS)
        .map(|behaviour| {
            let name: Option<Name> = scene.world.get(behaviour.entity);
            let name = name.map_or_else(|| say!("parameters.no_name").to_owned(), |name| name.text);
            let file = behaviour.path.rsplit('/').next().unwrap_or_default();
            let kind = file.trim_end_matches(".rhai");
            let stopped = if behaviour.stopped {
                say!("parameters.stopped_by_an_error")
            } else {
                ""
            };
            let title = format!("{name}: {kind}{stopped}");
            let mut in_force = Settings::new();
            for parameter in &behaviour.parameters {
                in_force.set(&parameter.name, parameter.value.clone());
            }
            let fields = Field::of_scene(&behaviour.parameters, &in_force);
            (behaviour.entity, title, fields)
        })
        .collect()
}

/// Draws a description and all fields, and returns the field that changed.
fn list(ui: &mut Ui, description: &str, fields: &[Field]) -> Option<(String, Change)> {
    if !description.is_empty() {
        ui.label(RichText::new(description).weak());
        ui.add_space(4.0);
    }
    if fields.is_empty() {
        ui.label(RichText::new(say!("parameters.there_are_no_parameters")).weak());
    }
    rows(ui, fields)
}

fn rows(ui: &mut Ui, fields: &[Field]) -> Option<(String, Change)> {
    let mut changed = None;
    for field in fields {
        if let Some(change) = row(ui, field) {
            changed = Some((field.name.clone(), change));
        }
    }
    changed
}

fn row(ui: &mut Ui, field: &Field) -> Option<Change> {
    let mut change = None;
    let about = if field.description.is_empty() {
        say!("parameters.name_in_scripts", name = field.name)
    } else {
        say!(
            "parameters.description_and_name",
            description = field.description,
            name = field.name
        )
    };
    ui.horizontal(|ui| {
        let width = (ui.available_width() * 0.36).clamp(90.0, 170.0);
        let label = ui.allocate_ui_with_layout(
            egui::vec2(width, ui.spacing().interact_size.y),
            Layout::left_to_right(Align::Center),
            |ui| {
                ui.set_min_width(width);
                let label = egui::Label::new(words(&field.name)).truncate();
                ui.add(label).on_hover_text(&about)
            },
        );
        let id = label.inner.id;
        change = widget(ui, field, id);
        if field.is_changed() {
            let text = say!("parameters.back_to", default = field.default);
            let reset = ui
                .small_button(say!("parameters.reset"))
                .on_hover_text(text);
            if reset.clicked() {
                change = Some(Change::Reset);
            }
        }
    });
    change
}

fn widget(ui: &mut Ui, field: &Field, label: egui::Id) -> Option<Change> {
    match (&field.kind, &field.value) {
        (FieldKind::Number { min, max, whole }, value) => {
            let mut number = value.to_string().parse().unwrap_or(*min);
            let mut slider = slider(&mut number, *min..=*max);
            if *whole {
                slider = slider.integer();
            }
            if !field.unit.is_empty() {
                slider = slider.suffix(format!(" {}", field.unit));
            }
            let response = ui.add(slider).labelled_by(label);
            response.changed().then(|| Change::Set(number.into()))
        }
        (FieldKind::Switch, value) => {
            let mut on = *value == SettingValue::Switch(true);
            let response = ui.checkbox(&mut on, "").labelled_by(label);
            response.changed().then(|| Change::Set(on.into()))
        }
        (FieldKind::Choice { options }, value) => {
            let now = value.to_string();
            let mut wanted = now.clone();
            let combo = ComboBox::from_id_salt(("choice", &field.name)).selected_text(&now);
            let response = combo.show_ui(ui, |ui| {
                for option in options {
                    ui.selectable_value(&mut wanted, option.clone(), option);
                }
            });
            response.response.labelled_by(label);
            (wanted != now).then(|| Change::Set(wanted.into()))
        }
        (FieldKind::Text, value) => {
            let id = ui.scope_id().with(("text", &field.name));
            let kept: Option<String> = ui.data(|data| data.get_temp(id));
            let mut text = kept.unwrap_or_else(|| value.to_string());
            let response = ui.add(TextEdit::singleline(&mut text)).labelled_by(label);
            if response.has_focus() {
                // Half a path is no path: it counts when the field is left.
                ui.data_mut(|data| data.insert_temp(id, text));
                return None;
            }
            ui.data_mut(|data| data.remove_temp::<String>(id));
            let done = response.lost_focus() && text != value.to_string();
            done.then(|| Change::Set(text.into()))
        }
    }
}
