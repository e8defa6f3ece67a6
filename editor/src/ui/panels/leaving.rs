//! The question before something is given up: texts, changes by hand, entries of the notebook.

use egui::{Context, Id, Key, Modal, Modifiers, RichText, Ui};

use crate::ui::code::Leaving;
use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::panels::saving::Saving;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    Save,
    SaveScene,
    Discard,
    Stay,
}

/// What would be lost.
struct AtStake {
    texts: Vec<String>,
    scenes: Vec<(String, usize)>,
    entries: Vec<String>,
    /// Why something was not saved.
    failures: Vec<String>,
}

impl AtStake {
    fn of(editor: &Editor, leaving: &Leaving) -> Self {
        let all = !matches!(leaving, Leaving::File(_));
        let texts: Vec<String> = match leaving {
            Leaving::File(path) => vec![path.clone()],
            _ => editor.code.unsaved().map(|it| it.path.clone()).collect(),
        };
        let unsaved = editor.code.unsaved();
        let unsaved = unsaved.filter(|open| texts.contains(&open.path));
        let mut failures: Vec<String> = unsaved.filter_map(|open| open.failure.clone()).collect();
        failures.extend(editor.not_kept.clone().filter(|_| all));
        let workbench = &editor.workbench;
        let notebook = workbench.notebook.unsaved();
        let entries = notebook.map(|kept| kept.entry.name.clone());
        Self {
            scenes: match all {
                true => workbench.unsaved_changes(),
                false => Vec::new(),
            },
            entries: entries.filter(|_| all).collect(),
            texts,
            failures,
        }
    }

    fn show(&self, ui: &mut Ui) {
        for name in &self.texts {
            ui.label(RichText::new(name).monospace());
        }
        for (scene, count) in &self.scenes {
            ui.label(say!("leaving.changes", scene = scene, count = count));
        }
        if !self.scenes.is_empty() {
            ui.label(RichText::new(say!("leaving.about_changes")).weak());
        }
        for name in &self.entries {
            ui.label(say!("leaving.entry", name = name));
        }
        for failure in &self.failures {
            let color = ui.visuals().error_fg_color;
            let text = say!("leaving.not_saved", why = failure);
            ui.label(RichText::new(text).color(color));
        }
    }
}

/// Draws the question while it is asked, and does what was answered.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(leaving) = editor.code.leaving.clone() else {
        return;
    };
    if editor.saving.is_some() {
        // The scene is being saved first.
        return;
    }
    let stake = AtStake::of(editor, &leaving);
    let texts_alone = stake.scenes.is_empty() && stake.entries.is_empty();
    let shown = editor.workbench.scenes.shown();
    let shown_is_unsaved = stake.scenes.iter().any(|(name, _)| Some(&**name) == shown);
    let (heading, save) = match texts_alone {
        true => (say!("leaving.text_heading"), say!("leaving.save")),
        false => (say!("leaving.heading"), say!("leaving.keep")),
    };
    let mut answer = None;
    let modal = Modal::new(Id::unique("leaving")).show(ctx, |ui| {
        ui.set_max_width(480.0);
        ui.heading(heading);
        stake.show(ui);
        ui.add_space(6.0);
        ui.horizontal_wrapped(|ui| {
            if ui.button(save).clicked() {
                answer = Some(Answer::Save);
            }
            if shown_is_unsaved && ui.button(say!("leaving.save_scene")).clicked() {
                answer = Some(Answer::SaveScene);
            }
            if ui.button(say!("leaving.discard")).clicked() {
                answer = Some(Answer::Discard);
            }
            if ui.button(say!("leaving.stay")).clicked() {
                answer = Some(Answer::Stay);
            }
        });
    });
    let escaped = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    if escaped || modal.should_close() {
        answer = answer.or(Some(Answer::Stay));
    }
    match (answer, leaving) {
        (None, _) => {}
        (Some(Answer::Stay), _) => {
            editor.code.leaving = None;
            editor.not_kept = None;
        }
        (Some(Answer::SaveScene), _) => editor.saving = Some(Saving::new(&editor.workbench)),
        (Some(Answer::Save), Leaving::File(path)) => {
            if editor.save_file(&path) {
                editor.code.leaving = None;
                editor.code.discard(&path);
            }
        }
        (Some(Answer::Discard), Leaving::File(path)) => {
            editor.code.leaving = None;
            editor.code.discard(&path);
        }
        (Some(answer), leaving) => {
            let keeps = answer == Answer::Save;
            if keeps && !editor.keep_all() {
                return;
            }
            editor.code.discard_all();
            editor.code.leaving = None;
            match leaving {
                Leaving::Project(folder) => editor.open_project(&folder, keeps),
                _ => editor.quit(keeps),
            }
        }
    }
}
