//! The question before a text is given up.

use egui::{Context, Id, Key, Modal, Modifiers, RichText};

use crate::ui::code::Leaving;
use crate::ui::editor::Editor;
use crate::ui::messages::say;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Answer {
    Save,
    Discard,
    Stay,
}

/// Draws the question while it is asked, and does what was answered.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(leaving) = editor.code.leaving.clone() else {
        return;
    };
    let names: Vec<String> = match &leaving {
        Leaving::File(path) => vec![path.clone()],
        _ => editor
            .code
            .unsaved()
            .map(|open| open.path.clone())
            .collect(),
    };
    let failures: Vec<String> = editor
        .code
        .unsaved()
        .filter(|open| names.contains(&open.path))
        .filter_map(|open| open.failure.clone())
        .collect();
    let mut answer = None;
    let modal = Modal::new(Id::unique("leaving")).show(ctx, |ui| {
        ui.set_max_width(460.0);
        ui.heading(say!("code.save_the_text_first"));
        for name in &names {
            ui.label(RichText::new(name).monospace());
        }
        for failure in &failures {
            let color = ui.visuals().error_fg_color;
            ui.label(RichText::new(say!("code.not_saved", failure = failure)).color(color));
        }
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            if ui.button(say!("code.save_and_close")).clicked() {
                answer = Some(Answer::Save);
            }
            if ui.button(say!("code.dont_save")).clicked() {
                answer = Some(Answer::Discard);
            }
            if ui.button(say!("code.go_on_editing")).clicked() {
                answer = Some(Answer::Stay);
            }
        });
    });
    let escaped = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    if escaped || modal.should_close() {
        answer = answer.or(Some(Answer::Stay));
    }
    let Some(answer) = answer else {
        return;
    };
    match (answer, leaving) {
        (Answer::Stay, _) => editor.code.leaving = None,
        (Answer::Save, Leaving::File(path)) => {
            if editor.save_file(&path) {
                editor.code.leaving = None;
                editor.code.discard(&path);
            }
        }
        (Answer::Discard, Leaving::File(path)) => {
            editor.code.leaving = None;
            editor.code.discard(&path);
        }
        (answer, leaving) => {
            let done = answer == Answer::Discard || editor.save_all_files();
            if !done {
                return;
            }
            editor.code.discard_all();
            editor.code.leaving = None;
            match leaving {
                Leaving::Project(folder) => editor.open_project(&folder),
                _ => editor.quit(),
            }
        }
    }
}
