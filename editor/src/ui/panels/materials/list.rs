//! The list of materials.

use egui::{RichText, ScrollArea, TextEdit, Ui, vec2};
use lightbench::script::overlays::{AssetId, Listed};

use super::Wish;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::assets::thumbnail;
use crate::ui::pictures::{Order, Subject, Through};

/// Points of a small picture.
const SIDE: f32 = 28.0;

/// Draws the list.
pub(super) fn show(
    editor: &mut Editor,
    ui: &mut Ui,
    materials: &[Listed],
    wish: &mut Option<Wish>,
) {
    ui.horizontal(|ui| {
        let label = ui.label(say!("materials.filter"));
        let field = TextEdit::singleline(&mut editor.materials.filter).desired_width(f32::INFINITY);
        ui.add(field).labelled_by(label.id);
    });
    let typed = editor.materials.filter.to_lowercase();
    let typed = typed.trim();
    let fits = |one: &&Listed| typed.is_empty() || one.who.name.to_lowercase().contains(typed);
    let shown: Vec<&Listed> = materials.iter().filter(fits).collect();
    if shown.is_empty() {
        ui.label(RichText::new(say!("materials.none")).weak());
    }
    let scroll = ScrollArea::vertical().id_salt("list").max_height(150.0);
    scroll
        .auto_shrink([false, true])
        .show_rows(ui, SIDE + 2.0, shown.len(), |ui, rows| {
            for one in &shown[rows] {
                ui.push_id(one.id, |ui| row(editor, ui, one, wish));
            }
        });
}

fn row(editor: &mut Editor, ui: &mut Ui, one: &Listed, wish: &mut Option<Wish>) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(SIDE, SIDE), egui::Sense::hover());
        let scene = editor.workbench.scenes.scene();
        let subject = match (scene, one.id) {
            (Some(scene), AssetId::Material(id)) => Subject::material(&scene.assets, id),
            _ => None,
        };
        if let Some(subject) = subject.filter(|_| ui.is_rect_visible(rect)) {
            let order = Order {
                subject,
                through: Through::plain(),
                side: 96,
            };
            thumbnail::paint(&mut editor.pictures, ui, order, rect);
        }
        let is_chosen = editor.materials.chosen.contains(&one.who);
        let label = ui.selectable_label(is_chosen, one.who.words());
        if label.clicked() {
            let together = ui.input(|input| input.modifiers.command);
            *wish = Some(Wish::Choose(one.who.clone(), together));
        }
    });
}
