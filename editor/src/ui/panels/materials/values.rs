//! Values of materials as widgets.

use std::ops::RangeInclusive;

use egui::{ComboBox, DragValue, Slider, SliderClamping, Ui};
use lightbench::assets::{Reflection, ReflectionModel};
use lightbench::script::overlays::{Listed, Picture, SurfaceField, SurfaceValue};
use lightbench::world::glam::Vec3;

use super::fields::align;
use crate::ui::messages::{message, say, text};
use crate::ui::panels::widgets::words;

/// The alpha below which points are holes, where that is switched on.
const CUTOFF: f32 = 0.5;

/// A field and its value.
pub(super) struct Row<'a> {
    pub field: SurfaceField,
    pub value: &'a SurfaceValue,
    /// The textures of the scene.
    pub textures: &'a [Listed],
}

/// What somebody did to a field.
pub(super) enum Done {
    Set(SurfaceValue),
    Import,
}

/// Draws the widget of a value.
pub(super) fn show(ui: &mut Ui, row: &Row, label: egui::Id) -> Option<Done> {
    let set = |value| Some(Done::Set(value));
    match row.value {
        SurfaceValue::Color(color) => {
            let most = match row.field {
                SurfaceField::Emissive => f32::INFINITY,
                _ => 1.0,
            };
            let changed = channels(ui, *color, most, label)?;
            set(SurfaceValue::Color(changed))
        }
        SurfaceValue::Picture(picture) => pictures(ui, row, picture, label),
        SurfaceValue::Reflection(reflection) => {
            let model = model(ui, reflection.model(), label)?;
            set(SurfaceValue::Reflection(as_model(*reflection, model)))
        }
        SurfaceValue::Share(share) => {
            let mut share = *share;
            let slider = slider(&mut share, 0.0..=1.0).max_decimals(3);
            let changed = ui.add(slider).labelled_by(label).changed();
            changed.then_some(Done::Set(SurfaceValue::Share(share)))
        }
        SurfaceValue::Cutoff(cutoff) => {
            let mut on = cutoff.is_some();
            if ui.checkbox(&mut on, "").labelled_by(label).changed() {
                return set(SurfaceValue::Cutoff(on.then_some(CUTOFF)));
            }
            let mut alpha = (*cutoff)?;
            let slider = slider(&mut alpha, 0.0..=1.0).max_decimals(3);
            let changed = ui.add(slider).labelled_by(label).changed();
            changed.then_some(Done::Set(SurfaceValue::Cutoff(Some(alpha))))
        }
        SurfaceValue::Switch(on) => {
            let mut on = *on;
            let changed = ui.checkbox(&mut on, "").labelled_by(label).changed();
            changed.then_some(Done::Set(SurfaceValue::Switch(on)))
        }
    }
}

/// A slider that leaves what it shows as it is until somebody moves it: others would round it.
fn slider(number: &mut f32, range: RangeInclusive<f32>) -> Slider<'_> {
    Slider::new(number, range).clamping(SliderClamping::Edits)
}

/// The name of a value before its widget.
pub(super) fn name(ui: &mut Ui, name: &str, about: &str) -> egui::Id {
    let width = (ui.available_width() * 0.28).clamp(70.0, 110.0);
    align(ui, width, |ui| {
        ui.add(egui::Label::new(name).truncate())
            .on_hover_text(about)
    })
}

fn channels(ui: &mut Ui, color: Vec3, most: f32, label: egui::Id) -> Option<Vec3> {
    let mut picked = color.to_array();
    // The picker knows no light that is brighter than a screen; the numbers do.
    let picker = ui.color_edit_button_rgb(&mut picked).labelled_by(label);
    let mut typed = color.to_array();
    let mut changed = false;
    for (number, channel) in typed.iter_mut().zip(["r ", "g ", "b "]) {
        let speed = (f64::from(*number) * 0.01).clamp(0.004, 1e6);
        let field = DragValue::new(number)
            .speed(speed)
            .range(0.0..=most)
            .clamp_existing_to_range(false)
            .max_decimals(4)
            .prefix(channel);
        changed |= ui.add(field).labelled_by(label).changed();
    }
    let most = Vec3::splat(most);
    match (changed, picker.changed()) {
        (true, _) => Some(Vec3::from_array(typed)),
        (false, true) => Some(Vec3::from_array(picked).clamp(Vec3::ZERO, most)),
        _ => None,
    }
}

fn pictures(ui: &mut Ui, row: &Row, picture: &Picture, label: egui::Id) -> Option<Done> {
    let mut done = None;
    let none = say!("materials.no_texture");
    let now = match picture {
        Picture::None => none.to_owned(),
        Picture::Made(recipe) => short(recipe).to_owned(),
        Picture::Known(who) => who.words(),
    };
    let combo = ComboBox::from_id_salt("texture")
        .selected_text(&now)
        .width(130.0)
        .truncate();
    let response = combo.show_ui(ui, |ui| {
        let mut offer = |ui: &mut Ui, is_now: bool, title: &str, value: Picture| {
            if ui.selectable_label(is_now, title).clicked() && !is_now {
                done = Some(Done::Set(SurfaceValue::Picture(value)));
            }
        };
        offer(ui, *picture == Picture::None, none, Picture::None);
        let mut seen = Vec::new();
        for one in row.textures {
            let value = match &one.recipe {
                Some(recipe) => Picture::Made(recipe.clone()),
                None => Picture::Known(one.who.clone()),
            };
            // Colours and normals of one recipe are one entry.
            if seen.contains(&value) {
                continue;
            }
            let title = match &one.recipe {
                Some(recipe) => told_apart(recipe),
                None => one.who.words(),
            };
            offer(ui, *picture == value, &title, value.clone());
            seen.push(value);
        }
    });
    response
        .response
        .labelled_by(label)
        .on_hover_text(match picture {
            Picture::Made(recipe) => recipe.clone(),
            _ => now,
        });
    let file = ui.small_button(say!("materials.from_file"));
    let title = match row.field {
        SurfaceField::Normals => say!("materials.normals_from_file"),
        _ => say!("materials.texture_from_file"),
    };
    file.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, title));
    if file
        .on_hover_text(say!("materials.from_file_about"))
        .clicked()
    {
        done = Some(Done::Import);
    }
    done
}

/// The first call of a recipe, or the file of a picture.
pub(in crate::ui::panels) fn short(recipe: &str) -> &str {
    let inside = recipe.strip_prefix("picture(\"");
    if let Some((path, _)) = inside.and_then(|rest| rest.split_once('"')) {
        return path.rsplit('/').next().unwrap_or(path);
    }
    match recipe.find(").") {
        Some(end) => &recipe[..=end],
        None => recipe,
    }
}

/// The beginning of a recipe, by which textures of one call are told apart, or the file of a picture.
fn told_apart(recipe: &str) -> String {
    /// So many letters are shown.
    const MOST: usize = 60;
    let first = short(recipe);
    if !recipe.starts_with(first) || recipe.len() <= first.len() {
        return first.to_owned();
    }
    let mut title: String = recipe.chars().take(MOST).collect();
    if title.len() < recipe.len() {
        title.push('…');
    }
    title
}

/// The name of a model for people.
fn title(model: ReflectionModel) -> &'static str {
    text(match model {
        ReflectionModel::BlinnPhong => message!("materials.blinn_phong"),
        ReflectionModel::Phong => message!("materials.phong"),
        ReflectionModel::Beckmann => message!("materials.beckmann"),
        ReflectionModel::Ggx => message!("materials.ggx"),
        ReflectionModel::Ward => message!("materials.ward"),
    })
}

fn model(ui: &mut Ui, now: ReflectionModel, label: egui::Id) -> Option<ReflectionModel> {
    let mut wanted = now;
    let combo = ComboBox::from_id_salt("model").selected_text(title(now));
    let response = combo.show_ui(ui, |ui| {
        for model in ReflectionModel::ALL {
            ui.selectable_value(&mut wanted, model, title(model));
        }
    });
    response.response.labelled_by(label);
    (wanted != now).then_some(wanted)
}

/// Another model with a highlight about as wide.
fn as_model(from: Reflection, model: ReflectionModel) -> Reflection {
    // An exponent p and a slope m are alike where p = 2/m² − 2 (Walter et al. 2007, section 5.2), and
    // Phong's is a quarter of Blinn-Phong's.
    let slope = match from {
        Reflection::BlinnPhong { power } => (2.0 / (power + 2.0)).sqrt(),
        Reflection::Phong { power } => (2.0 / (4.0 * power + 2.0)).sqrt(),
        Reflection::Beckmann { roughness } | Reflection::Ggx { roughness } => roughness,
        Reflection::Ward { along, across } => (along * across).sqrt(),
    };
    let (least, most) = Reflection::ROUGHNESS_RANGE.into_inner();
    let roughness = slope.clamp(least, most);
    let (dullest, sharpest) = Reflection::POWER_RANGE.into_inner();
    let power = |share: f32| ((2.0 / (slope * slope) - 2.0) * share).clamp(dullest, sharpest);
    match model {
        ReflectionModel::BlinnPhong => Reflection::BlinnPhong { power: power(1.0) },
        ReflectionModel::Phong => Reflection::Phong { power: power(0.25) },
        ReflectionModel::Beckmann => Reflection::Beckmann { roughness },
        ReflectionModel::Ggx => Reflection::Ggx { roughness },
        ReflectionModel::Ward => Reflection::Ward {
            along: roughness,
            across: roughness,
        },
    }
}

/// The parameters of a reflection model, each in a row of its own.
pub(super) fn parameters(ui: &mut Ui, now: Reflection) -> Option<Reflection> {
    let power = message!("materials.power");
    let roughness = message!("materials.roughness");
    match now {
        Reflection::BlinnPhong { power: number } => {
            let power = parameter(ui, power, number, true)?;
            Some(Reflection::BlinnPhong { power })
        }
        Reflection::Phong { power: number } => {
            let power = parameter(ui, power, number, true)?;
            Some(Reflection::Phong { power })
        }
        Reflection::Beckmann { roughness: number } => {
            let roughness = parameter(ui, roughness, number, false)?;
            Some(Reflection::Beckmann { roughness })
        }
        Reflection::Ggx { roughness: number } => {
            let roughness = parameter(ui, roughness, number, false)?;
            Some(Reflection::Ggx { roughness })
        }
        Reflection::Ward { along, across } => {
            let new_along = parameter(ui, message!("materials.along"), along, false);
            let new_across = parameter(ui, message!("materials.across"), across, false);
            (new_along.is_some() || new_across.is_some()).then(|| Reflection::Ward {
                along: new_along.unwrap_or(along),
                across: new_across.unwrap_or(across),
            })
        }
    }
}

fn parameter(ui: &mut Ui, key: &'static str, number: f32, is_power: bool) -> Option<f32> {
    let (range, about) = match is_power {
        true => (Reflection::POWER_RANGE, say!("materials.power_about")),
        false => (
            Reflection::ROUGHNESS_RANGE,
            say!("materials.roughness_about"),
        ),
    };
    let mut number = number;
    ui.horizontal(|ui| {
        ui.add_space(10.0 + ui.spacing().item_spacing.x);
        let label = name(ui, text(key), about);
        let slider = slider(&mut number, range.clone())
            .logarithmic(true)
            .max_decimals(4);
        let changed = ui.add(slider).labelled_by(label).changed();
        // The way over the logarithm may end a bit outside.
        changed.then(|| number.clamp(*range.start(), *range.end()))
    })
    .inner
}

/// A value in few letters.
pub(super) fn spelled(value: &SurfaceValue) -> String {
    match value {
        SurfaceValue::Color(color) => format!("{}, {}, {}", color.x, color.y, color.z),
        SurfaceValue::Picture(Picture::None) => say!("materials.no_texture").to_owned(),
        SurfaceValue::Picture(Picture::Made(recipe)) => recipe.clone(),
        SurfaceValue::Picture(Picture::Known(who)) => who.words(),
        SurfaceValue::Reflection(reflection) => {
            let [first, second] = reflection.lobe();
            let name = words(reflection.model().name());
            match reflection {
                Reflection::Ward { .. } => format!("{name} {first}, {second}"),
                _ => format!("{name} {first}"),
            }
        }
        SurfaceValue::Share(share) => share.to_string(),
        SurfaceValue::Cutoff(Some(alpha)) => alpha.to_string(),
        SurfaceValue::Cutoff(None) => say!("materials.off").to_owned(),
        SurfaceValue::Switch(on) => match on {
            true => say!("materials.on").to_owned(),
            false => say!("materials.off").to_owned(),
        },
    }
}
