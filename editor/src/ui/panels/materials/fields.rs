//! What a material says of a surface, as rows of widgets.

use egui::{Align, Layout, RichText, Sense, Ui, vec2};
use lightbench::assets::{MaterialId, Reflection};
use lightbench::script::Scene;
use lightbench::script::overlays::{Listed, SurfaceField, SurfaceValue, Who};
use lightbench::world::Value;
use lightbench::world::glam::Vec3;

use super::Wish;
use super::values::{self, Row};
use crate::ui::editor::Editor;
use crate::ui::messages::{message, say, text};
use crate::ui::panels::entities::parts_carried_over;
use crate::ui::theme::Palette;

/// The messages of a field: its name, and what it means, with its range and its unit.
fn words(field: SurfaceField) -> (&'static str, &'static str) {
    let keys = match field {
        SurfaceField::Color => (
            message!("materials.color"),
            message!("materials.color_about"),
        ),
        SurfaceField::Texture => (
            message!("materials.texture"),
            message!("materials.texture_about"),
        ),
        SurfaceField::Normals => (
            message!("materials.normals"),
            message!("materials.normals_about"),
        ),
        SurfaceField::Specular => (
            message!("materials.specular"),
            message!("materials.specular_about"),
        ),
        SurfaceField::Reflection => (
            message!("materials.model"),
            message!("materials.model_about"),
        ),
        SurfaceField::Emissive => (
            message!("materials.emissive"),
            message!("materials.emissive_about"),
        ),
        SurfaceField::Opacity => (
            message!("materials.opacity"),
            message!("materials.opacity_about"),
        ),
        SurfaceField::Cutoff => (
            message!("materials.cutoff"),
            message!("materials.cutoff_about"),
        ),
        SurfaceField::TwoSided => (
            message!("materials.two_sided"),
            message!("materials.two_sided_about"),
        ),
    };
    (text(keys.0), text(keys.1))
}

/// Draws all fields of the materials that are chosen, with the values of the last.
pub(super) fn show(
    editor: &Editor,
    ui: &mut Ui,
    chosen: &[MaterialId],
    textures: &[Listed],
    wish: &mut Option<Wish>,
) {
    let workbench = &editor.workbench;
    let (Some(scene), Some(&last)) = (workbench.scenes.scene(), chosen.last()) else {
        return;
    };
    for field in SurfaceField::ALL {
        let Some(value) = scene.surface(last, field) else {
            continue;
        };
        let overlays = workbench.overlays_now();
        let script = overlays.and_then(|overlays| overlays.script_surface(scene, last, field));
        let others = chosen.iter().filter_map(|id| scene.surface(*id, field));
        let differs = others.into_iter().any(|other| other != value);
        let row = Row {
            field,
            value: &value,
            textures,
        };
        ui.push_id((last, field), |ui| {
            ui.horizontal(|ui| {
                dot(ui, script.as_ref());
                let label = label(ui, field);
                match values::show(ui, &row, label) {
                    None => {}
                    Some(values::Done::Set(value)) => *wish = Some(Wish::Set(field, value)),
                    Some(values::Done::Import) => *wish = Some(Wish::Import(field)),
                }
                if differs {
                    let note = RichText::new(say!("materials.differs")).small().italics();
                    ui.label(note)
                        .on_hover_text(say!("materials.differs_about"));
                }
                if let Some(script) = &script {
                    let button = ui.small_button(say!("materials.reset"));
                    let name = say!("materials.reset_of", field = words(field).0);
                    button
                        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
                    let about = say!("materials.back_to", value = values::spelled(script));
                    if button.on_hover_text(about).clicked() {
                        *wish = Some(Wish::Reset(field));
                    }
                }
            });
            if let SurfaceValue::Reflection(reflection) = &value
                && let Some(to) = values::parameters(ui, *reflection)
            {
                *wish = Some(Wish::Set(field, SurfaceValue::Reflection(to)));
            }
        });
    }
}

/// The mark of a field that was changed by hand.
fn dot(ui: &mut Ui, script: Option<&SurfaceValue>) {
    let (rect, response) = ui.allocate_exact_size(vec2(10.0, 22.0), Sense::hover());
    if let Some(script) = script {
        let color = Palette::of(ui).accent;
        ui.painter().circle_filled(rect.center(), 3.5, color);
        let about = say!("materials.changed", value = values::spelled(script));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &about));
        response.on_hover_text(about);
    }
}

fn label(ui: &mut Ui, field: SurfaceField) -> egui::Id {
    let (name, about) = words(field);
    values::name(ui, name, about)
}

/// What each of the chosen materials gets where the last one's value was changed: of a colour the
/// channels that were changed, of a reflection model its parameters where it is the same.
pub(super) fn carried_over(
    scene: &Scene,
    chosen: &[Who],
    field: SurfaceField,
    to: &SurfaceValue,
) -> Vec<(Who, Option<SurfaceValue>)> {
    let value_of = |who: &Who| scene.surface(scene.find_material(who)?, field);
    let from = chosen.last().and_then(value_of);
    let one = |who: &Who| {
        let own = value_of(who);
        let value = match (&from, to, &own) {
            (
                Some(SurfaceValue::Color(from)),
                SurfaceValue::Color(to),
                Some(SurfaceValue::Color(own)),
            ) => SurfaceValue::Color(mixed(*from, *to, *own)),
            (
                Some(SurfaceValue::Reflection(from)),
                SurfaceValue::Reflection(to),
                Some(SurfaceValue::Reflection(own)),
            ) if from.model() == to.model() => {
                SurfaceValue::Reflection(part_carried_over(*from, *to, *own)?)
            }
            _ => to.clone(),
        };
        Some((who.clone(), Some(value)))
    };
    chosen.iter().filter_map(one).collect()
}

fn mixed(from: Vec3, to: Vec3, own: Vec3) -> Vec3 {
    match parts_carried_over(&Value::Vec3(from), &Value::Vec3(to), &Value::Vec3(own)) {
        Value::Vec3(mixed) => mixed,
        _ => to,
    }
}

/// A parameter that was changed, for a material of the same model; others keep theirs.
fn part_carried_over(from: Reflection, to: Reflection, own: Reflection) -> Option<Reflection> {
    match (from, to, own) {
        (
            Reflection::Ward { along, across },
            Reflection::Ward {
                along: new_along,
                across: new_across,
            },
            Reflection::Ward {
                along: own_along,
                across: own_across,
            },
        ) => {
            let pick = |from: f32, to: f32, own: f32| if from == to { own } else { to };
            Some(Reflection::Ward {
                along: pick(along, new_along, own_along),
                across: pick(across, new_across, own_across),
            })
        }
        _ => (own.model() == to.model()).then_some(to),
    }
}

/// The same names for rows of parameters.
pub(super) fn align(
    ui: &mut Ui,
    width: f32,
    add: impl FnOnce(&mut Ui) -> egui::Response,
) -> egui::Id {
    let size = vec2(width, ui.spacing().interact_size.y);
    let label = ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(width);
        add(ui)
    });
    label.inner.id
}
