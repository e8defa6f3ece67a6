//! Views as lines of text: copied, and pasted into a window that reads them.

use egui::{Context, Id, Key, Modal, Modifiers, RichText, TextEdit};

use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::viewpoint::{MARK, Viewpoint};

/// The window in which a view is pasted, while it is open.
#[derive(Default)]
pub struct PasteWindow {
    typed: String,
    problem: Option<String>,
}

/// Copies what is on the screen; of two pipelines, with A; of two viewports, the one that has the focus.
pub fn copy(editor: &mut Editor, ctx: &Context) {
    let focus = editor.workbench.focus();
    let Some(view) = editor.workbench.viewpoint_in(focus) else {
        let text = say!("view_text.there_is_no_view_to_copy");
        editor.workbench.log.warn(text);
        return;
    };
    ctx.copy_text(view.to_string());
    if let Some(left_out) = editor.workbench.left_out_of_view() {
        editor.workbench.log.warn(left_out);
    }
    editor
        .workbench
        .log
        .info(say!("view_text.copied", view = view));
}

/// Draws the window while it is open. A view that is pasted anywhere else, outside of fields, is gone to
/// as well.
pub fn show(editor: &mut Editor, ctx: &Context) {
    let Some(mut window) = editor.paste.take() else {
        if !ctx.egui_wants_keyboard_input() && editor.palette.is_none() {
            pasted(editor, ctx);
        }
        return;
    };
    let entered = ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter));
    let modal = Modal::new(Id::unique("paste a view")).show(ctx, |ui| {
        ui.set_width(520.0);
        let label = ui.label(say!("view_text.paste_a_view"));
        let field = TextEdit::multiline(&mut window.typed)
            .desired_rows(4)
            .desired_width(f32::INFINITY)
            .hint_text(format!("{MARK}1 scene=… pipeline=…"));
        let field = ui.add(field).labelled_by(label.id);
        field.request_focus();
        if let Some(problem) = &window.problem {
            ui.label(RichText::new(problem).color(Palette::of(ui).error));
        }
        ui.horizontal(|ui| {
            let go = ui.button(say!("view_text.go_there")).clicked();
            (go, ui.button(say!("view_text.close")).clicked())
        })
        .inner
    });
    let (go, close) = modal.inner;
    if go || entered {
        match go_to(editor, &window.typed) {
            Ok(()) => return,
            Err(problem) => window.problem = Some(problem),
        }
    }
    if !close && !modal.should_close() {
        editor.paste = Some(window);
    }
}

fn go_to(editor: &mut Editor, text: &str) -> Result<(), String> {
    let view: Viewpoint = text.parse().map_err(|error| format!("{error}."))?;
    editor.workbench.go_to(&view)
}

/// Goes to a view that was pasted while no field had the keys.
fn pasted(editor: &mut Editor, ctx: &Context) {
    let text = ctx.input(|input| {
        input.events.iter().find_map(|event| match event {
            egui::Event::Paste(text) if text.trim_start().starts_with(MARK) => Some(text.clone()),
            _ => None,
        })
    });
    if let Some(text) = text
        && let Err(error) = go_to(editor, &text)
    {
        // There the text can be mended.
        editor.paste = Some(PasteWindow {
            typed: text,
            problem: Some(error),
        });
    }
}
