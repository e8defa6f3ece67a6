//! What is known of the card that is chosen, and what can be done with it.

use egui::{Button, Response, RichText, Ui};
use lightbench::script::Scene;
use lightbench::script::overlays::{AssetEdit, AssetId, Listed, SurfaceField};

use super::{Card, Kind, Wish, picture_call};
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::widgets::count;

/// Draws it.
pub(super) fn show(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let Some(card) = &editor.assets.chosen else {
        ui.label(RichText::new(say!("assets.choose_one")).weak());
        return;
    };
    let Some(scene) = editor.workbench.scenes.scene() else {
        return;
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(&card.title).strong());
        ui.label(RichText::new(about(scene, card)).weak().small());
    });
    match &card.kind {
        Kind::Asset(listed) => asset(editor, ui, scene, listed, wish),
        Kind::Picture(path) => {
            ui.horizontal_wrapped(|ui| {
                if ui.small_button(say!("assets.add_to_scene")).clicked() {
                    let recipe = picture_call(path);
                    *wish = Some(Wish::Create(AssetEdit::NewTexture { recipe }));
                }
                textures_for(editor, ui, &picture_call(path), wish);
            });
        }
        Kind::Model(path) => {
            if ui.small_button(say!("assets.add_to_scene")).clicked() {
                *wish = Some(Wish::AddModel(path.clone()));
            }
        }
    }
}

/// What a thing is made of.
fn about(scene: &Scene, card: &Card) -> String {
    let listed = match &card.kind {
        Kind::Asset(listed) => listed,
        Kind::Picture(path) | Kind::Model(path) => return path.clone(),
    };
    let made = listed.recipe.clone().unwrap_or_default();
    match listed.id {
        AssetId::Mesh(id) => {
            let triangles = scene
                .assets
                .mesh(id)
                .map_or(0, |mesh| mesh.triangle_count());
            let triangles = count(triangles as u64);
            say!("assets.mesh_about", triangles = triangles, made = made)
        }
        AssetId::Texture(id) => {
            let size = scene.assets.texture(id).map(|one| (one.width, one.height));
            let (width, height) = size.unwrap_or_default();
            say!(
                "assets.texture_about",
                width = width,
                height = height,
                made = made
            )
        }
        AssetId::Material(id) => {
            let model = scene.assets.material(id);
            model.map_or_else(String::new, |one| one.reflection.model().to_string())
        }
    }
}

fn asset(editor: &Editor, ui: &mut Ui, scene: &Scene, listed: &Listed, wish: &mut Option<Wish>) {
    let users = scene.users(listed.id);
    let workbench = &editor.workbench;
    ui.horizontal_wrapped(|ui| {
        let text = match users.len() {
            0 => say!("assets.used_by_nobody").to_owned(),
            count => say!("assets.used_by", count = count),
        };
        let label = ui.label(text);
        if !users.is_empty() {
            label.on_hover_text(workbench.names_for_people(&users));
            if ui.small_button(say!("assets.choose_users")).clicked() {
                *wish = Some(Wish::ChooseUsers(listed.id));
            }
        }
        if let AssetId::Texture(id) = listed.id {
            let materials = scene.textured(id);
            let names: Vec<String> = materials
                .iter()
                .map(|id| scene.who_is_material(*id).words())
                .collect();
            if !names.is_empty() {
                ui.label(say!("assets.in_materials", names = names.join(", ")));
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        let has_entities = !workbench.selection.is_empty();
        match listed.id {
            AssetId::Material(_) => {
                if ui.small_button(say!("assets.edit_material")).clicked() {
                    *wish = Some(Wish::Edit(listed.who.clone()));
                }
                if enabled(ui, has_entities, say!("assets.give_to_chosen")).clicked() {
                    *wish = Some(Wish::Assign(listed.who.clone()));
                }
            }
            AssetId::Mesh(_) => {
                if enabled(ui, has_entities, say!("assets.give_to_chosen")).clicked() {
                    *wish = Some(Wish::Reshape(listed.who.clone()));
                }
            }
            AssetId::Texture(_) => {
                if let Some(recipe) = &listed.recipe {
                    textures_for(editor, ui, recipe, wish);
                }
            }
        }
        let is_material = matches!(listed.id, AssetId::Material(_));
        let can_go = is_material || listed.is_kept;
        let button = enabled(ui, can_go, say!("assets.delete"));
        let button = button.on_disabled_hover_text(say!("assets.not_by_hand"));
        if button.clicked() {
            *wish = Some(Wish::Delete(listed.clone()));
        }
    });
}

/// Gives a texture to the materials that are edited.
fn textures_for(editor: &Editor, ui: &mut Ui, recipe: &str, wish: &mut Option<Wish>) {
    let materials = editor.materials.chosen();
    let name = match materials {
        [one] => one.words(),
        all => say!("assets.materials_chosen", count = all.len()),
    };
    for (title, field) in [
        (say!("assets.as_texture"), SurfaceField::Texture),
        (say!("assets.as_normals"), SurfaceField::Normals),
    ] {
        let button = enabled(ui, !materials.is_empty(), title);
        let button = button.on_hover_text(say!("assets.goes_to", name = name));
        let button = button.on_disabled_hover_text(say!("assets.choose_a_material"));
        if button.clicked() {
            *wish = Some(Wish::PictureFor(recipe.to_owned(), field));
        }
    }
}

/// A small button that may be out of use. Rows of such wrap.
fn enabled(ui: &mut Ui, on: bool, title: &str) -> Response {
    ui.add_enabled(on, Button::new(title).small())
}
