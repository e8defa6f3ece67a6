//! One field of a component as widgets.

use egui::{Align, ComboBox, DragValue, Layout, Response, RichText, Sense, TextEdit, Ui, vec2};
use lightbench::script::Scene;
use lightbench::script::overlays::{AssetId, Overlay, Who, degrees_of, editable, rotation_of};
use lightbench::world::glam::{DVec3, Vec2, Vec3, Vec4};
use lightbench::world::reflect::FieldInfo;
use lightbench::world::{ComponentKind, Value, ValueType};

use crate::ui::messages::say;
use crate::ui::panels::widgets::words;
use crate::ui::theme::Palette;

/// A field, its value, and what lies over it.
pub struct Row<'a> {
    pub scene: &'a Scene,
    pub kind: ComponentKind,
    pub info: &'static FieldInfo,
    pub path: &'static str,
    pub value: &'a Value,
    /// Whether others that are chosen have another value.
    pub differs: bool,
    pub overlay: Option<&'a Overlay>,
    /// Why nothing of this entity can be changed.
    pub refused: Option<&'a str>,
}

/// What somebody did to a field.
pub enum Done {
    Set(Value),
    Reset,
    Copy,
    Asset(Choice),
}

/// Another mesh or material; none for the one that the script gave.
pub enum Choice {
    Mesh(Option<Who>),
    Material(Option<Who>),
}

/// A text of the source in one line.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A message as a sentence.
pub fn sentence(message: &str) -> String {
    let mut letters = message.chars();
    let first = letters.next().map(char::to_uppercase);
    let text: String = first.into_iter().flatten().chain(letters).collect();
    if text.ends_with('.') {
        text
    } else {
        format!("{text}.")
    }
}

/// A value in few letters.
pub fn text_of(value: &Value) -> String {
    let all = |numbers: &[f32]| {
        let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
        numbers.join(", ")
    };
    match value {
        Value::Bool(on) => if *on {
            say!("entities.yes")
        } else {
            say!("entities.no")
        }
        .to_owned(),
        Value::Int(whole) => whole.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Vec2(pair) => all(&pair.to_array()),
        Value::Vec3(vector) => all(&vector.to_array()),
        Value::Vec4(four) => all(&four.to_array()),
        Value::Quat(rotation) => {
            let degrees = degrees_of(*rotation).as_vec3().to_array();
            format!("{} °", all(&degrees))
        }
        Value::Text(text) => text.clone(),
        Value::Mat3(matrix) => all(&matrix.transpose().to_cols_array()),
        Value::Mat4(matrix) => all(&matrix.transpose().to_cols_array()),
        Value::Entity(entity) => entity.to_string(),
        Value::Mesh(id) => say!("entities.mesh", id = id.0),
        Value::Material(id) => say!("entities.material", id = id.0),
        Value::List(items) => say!("entities.items", items = items.len()),
        Value::Map(entries) if entries.is_empty() => say!("entities.none").to_owned(),
        Value::Map(entries) => {
            let names: Vec<&str> = entries.iter().map(|(name, _)| name.as_str()).collect();
            names.join(", ")
        }
    }
}

impl Row<'_> {
    /// Draws the row.
    pub fn show(&self, ui: &mut Ui) -> Option<Done> {
        let mut done = None;
        ui.horizontal(|ui| {
            self.dot(ui);
            let label = self.label(ui);
            if self.kind == ComponentKind::MeshRenderer && self.refused.is_none() {
                let chosen = self.asset(ui, label.id);
                if let Some(chosen) = chosen {
                    done = chosen.map(Done::Asset);
                    return;
                }
            }
            let locked = editable(self.kind, self.info).err().or(self.refused);
            if let Some(why) = locked {
                let text = RichText::new(self.text()).monospace().weak();
                ui.add(egui::Label::new(text).truncate())
                    .on_hover_text(sentence(why));
                return;
            }
            done = self.widget(ui, label.id).map(Done::Set);
            // Behind the widget, which would be another one for egui if something before it came or went
            // while it is dragged.
            if self.differs {
                let about = say!("entities.what_is_chosen_has_different_values");
                ui.label(RichText::new("differs").small().italics())
                    .on_hover_text(about);
            }
            if let Some(overlay) = self.overlay {
                let about = match &overlay.script {
                    Some(script) => say!("entities.back_to_the_script", script = text_of(script)),
                    None => say!("entities.forget_the_change").to_owned(),
                };
                if ui
                    .small_button(say!("entities.reset"))
                    .on_hover_text(about)
                    .clicked()
                {
                    done = Some(Done::Reset);
                }
                let about = say!("entities.the_line_of_a_scene_script");
                if ui
                    .small_button(say!("entities.copy"))
                    .on_hover_text(about)
                    .clicked()
                {
                    done = Some(Done::Copy);
                }
            }
        });
        done
    }

    /// The choice of a mesh or a material; none for other fields.
    #[allow(clippy::option_option)]
    fn asset(&self, ui: &mut Ui, label: egui::Id) -> Option<Option<Choice>> {
        let is_mesh = match self.value {
            Value::Mesh(_) => true,
            Value::Material(_) => false,
            _ => return None,
        };
        let mut chosen = None;
        let combo = ComboBox::from_id_salt("asset")
            .selected_text(self.text())
            .width(150.0)
            .truncate();
        let response = combo.show_ui(ui, |ui| {
            let listing = self.scene.listed();
            let shown = match is_mesh {
                true => listing.meshes(),
                false => listing.materials(),
            };
            for one in shown {
                let (fits, is_now) = match (one.id, self.value) {
                    (AssetId::Mesh(id), Value::Mesh(now)) => (true, id == *now),
                    (AssetId::Material(id), Value::Material(now)) => (true, id == *now),
                    _ => (false, false),
                };
                if fits && ui.selectable_label(is_now, one.who.words()).clicked() {
                    chosen = Some(match is_mesh {
                        true => Choice::Mesh(Some(one.who.clone())),
                        false => Choice::Material(Some(one.who.clone())),
                    });
                }
            }
        });
        response.response.labelled_by(label);
        if self.differs {
            let about = say!("materials.differs_about");
            ui.label(RichText::new(say!("materials.differs")).small().italics())
                .on_hover_text(about);
        }
        let button = ui.small_button(say!("assets.script_s_own"));
        let about = match is_mesh {
            true => say!("assets.script_s_mesh"),
            false => say!("assets.script_s_material"),
        };
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, about));
        if button.on_hover_text(about).clicked() {
            chosen = Some(match is_mesh {
                true => Choice::Mesh(None),
                false => Choice::Material(None),
            });
        }
        Some(chosen)
    }

    /// The mark of a field that was changed by hand.
    fn dot(&self, ui: &mut Ui) {
        let (rect, response) = ui.allocate_exact_size(vec2(10.0, 22.0), Sense::hover());
        let Some(overlay) = self.overlay else {
            return;
        };
        let palette = Palette::of(ui);
        let color = match overlay.contested {
            true => palette.warning,
            false => palette.accent,
        };
        ui.painter().circle_filled(rect.center(), 3.5, color);
        let script = overlay.script.as_ref().map_or_else(String::new, text_of);
        let mut about = say!("entities.changed_by_hand_the_script_value", script = script);
        if overlay.contested {
            about += say!("entities.the_script_a_behaviour_or_a");
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &about));
        response.on_hover_text(about);
    }

    fn label(&self, ui: &mut Ui) -> Response {
        let mut about = one_line(self.info.doc);
        let (least, greatest) = self.info.range;
        match (least.is_finite(), greatest.is_finite()) {
            (true, true) => {
                about += &say!(
                    "entities.from_to",
                    least = least,
                    greatest = greatest,
                    unit = self.info.unit
                )
            }
            (true, false) => {
                about += &say!("entities.at_least", least = least, unit = self.info.unit)
            }
            (false, true) => {
                about += &say!(
                    "entities.at_most",
                    greatest = greatest,
                    unit = self.info.unit
                )
            }
            (false, false) if self.info.unit.is_empty() => {}
            (false, false) => about += &say!("entities.in_unit", unit = self.info.unit),
        }
        about += &say!("entities.name_in_scripts", path = self.path);
        let width = (ui.available_width() * 0.28).clamp(70.0, 120.0);
        let size = vec2(width, ui.spacing().interact_size.y);
        let label = ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(width);
            ui.add(egui::Label::new(words(self.info.name)).truncate())
                .on_hover_text(about)
        });
        label.inner
    }

    /// The value, with the names of what it stands for.
    fn text(&self) -> String {
        let assets = &self.scene.assets;
        match self.value {
            Value::Mesh(id) => assets
                .mesh(*id)
                .map_or_else(|| text_of(self.value), |mesh| mesh.name.to_string()),
            Value::Material(id) => assets
                .material(*id)
                .map_or_else(|| text_of(self.value), |material| material.name.clone()),
            value => text_of(value),
        }
    }

    fn widget(&self, ui: &mut Ui, label: egui::Id) -> Option<Value> {
        match self.value {
            Value::Bool(on) => {
                let mut on = *on;
                let response = ui.checkbox(&mut on, "").labelled_by(label);
                response.changed().then_some(Value::Bool(on))
            }
            Value::Int(whole) => {
                let mut whole = *whole;
                let response = ui.add(DragValue::new(&mut whole)).labelled_by(label);
                response.changed().then_some(Value::Int(whole))
            }
            Value::Float(number) => {
                let mut number = *number;
                let suffix = self.unit();
                let response = self.number(ui, &mut number, "", &suffix);
                response
                    .labelled_by(label)
                    .changed()
                    .then_some(Value::Float(number))
            }
            Value::Vec2(pair) => {
                let changed = self.numbers(ui, pair.to_array(), ["x", "y"], label);
                changed.map(|pair| Value::Vec2(Vec2::from_array(pair)))
            }
            Value::Vec3(color) if self.info.is_color() => self.color(ui, *color, label),
            Value::Vec3(vector) => {
                let changed = self.numbers(ui, vector.to_array(), ["x", "y", "z"], label);
                changed.map(|vector| Value::Vec3(Vec3::from_array(vector)))
            }
            Value::Vec4(four) => {
                let changed = self.numbers(ui, four.to_array(), ["x", "y", "z", "w"], label);
                changed.map(|four| Value::Vec4(Vec4::from_array(four)))
            }
            Value::Quat(rotation) => {
                let mut degrees = degrees_of(*rotation).to_array();
                let mut changed = false;
                for (angle, axis) in degrees.iter_mut().zip(["x ", "y ", "z "]) {
                    let field = DragValue::new(angle)
                        .speed(0.5)
                        .max_decimals(2)
                        .prefix(axis)
                        .suffix("°");
                    changed |= ui.add(field).labelled_by(label).changed();
                }
                changed.then(|| Value::Quat(rotation_of(DVec3::from_array(degrees))))
            }
            Value::Text(text) => match self.info.value_type {
                ValueType::Choice(names) => choice(ui, text, names, label),
                _ => self.line_of_text(ui, text, label),
            },
            _ => None,
        }
    }

    /// The unit behind a number: angles are shown in degrees.
    fn unit(&self) -> String {
        match self.info.unit {
            "" => String::new(),
            "rad" => "°".to_owned(),
            "rad/s" => " °/s".to_owned(),
            // One that depends stands in the text of the label.
            unit if unit.contains(' ') => String::new(),
            unit => format!(" {unit}"),
        }
    }

    fn number(&self, ui: &mut Ui, number: &mut f32, prefix: &str, suffix: &str) -> Response {
        let angle = self.info.unit.starts_with("rad");
        let scale = if angle { 1.0_f32.to_degrees() } else { 1.0 };
        let (least, greatest) = self.info.range;
        let mut shown = *number * scale;
        let speed = (f64::from(shown.abs()) * 0.01).clamp(0.005, 1e6);
        let field = DragValue::new(&mut shown)
            .speed(speed)
            .range(least * scale..=greatest * scale)
            .clamp_existing_to_range(false)
            .max_decimals(4)
            .prefix(prefix)
            .suffix(suffix);
        let response = ui.add(field);
        if response.changed() {
            // The way by degrees may end a bit outside.
            *number = (shown / scale).clamp(least, greatest);
        }
        response
    }

    fn numbers<const N: usize>(
        &self,
        ui: &mut Ui,
        mut numbers: [f32; N],
        axes: [&str; N],
        label: egui::Id,
    ) -> Option<[f32; N]> {
        let mut changed = false;
        for (number, axis) in numbers.iter_mut().zip(axes) {
            let response = self.number(ui, number, &format!("{axis} "), "");
            changed |= response.labelled_by(label).changed();
        }
        let unit = self.unit();
        if !unit.is_empty() {
            ui.label(RichText::new(unit.trim()).weak());
        }
        changed.then_some(numbers)
    }

    fn color(&self, ui: &mut Ui, color: Vec3, label: egui::Id) -> Option<Value> {
        let mut picked = color.to_array();
        // The picker knows no light that is brighter than a screen; the numbers do.
        let picker = ui.color_edit_button_rgb(&mut picked).labelled_by(label);
        let typed = self.numbers(ui, color.to_array(), ["r", "g", "b"], label);
        let changed = typed.or_else(|| picker.changed().then_some(picked));
        changed.map(|color| Value::Vec3(Vec3::from_array(color)))
    }

    fn line_of_text(&self, ui: &mut Ui, text: &str, label: egui::Id) -> Option<Value> {
        let id = ui.scope_id().with("text");
        let kept: Option<String> = ui.data(|data| data.get_temp(id));
        let mut typed = kept.unwrap_or_else(|| text.to_owned());
        let response = ui.add(TextEdit::singleline(&mut typed)).labelled_by(label);
        if response.has_focus() {
            // Half a word is none: it counts when the field is left.
            ui.data_mut(|data| data.insert_temp(id, typed));
            return None;
        }
        ui.data_mut(|data| data.remove_temp::<String>(id));
        let done = response.lost_focus() && typed != text;
        done.then_some(Value::Text(typed))
    }
}

fn choice(ui: &mut Ui, now: &str, names: &[&str], label: egui::Id) -> Option<Value> {
    let mut wanted = now.to_owned();
    let combo = ComboBox::from_id_salt("choice").selected_text(now);
    let response = combo.show_ui(ui, |ui| {
        for name in names {
            ui.selectable_value(&mut wanted, (*name).to_owned(), *name);
        }
    });
    response.response.labelled_by(label);
    (wanted != now).then_some(Value::Text(wanted))
}
