//! Making meshes and textures, and bringing files.

use egui::{TextEdit, Ui};
use lightbench::script::overlays::AssetEdit;

use super::{Shelf, Wish};
use crate::ui::dialogs::Question;
use crate::ui::editor::Editor;
use crate::ui::messages::say;

/// Shapes to begin from, as scripts write them; metres.
const SHAPES: [&str; 9] = [
    "box(1)",
    "sphere(0.5)",
    "icosphere(0.5)",
    "cylinder(0.5, 1)",
    "cone(0.5, 1)",
    "torus(0.375, 0.125)",
    "plane(2, 2)",
    "column(0.25, 3)",
    "cloth(2, 2)",
];

/// Painted textures to begin from, as scripts write them.
const TEXTURES: [&str; 7] = [
    "stone_texture()",
    "marble_texture()",
    "plaster_texture()",
    "brick_texture()",
    "tiles_texture()",
    "weave_texture()",
    "checker_texture(8)",
];

/// Draws what makes something for the shelf that is shown.
pub(super) fn show(editor: &mut Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let panel = &mut editor.assets;
    ui.horizontal_wrapped(|ui| match panel.shelf {
        Shelf::Materials => {
            if ui.small_button(say!("assets.new_material")).clicked() {
                *wish = Some(Wish::Create(AssetEdit::NewMaterial {
                    name: String::new(),
                    like: None,
                }));
            }
        }
        Shelf::Meshes => {
            calls(ui, say!("assets.shape"), &SHAPES, &mut panel.shape);
            if ui.small_button(say!("assets.create_mesh")).clicked() {
                let recipe = panel.shape.trim().to_owned();
                *wish = Some(Wish::Create(AssetEdit::NewMesh { recipe }));
            }
        }
        Shelf::Textures => {
            calls(ui, say!("assets.painted"), &TEXTURES, &mut panel.texture);
            if ui.small_button(say!("assets.create_texture")).clicked() {
                let recipe = panel.texture.trim().to_owned();
                *wish = Some(Wish::Create(AssetEdit::NewTexture { recipe }));
            }
            if ui.small_button(say!("assets.picture_from_file")).clicked() {
                *wish = Some(Wish::Ask(Question::Texture));
            }
        }
        Shelf::Models => {
            if ui.small_button(say!("assets.model_from_file")).clicked() {
                *wish = Some(Wish::Ask(Question::Model));
            }
        }
    });
}

/// A field for calls, with a menu of some.
fn calls(ui: &mut Ui, title: &str, known: &[&str], typed: &mut String) {
    if typed.is_empty() {
        typed.push_str(known[0]);
    }
    let menu = ui.menu_button(title, |ui| {
        for call in known {
            if ui.button(*call).clicked() {
                *typed = (*call).to_owned();
            }
        }
    });
    let field = TextEdit::singleline(typed).desired_width(150.0);
    let field = ui.add(field.font(egui::TextStyle::Monospace));
    let field = field.labelled_by(menu.response.id);
    field.on_hover_text(say!("assets.calls_about"));
}
