//! The browser of assets: materials, meshes and textures of the scene with their pictures, and files of
//! the project that can come into it.

mod cards;
mod create;
mod details;
pub mod thumbnail;

use egui::{
    Align, Layout, RichText, ScrollArea, Sense, Stroke, StrokeKind, TextEdit, TextWrapMode, Ui,
    vec2,
};
use lightbench::script::overlays::{
    AssetEdit, AssetId, Listed, Picture, SurfaceField, SurfaceValue, Who,
};

use super::entities::sentence;
use crate::ui::dialogs::Question;
use crate::ui::editor::Editor;
use crate::ui::layout::Panel;
use crate::ui::messages::{message, say, text};
use crate::ui::pictures::{Order, Through};
pub use cards::{Card, Cards, Kind, Shelf, Shelves};

/// Points of a picture.
const SIDE: f32 = 84.0;

/// Points of a card.
const CARD: egui::Vec2 = vec2(SIDE + 8.0, SIDE + 24.0);

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct AssetsPanel {
    shelf: Shelf,
    /// Words that titles and calls must hold.
    filter: String,
    /// What is chosen.
    chosen: Option<Card>,
    /// What is wrong with the last change.
    refused: Option<String>,
    /// Files of the project.
    pub shelves: Shelves,
    /// Calls that make a mesh, being typed.
    shape: String,
    /// Calls that make a texture, being typed.
    texture: String,
}

/// What somebody asked for.
pub(super) enum Wish {
    Choose(Card),
    Edit(Who),
    Assign(Who),
    Reshape(Who),
    ChooseUsers(AssetId),
    Delete(Listed),
    Create(AssetEdit),
    PictureFor(String, SurfaceField),
    AddModel(String),
    Ask(Question),
}

/// The call that reads a picture.
pub(super) fn picture_call(path: &str) -> String {
    format!("picture({path:?})")
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let workbench = &editor.workbench;
    let (files, wake) = (workbench.files().clone(), workbench.wake().clone());
    editor.assets.shelves.tend(&files, &wake);
    let Some(scene) = editor.workbench.scenes.scene() else {
        ui.label(RichText::new(say!("assets.no_scene")).weak());
        return;
    };
    let panel = &mut editor.assets;
    let cards = panel.shelves.cards(scene, panel.shelf, &panel.filter);
    // What is gone is not chosen any more.
    let chosen = editor.assets.chosen.take();
    editor.assets.chosen = chosen.and_then(|chosen| {
        let same = |card: &&Card| match (&card.kind, &chosen.kind) {
            (Kind::Asset(one), Kind::Asset(other)) => one.id == other.id && one.who == other.who,
            (one, other) => one == other,
        };
        cards.all.iter().find(same).cloned()
    });
    let mut wish = None;
    shelves(editor, ui);
    create::show(editor, ui, &mut wish);
    if let Some(why) = &editor.assets.refused {
        let color = ui.visuals().error_fg_color;
        ui.label(RichText::new(sentence(why)).color(color));
    }
    details::show(editor, ui, &mut wish);
    ui.separator();
    if cards.shown.is_empty() {
        ui.label(RichText::new(empty(editor.assets.shelf)).weak());
    }
    grid(editor, ui, &cards, &mut wish);
    if let Some(wish) = wish {
        grant(editor, wish);
    }
}

/// What stands where a shelf is empty.
fn empty(shelf: Shelf) -> &'static str {
    text(match shelf {
        Shelf::Models => message!("assets.no_models"),
        _ => message!("assets.none"),
    })
}

fn shelves(editor: &mut Editor, ui: &mut Ui) {
    let panel = &mut editor.assets;
    ui.horizontal_wrapped(|ui| {
        for (shelf, title) in [
            (Shelf::Materials, say!("assets.materials")),
            (Shelf::Meshes, say!("assets.meshes")),
            (Shelf::Textures, say!("assets.textures")),
            (Shelf::Models, say!("assets.models")),
        ] {
            if ui.selectable_label(panel.shelf == shelf, title).clicked() {
                panel.shelf = shelf;
                panel.chosen = None;
            }
        }
        let label = ui.label(say!("assets.search"));
        let field = TextEdit::singleline(&mut panel.filter).desired_width(110.0);
        ui.add(field).labelled_by(label.id);
    });
}

fn grid(editor: &mut Editor, ui: &mut Ui, cards: &Cards, wish: &mut Option<Wish>) {
    let columns = (ui.available_width() / (CARD.x + 6.0)).floor().max(1.0) as usize;
    let rows = cards.shown.len().div_ceil(columns);
    let area = ScrollArea::vertical().id_salt("cards").auto_shrink(false);
    area.show_rows(ui, CARD.y, rows, |ui, range| {
        for row in range {
            ui.horizontal(|ui| {
                let shown = cards.shown.iter().enumerate();
                for (place, card) in shown.skip(row * columns).take(columns) {
                    ui.push_id(place, |ui| one(editor, ui, &cards.all[*card], wish));
                }
            });
        }
    });
}

fn one(editor: &mut Editor, ui: &mut Ui, card: &Card, wish: &mut Option<Wish>) {
    let (rect, response) = ui.allocate_exact_size(CARD, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &card.title));
    let place = egui::Rect::from_min_size(rect.min + vec2(4.0, 2.0), vec2(SIDE, SIDE));
    let scene = editor.workbench.scenes.scene();
    if let Some(subject) = scene.and_then(|scene| card.subject(scene)) {
        let order = Order {
            subject,
            through: Through::plain(),
            side: 128,
        };
        thumbnail::paint(&mut editor.pictures, ui, order, place);
    }
    let is_chosen = editor.assets.chosen.as_ref() == Some(card);
    if is_chosen || response.hovered() {
        let visuals = ui.visuals();
        let color = match is_chosen {
            true => visuals.selection.bg_fill,
            false => visuals.hyperlink_color,
        };
        let line = Stroke::new(2.0, color);
        ui.painter()
            .rect_stroke(place, 3.0, line, StrokeKind::Inside);
    }
    let below = egui::Rect::from_min_max(
        egui::pos2(rect.left(), place.bottom() + 2.0),
        rect.right_bottom(),
    );
    let builder = egui::UiBuilder::new().max_rect(below);
    let mut text = ui.new_child(
        builder
            .layout(Layout::top_down(Align::Center))
            .id_salt("title"),
    );
    text.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
    // The card has the name already, for those who hear it.
    text.add(egui::Label::new(RichText::new(&card.title).small()).selectable(false));
    if response.double_clicked() {
        match &card.kind {
            Kind::Asset(listed) if matches!(listed.id, AssetId::Material(_)) => {
                *wish = Some(Wish::Edit(listed.who.clone()));
            }
            Kind::Model(path) => *wish = Some(Wish::AddModel(path.clone())),
            _ => {}
        }
    } else if response.clicked() {
        *wish = Some(Wish::Choose(card.clone()));
    }
}

/// Does what somebody asked for. What can't be done is said in the panel.
fn grant(editor: &mut Editor, wish: Wish) {
    let workbench = &mut editor.workbench;
    let result = match wish {
        Wish::Choose(card) => {
            editor.assets.chosen = Some(card);
            Ok(())
        }
        Wish::Edit(who) => {
            editor.materials.choose(who);
            editor.reveal(Panel::Materials);
            Ok(())
        }
        Wish::Assign(who) => workbench.dress_chosen(Some(who)),
        Wish::Reshape(who) => workbench.reshape_chosen(Some(who)),
        Wish::ChooseUsers(id) => {
            if let Some(scene) = workbench.scenes.scene() {
                let users = scene.users(id);
                workbench.selection.set(scene, users);
            }
            Ok(())
        }
        Wish::Delete(listed) => {
            let of = listed.who;
            workbench.change_assets(match listed.id {
                AssetId::Material(_) => AssetEdit::DeleteMaterial { of: vec![of] },
                AssetId::Mesh(_) => AssetEdit::DeleteMesh { of },
                AssetId::Texture(_) => AssetEdit::DeleteTexture { of },
            })
        }
        Wish::Create(edit) => workbench.change_assets(edit),
        Wish::PictureFor(recipe, field) => {
            let value = SurfaceValue::Picture(Picture::Made(recipe));
            let of = editor.materials.chosen().iter();
            let of = of.map(|who| (who.clone(), Some(value.clone()))).collect();
            workbench.change_assets(AssetEdit::Paint { field, of })
        }
        Wish::AddModel(path) => workbench.add_model(&path),
        Wish::Ask(question) => {
            editor.ask_for(question);
            return;
        }
    };
    editor.assets.refused = result.err();
}
