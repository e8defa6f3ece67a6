//! What a scene has beside its things: the camera of the view, the light from everywhere, and how light
//! becomes a picture.

use egui::{RichText, ScrollArea, Ui};
use lightbench::script::overlays::NewKind;
use lightbench::world::{Camera, ComponentKind, Entity, Light, LightKind, Name, World};

use super::entities::some;
use super::parameters;
use crate::ui::actions::Action;
use crate::ui::editor::Editor;
use crate::ui::layout::Panel;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::fields::Field;

/// Parameters of pipelines that say how light becomes a picture.
const PICTURE: [&str; 4] = [
    "exposure",
    "tone_curve",
    "antialiasing",
    "reflection_models",
];

/// Fields of a camera, and of a light from everywhere. The others mean nothing here.
const CAMERA: [&str; 3] = ["fov_y", "near", "far"];
const AMBIENT: [&str; 3] = ["color", "intensity", "visible"];

/// What somebody asked for.
enum Wish {
    Field(Entity, some::Changed),
    Create(NewKind),
    Show(Entity),
    Picture(String, Option<lightbench::script::SettingValue>),
    Panel(Panel),
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut wish = None;
    let scroll = ScrollArea::vertical()
        .id_salt("environment")
        .auto_shrink(false);
    scroll.show(ui, |ui| {
        camera(editor, ui, &mut wish);
        ambient(editor, ui, &mut wish);
        picture(editor, ui, &mut wish);
        counts(editor, ui, &mut wish);
    });
    match wish {
        None => {}
        Some(Wish::Field(entity, changed)) => some::grant(editor, ui, entity, changed),
        Some(Wish::Create(kind)) => {
            let ctx = ui.ctx().clone();
            editor.perform(Action::Create(kind), &ctx);
        }
        Some(Wish::Show(entity)) => {
            let workbench = &mut editor.workbench;
            if let Some(scene) = workbench.scenes.scene() {
                workbench.selection.set(scene, [entity]);
            }
            editor.reveal(Panel::Entities);
        }
        Some(Wish::Picture(name, value)) => editor.workbench.set_pipeline_parameter(&name, value),
        Some(Wish::Panel(panel)) => editor.reveal(panel),
    }
}

fn heading(ui: &mut Ui, title: &str, about: &str) {
    ui.add_space(4.0);
    let color = Palette::of(ui).accent;
    ui.label(RichText::new(title).color(color))
        .on_hover_text(about);
}

fn named(world: &World, entity: Entity) -> String {
    world
        .get::<Name>(entity)
        .map_or_else(String::new, |name| name.text)
}

fn camera(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    heading(
        ui,
        say!("environment.camera"),
        say!("environment.camera_about"),
    );
    let scene = editor.workbench.scenes.scene();
    let Some((scene, camera)) = scene.and_then(|scene| Some((scene, scene.camera()?))) else {
        ui.label(RichText::new(say!("environment.no_camera")).weak());
        return;
    };
    let count = scene.world.columns::<Camera>().len();
    title(ui, &named(&scene.world, camera), camera, wish);
    if count > 1 {
        let text = say!("environment.other_cameras", count = count - 1);
        ui.label(RichText::new(text).small().weak());
    }
    rows(editor, ui, camera, ComponentKind::Camera, &CAMERA, wish);
    if scene.keeps_by_name(camera).is_err() {
        ui.label(RichText::new(say!("environment.made_for_it")).weak());
        if ui.small_button(say!("environment.make_camera")).clicked() {
            *wish = Some(Wish::Create(NewKind::Camera));
        }
    }
}

/// The name of an entity, and the way to all that it has.
fn title(ui: &mut Ui, name: &str, entity: Entity, wish: &mut Option<Wish>) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(name).strong());
        let button = ui.small_button(say!("environment.in_entities"));
        let label = say!("environment.in_entities_of", name = name);
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
        if button.clicked() {
            *wish = Some(Wish::Show(entity));
        }
    });
}

fn rows(
    editor: &Editor,
    ui: &mut Ui,
    entity: Entity,
    kind: ComponentKind,
    fields: &[&str],
    wish: &mut Option<Wish>,
) {
    if let Some(changed) = some::rows(editor, ui, entity, kind, fields) {
        *wish = Some(Wish::Field(entity, changed));
    }
}

fn ambient(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    heading(
        ui,
        say!("environment.ambient"),
        say!("environment.ambient_about"),
    );
    let Some(scene) = editor.workbench.scenes.scene() else {
        return;
    };
    let lights = scene.world.columns::<Light>();
    let all = lights.kind().iter().zip(lights.entities());
    let ambient = all.filter(|(kind, _)| **kind == LightKind::Ambient);
    let ambient: Vec<Entity> = ambient.map(|(_, entity)| *entity).collect();
    for entity in &ambient {
        title(ui, &named(&scene.world, *entity), *entity, wish);
        rows(editor, ui, *entity, ComponentKind::Light, &AMBIENT, wish);
    }
    if ambient.is_empty() {
        ui.label(RichText::new(say!("environment.no_ambient")).weak());
    }
    if ui.small_button(say!("environment.add_ambient")).clicked() {
        *wish = Some(Wish::Create(NewKind::AmbientLight));
    }
}

fn picture(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    heading(
        ui,
        say!("environment.picture"),
        say!("environment.picture_about"),
    );
    let pipelines = &editor.workbench.pipelines;
    let slot = pipelines.slot(pipelines.selected());
    let Some((slot, desc)) = slot.and_then(|slot| Some((slot, slot.desc()?))) else {
        ui.label(RichText::new(say!("environment.not_built")).weak());
        return;
    };
    let mut fields = Field::of_pipeline(&desc.parameters, &slot.settings);
    fields.retain(|field| PICTURE.contains(&field.name.as_str()));
    if fields.is_empty() {
        ui.label(RichText::new(say!("environment.no_parameters")).weak());
    }
    if let Some((name, value)) = parameters::edit(ui, &fields) {
        *wish = Some(Wish::Picture(name, value));
    }
}

/// How much the scene has of the rest, with the way to it.
fn counts(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    heading(ui, say!("environment.rest"), say!("environment.rest_about"));
    let Some(scene) = editor.workbench.scenes.scene() else {
        return;
    };
    let counts = scene.assets.counts();
    let text = say!(
        "environment.counts",
        materials = counts.materials,
        meshes = counts.meshes,
        textures = counts.textures,
        parameters = scene.parameters.len()
    );
    ui.label(text);
    ui.horizontal_wrapped(|ui| {
        for panel in [Panel::Materials, Panel::Assets, Panel::Scene] {
            let button = ui.small_button(panel.title());
            let label = say!("environment.show_panel", panel = panel.title());
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
            if button.clicked() {
                *wish = Some(Wish::Panel(panel));
            }
        }
    });
}
