//! The materials of the scene: a list, a ball of the one that is edited, and all that it says of a
//! surface, to be changed by hand.

mod fields;
mod list;
mod preview;
mod values;

use egui::{Button, RichText, ScrollArea, TextEdit, Ui};
use lightbench::assets::MaterialId;
use lightbench::script::Scene;
use lightbench::script::overlays::{AssetEdit, AssetId, Picture, SurfaceField, SurfaceValue, Who};

use super::entities::sentence;
use crate::ui::dialogs::Question;
use crate::ui::editor::Editor;
use crate::ui::messages::say;

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct MaterialsPanel {
    /// Words that names must hold.
    filter: String,
    /// The materials that are edited; the last one's values are shown.
    chosen: Vec<Who>,
    /// What is wrong with the last change.
    refused: Option<String>,
    /// A name that is being typed.
    typed: Option<String>,
    /// The pipeline of the ball; none for the one on screen.
    pipeline: Option<String>,
    /// The field for which a file is asked.
    importing: Option<SurfaceField>,
}

/// What somebody asked for.
pub(super) enum Wish {
    New,
    Duplicate,
    Delete,
    Assign,
    Rename(String),
    Choose(Who, bool),
    Users,
    Set(SurfaceField, SurfaceValue),
    Reset(SurfaceField),
    Import(SurfaceField),
    Through(Option<String>),
}

impl MaterialsPanel {
    /// Edits a material from now on.
    pub fn choose(&mut self, who: Who) {
        self.chosen = vec![who];
        self.typed = None;
        self.refused = None;
    }
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let Some(scene) = editor.workbench.scenes.scene() else {
        ui.label(RichText::new(say!("materials.no_scene")).weak());
        return;
    };
    let listing = scene.listed();
    let materials = listing.materials();
    let panel = &mut editor.materials;
    panel
        .chosen
        .retain(|who| materials.iter().any(|one| one.who == *who));
    let chosen: Vec<MaterialId> = panel
        .chosen
        .iter()
        .filter_map(|who| scene.find_material(who))
        .collect();
    let mut wish = None;
    let scroll = ScrollArea::vertical()
        .id_salt("materials")
        .auto_shrink(false);
    scroll.show(ui, |ui| {
        buttons(editor, ui, &mut wish);
        ui.horizontal_top(|ui| {
            let width = (ui.available_width() - preview::SIDE - 16.0).max(90.0);
            ui.vertical(|ui| {
                ui.set_width(width);
                list::show(editor, ui, materials, &mut wish);
            });
            ui.vertical(|ui| preview::show(editor, ui, chosen.last().copied(), &mut wish));
        });
        if let Some(why) = &editor.materials.refused {
            let color = ui.visuals().error_fg_color;
            ui.label(RichText::new(sentence(why)).color(color));
        }
        ui.separator();
        if chosen.is_empty() {
            ui.label(RichText::new(say!("materials.choose_one")).weak());
            return;
        }
        name(editor, ui, &mut wish);
        fields::show(editor, ui, &chosen, listing.textures(), &mut wish);
    });
    if let Some(wish) = wish {
        grant(editor, wish);
    }
}

fn buttons(editor: &Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let has_material = !editor.materials.chosen.is_empty();
    let one = editor.materials.chosen.len() == 1;
    let entities = editor.workbench.selection.len();
    let button = |ui: &mut Ui, enabled: bool, title: &str, about: &str| {
        let button = ui.add_enabled(enabled, Button::new(title).small());
        button.on_hover_text(about).clicked()
    };
    ui.horizontal_wrapped(|ui| {
        let about = say!("materials.new_about");
        if button(ui, true, say!("materials.new"), about) {
            *wish = Some(Wish::New);
        }
        let about = say!("materials.duplicate_about");
        if button(ui, one, say!("materials.duplicate"), about) {
            *wish = Some(Wish::Duplicate);
        }
        let about = say!("materials.delete_about");
        if button(ui, has_material, say!("materials.delete"), about) {
            *wish = Some(Wish::Delete);
        }
        let about = say!("materials.assign_about", count = entities);
        if button(ui, one && entities > 0, say!("materials.assign"), &about) {
            *wish = Some(Wish::Assign);
        }
        let about = say!("materials.users_about");
        if button(ui, has_material, say!("materials.users"), about) {
            *wish = Some(Wish::Users);
        }
    });
}

/// The name of the one material that is chosen.
fn name(editor: &mut Editor, ui: &mut Ui, wish: &mut Option<Wish>) {
    let panel = &mut editor.materials;
    let [who] = panel.chosen.as_slice() else {
        let text = say!("materials.several", count = panel.chosen.len());
        ui.label(RichText::new(text).weak());
        return;
    };
    ui.horizontal(|ui| {
        let label = ui.label(say!("materials.name"));
        let mut typed = panel.typed.clone().unwrap_or_else(|| who.name.clone());
        let field = TextEdit::singleline(&mut typed).desired_width(160.0);
        let field = ui.add(field).labelled_by(label.id);
        if field.has_focus() {
            // Half a name is none: it counts when the field is left.
            panel.typed = Some(typed);
        } else if let Some(typed) = panel.typed.take()
            && typed.trim() != who.name
        {
            *wish = Some(Wish::Rename(typed.trim().to_owned()));
        }
    });
}

/// Does what somebody asked for. What can't be done is said in the panel.
fn grant(editor: &mut Editor, wish: Wish) {
    let workbench = &mut editor.workbench;
    let panel = &mut editor.materials;
    let last = panel.chosen.last().cloned();
    let result = match wish {
        Wish::New | Wish::Duplicate => {
            let like = match wish {
                Wish::Duplicate => last,
                _ => None,
            };
            let made = workbench.change_assets(AssetEdit::NewMaterial {
                name: String::new(),
                like,
            });
            if made.is_ok()
                && let Some(scene) = workbench.scenes.scene()
                && let Some(newest) = newest(scene)
            {
                panel.choose(newest);
            }
            made
        }
        Wish::Delete => {
            let of = panel.chosen.clone();
            workbench.change_assets(AssetEdit::DeleteMaterial { of })
        }
        Wish::Assign => workbench.dress_chosen(last),
        Wish::Rename(name) => {
            let renamed = last.map(|of| {
                let name = name.clone();
                workbench.change_assets(AssetEdit::RenameMaterial { of, name })
            });
            let renamed = renamed.unwrap_or(Ok(()));
            if renamed.is_ok()
                && let Some(scene) = workbench.scenes.scene()
            {
                let listing = scene.listed();
                let mut all = listing.materials().iter().rev();
                let named = all.find(|one| one.who.name == name);
                panel.chosen = named.into_iter().map(|one| one.who.clone()).collect();
            }
            renamed
        }
        Wish::Choose(who, together) => {
            panel.typed = None;
            match (together, panel.chosen.iter().position(|one| *one == who)) {
                (false, _) => panel.chosen = vec![who],
                (true, Some(place)) => _ = panel.chosen.remove(place),
                (true, None) => panel.chosen.push(who),
            }
            Ok(())
        }
        Wish::Users => {
            if let Some(scene) = workbench.scenes.scene() {
                let of = panel.chosen.iter();
                let ids = of.filter_map(|who| scene.find_material(who));
                let users: Vec<_> = ids
                    .flat_map(|id| scene.users(AssetId::Material(id)))
                    .collect();
                workbench.selection.set(scene, users);
            }
            Ok(())
        }
        Wish::Set(field, value) => {
            let of = match workbench.scenes.scene() {
                Some(scene) => fields::carried_over(scene, &panel.chosen, field, &value),
                None => Vec::new(),
            };
            workbench.paint(field, of)
        }
        Wish::Reset(field) => {
            let of = panel.chosen.iter().map(|who| (who.clone(), None)).collect();
            workbench.change_assets(AssetEdit::Paint { field, of })
        }
        Wish::Import(field) => {
            panel.importing = Some(field);
            editor.ask_for(Question::Picture);
            return;
        }
        Wish::Through(pipeline) => {
            panel.pipeline = pipeline;
            Ok(())
        }
    };
    editor.materials.refused = result.err();
}

/// The material that was made last.
fn newest(scene: &Scene) -> Option<Who> {
    let last = scene.assets.materials().len().checked_sub(1)?;
    Some(scene.who_is_material(MaterialId(last as u32)))
}

impl Editor {
    /// Gives the chosen materials the picture of a file, in the field for which it was asked.
    pub(in crate::ui) fn take_picture(&mut self, file: &std::path::Path) -> Result<(), String> {
        let Some(field) = self.materials.importing else {
            return Ok(());
        };
        let path = self.workbench.import_picture(file)?;
        let recipe = format!("picture({path:?})");
        let value = SurfaceValue::Picture(Picture::Made(recipe));
        let of = self.materials.chosen.iter();
        let of = of.map(|who| (who.clone(), Some(value.clone()))).collect();
        let painted = self.workbench.change_assets(AssetEdit::Paint { field, of });
        if painted.is_ok() {
            self.materials.importing = None;
        }
        painted
    }
}

impl MaterialsPanel {
    /// The materials that are edited.
    pub fn chosen(&self) -> &[Who] {
        &self.chosen
    }
}
