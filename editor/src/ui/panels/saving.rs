//! The window that saves the scene.

use egui::{Context, Id, Modal, RichText, TextEdit};

use crate::ui::dialogs::Question;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::entities::sentence;
use crate::ui::theme::Palette;
use crate::ui::workbench::Workbench;

/// The window while it is open.
pub struct Saving {
    name: String,
    focus: bool,
    /// What went wrong.
    wrong: Option<String>,
}

impl Saving {
    /// A window with a name for the scene on screen.
    pub fn new(workbench: &Workbench) -> Self {
        Self {
            name: workbench.name_to_save(),
            focus: true,
            wrong: None,
        }
    }
}

/// Draws the window while it is open, and saves.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(mut saving) = editor.saving.take() else {
        return;
    };
    let (mut save, mut cancel, mut elsewhere) = (false, false, false);
    let modal = Modal::new(Id::unique("save scene")).show(ctx, |ui| {
        ui.set_width(430.0);
        let label = ui.label(say!("saving.save_the_scene_as"));
        let field = TextEdit::singleline(&mut saving.name).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(label.id);
        if std::mem::take(&mut saving.focus) {
            field.request_focus();
        }
        save |= field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        let text = say!("saving.a_name_for_the_project_scripts");
        ui.label(RichText::new(text).weak());
        if let Some(wrong) = &saving.wrong {
            ui.label(RichText::new(sentence(wrong)).color(Palette::of(ui).error));
        }
        ui.horizontal(|ui| {
            save |= ui.button(say!("saving.save")).clicked();
            cancel |= ui.button(say!("saving.cancel")).clicked();
            if editor.dialogs.native {
                elsewhere = ui.button(say!("saving.choose_a_place")).clicked();
            }
        });
    });
    if elsewhere {
        editor.ask_for(Question::SaveScene);
        return;
    }
    if save {
        match editor.workbench.save_scene(&saving.name) {
            Ok(_) => return,
            Err(why) => saving.wrong = Some(why),
        }
    }
    if !cancel && !modal.should_close() {
        editor.saving = Some(saving);
    }
}
