//! Scripts and shaders, to be read and changed beside the picture.

mod find;
pub mod lines;
mod list;
mod notes;
mod text;

use egui::{Button, Context, Key, KeyboardShortcut, Modifiers, RichText, ScrollArea, Ui};
use lightbench::render::Problem;

use self::find::{Find, Wish};
use self::list::FileList;
use self::notes::Choice;
use self::text::{Mark, Shown, TextField};
use crate::ui::code::Spot;
use crate::ui::code::document::Document;
use crate::ui::editor::Editor;
use crate::ui::layout::{self, Panel};
use crate::ui::messages::say;
use crate::ui::theme::Palette;

/// Mistakes that are listed below the text; all are at their lines.
const MOST_MISTAKES: usize = 3;

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct CodePanel {
    field: TextField,
    find: Find,
    list: FileList,
    comparing: bool,
    /// The file is saved once the text has taken what was typed.
    save: bool,
    /// The text gets the keys from the next frame on: those of this one were for something else.
    focus_next: bool,
    /// In how many frames the text gets the keys. A click beside it in the first one takes them away
    /// again.
    focus: u8,
    /// What is chosen in the next frame, in bytes.
    choose: Option<std::ops::Range<usize>>,
}

impl CodePanel {
    /// Gives the text the keys.
    pub fn focus(&mut self) {
        self.focus_next = true;
    }
}

/// Keys that work while a text has them all.
pub fn keys(editor: &mut Editor, ctx: &Context) {
    let is_there = layout::is_in_front(&editor.layout, Panel::Code);
    if !is_there || editor.code.leaving.is_some() {
        return;
    }
    let panel = &editor.code_panel;
    let has_keys = panel.field.has_keys || panel.find.has_keys;
    let press = |modifiers, key| {
        let shortcut = KeyboardShortcut::new(modifiers, key);
        ctx.input_mut(|input| input.consume_shortcut(&shortcut))
    };
    if has_keys && press(Modifiers::COMMAND, Key::S) {
        // After the letters that were typed before it in this frame.
        editor.code_panel.save = true;
    }
    if press(Modifiers::COMMAND, Key::F)
        && let Some(document) = editor.code.shown()
    {
        let panel = &mut editor.code_panel;
        panel.find.open(document, &panel.field.chosen);
    }
    if press(Modifiers::COMMAND, Key::G) {
        editor.code_panel.find.open_line();
    }
    if has_keys && press(Modifiers::COMMAND, Key::W) {
        editor.code.close(editor.code.active());
    }
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    if std::mem::take(&mut editor.code_panel.focus_next) {
        editor.code_panel.focus = 2;
    }
    let offer = notes::offers(&editor.code, ui);
    tabs(editor, ui);
    let has_project = editor.workbench.files().project().is_some();
    let marks = editor.code.shown().map(|document| {
        let path = &*document.path;
        let problems = editor.workbench.problems();
        let here = problems.filter(|problem| &*problem.place.file == path);
        here.filter_map(|problem| mark(document, problem))
            .collect::<Vec<_>>()
    });
    let mut choice = offer;
    let mut wish = None;
    if let Some(document) = editor.code.shown() {
        let panel = &mut editor.code_panel;
        choice = choice.or(notes::show(document, has_project, &mut panel.comparing, ui));
        wish = panel.find.show(ui, document, &panel.field.chosen);
    }
    match marks {
        Some(marks) => body(editor, ui, &marks),
        None => nothing(ui),
    }
    match wish {
        Some(Wish::Choose(range)) => editor.code_panel.choose = Some(range),
        Some(Wish::Go(spot)) => editor.code.going = Some(spot),
        Some(Wish::Back) => editor.code_panel.focus(),
        None => {}
    }
    if std::mem::take(&mut editor.code_panel.save) {
        editor.save_shown_file();
    }
    if let Some(choice) = choice {
        decide(editor, choice);
    }
    let panel = &editor.code_panel;
    let waits = panel.focus_next || panel.focus > 0 || panel.choose.is_some();
    if waits || editor.code.going.is_some() {
        ui.ctx().request_repaint();
    }
}

fn nothing(ui: &mut Ui) {
    let text = say!("code.open_a_script_or_a_shader");
    ui.label(RichText::new(text).weak());
}

/// The open files, and what is done with the one that is shown.
fn tabs(editor: &mut Editor, ui: &mut Ui) {
    let mut show = None;
    let mut close = None;
    ui.horizontal_wrapped(|ui| {
        let active = editor.code.active();
        for (index, document) in editor.code.documents().iter().enumerate() {
            ui.push_id(index, |ui| {
                ui.spacing_mut().item_spacing.x = 1.0;
                let sign = if document.is_unsaved() { "• " } else { "" };
                let text = format!("{sign}{}", document.name());
                let tab = ui.selectable_label(index == active, text);
                let tab = tab.on_hover_text(&document.path);
                if tab.clicked() {
                    show = Some(index);
                }
                let cross = ui.add(Button::new("×").small().frame(false));
                cross.widget_info(|| {
                    let name = say!("code.close_file", name = document.name());
                    egui::WidgetInfo::labeled(egui::Role::Button, true, name)
                });
                if cross.clicked() || tab.middle_clicked() {
                    close = Some(index);
                }
            });
        }
        let list = &mut editor.code_panel.list;
        if let Some(path) = list.show(ui, editor.workbench.files()) {
            editor.open_code(&path, None);
        }
        let unsaved = editor.code.shown().is_some_and(Document::is_unsaved);
        let save = ui.add_enabled(unsaved, Button::new(say!("code.save")));
        if save.on_hover_text(say!("code.ctrl_s")).clicked() {
            editor.save_shown_file();
        }
    });
    if let Some(index) = show {
        editor.code.show(index);
        editor.code_panel.focus();
    }
    if let Some(index) = close {
        editor.code.close(index);
    }
}

/// A mistake at the line where it is now.
fn mark(document: &Document, problem: &Problem) -> Option<Mark> {
    let line = problem.place.line as usize;
    if line == 0 {
        return None;
    }
    Some(Mark {
        line: document.line_now(line)?,
        column: problem.place.column as usize,
        message: problem.message.clone(),
        hint: problem.hint.clone(),
    })
}

/// The text, and the mistakes below it.
fn body(editor: &mut Editor, ui: &mut Ui, marks: &[Mark]) {
    let Editor {
        code,
        code_panel,
        workbench,
        ..
    } = editor;
    let going = code.going.take();
    let Some(document) = code.shown_mut() else {
        return;
    };
    let row = ui.text_style_height(&egui::TextStyle::Body) + ui.spacing().item_spacing.y;
    let below = row * (1.0 + marks.len().min(MOST_MISTAKES) as f32) + 6.0;
    let area = ui.available_rect_before_wrap();
    let height = (area.height() - below).max(60.0);
    let rect = egui::Rect::from_min_size(area.min, egui::vec2(area.width(), height));
    let place = going.map(|spot| text::range_of(&document.text, spot));
    if place.is_some() {
        code_panel.focus = 2;
    }
    let focus = code_panel.focus > 0;
    code_panel.focus = code_panel.focus.saturating_sub(1);
    let shown = Shown {
        marks,
        found: code_panel.find.found(),
        go: place.or(code_panel.choose.take()),
        focus,
    };
    let mut child = ui.new_child(egui::UiBuilder::new().max_rect(rect));
    code_panel.field.show(&mut child, document, &shown);
    ui.advance_cursor_after_rect(rect);
    let jump = mistakes(ui, marks);
    let (line, column) = text::line_and_column(&document.text, code_panel.field.chosen.end);
    ui.horizontal(|ui| {
        ui.weak(workbench.files().display(&document.path));
        ui.weak(say!("code.line_column", line = line, column = column));
    });
    if let Some(spot) = jump {
        code.going = Some(spot);
    }
}

fn mistakes(ui: &mut Ui, marks: &[Mark]) -> Option<Spot> {
    let palette = Palette::of(ui);
    let mut jump = None;
    let area = ScrollArea::vertical()
        .id_salt("mistakes")
        .max_height(80.0)
        .auto_shrink([false, true]);
    ui.spacing_mut().item_spacing.y = 2.0;
    area.show(ui, |ui| {
        for (index, mark) in marks.iter().take(MOST_MISTAKES).enumerate() {
            ui.push_id(index, |ui| {
                let text = say!("code.line", line = mark.line, message = mark.message);
                let text = RichText::new(text).color(palette.error);
                let link = ui.add(
                    egui::Label::new(text)
                        .truncate()
                        .sense(egui::Sense::click()),
                );
                let link = match &mark.hint {
                    Some(hint) => link.on_hover_text(hint),
                    None => link,
                };
                if link.clicked() {
                    jump = Some(Spot {
                        line: mark.line,
                        column: mark.column,
                    });
                }
            });
        }
    });
    jump
}

fn decide(editor: &mut Editor, choice: Choice) {
    match choice {
        Choice::Mine => {
            if let Some(document) = editor.code.shown_mut() {
                document.keep_mine();
            }
        }
        Choice::Theirs => {
            let files = editor.workbench.files().clone();
            let index = editor.code.active();
            let there = editor
                .code
                .shown_mut()
                .is_none_or(|document| document.take_theirs(&files));
            if !there {
                let path = editor.code.documents()[index].path.clone();
                editor.code.discard(&path);
            }
        }
        Choice::Copy => editor.copy_shown_file(),
        Choice::Project => editor.ask_for(crate::ui::dialogs::Question::Project),
        Choice::Restore(index) => editor.restore_draft(index),
        Choice::ThrowAway(index) => editor.code.throw_away(index),
    }
}
