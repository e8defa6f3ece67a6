//! The line of the console: text, caret, earlier lines, and names that complete what was begun.

use egui::text::{CCursor, CCursorRange};
use egui::{Event, Key, Modifiers, RichText, ScrollArea, TextEdit, Ui};
use lightbench::script::Scene;
use lightbench::script::reference::{Completions, complete};

use crate::ui::messages::say;

/// Height of the list of candidates, points.
const LIST: f32 = 96.0;

/// A line that is being written.
#[derive(Default)]
pub struct Line {
    text: String,
    /// Where the caret is, in bytes.
    caret: usize,
    /// Which earlier line is shown, counted from the last, and what was written before it.
    earlier: Option<(usize, String)>,
    /// What may stand where a name was begun, after Tab.
    completions: Option<Completions>,
    /// The candidate that stands in the line.
    chosen: Option<usize>,
    /// Whether Tab was pressed behind letters of the same frame.
    tab_waits: bool,
}

/// Whether letters were typed in this frame before Tab was pressed.
fn typed_before_tab(ui: &Ui) -> bool {
    ui.input(|input| {
        let is_tab = |event: &Event| {
            matches!(
                event,
                Event::Key {
                    key: Key::Tab,
                    pressed: true,
                    ..
                }
            )
        };
        let before = input.events.iter().take_while(|event| !is_tab(event));
        before
            .into_iter()
            .any(|event| matches!(event, Event::Text(_)))
    })
}

impl Line {
    /// What is written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where the caret is, in bytes.
    pub fn caret(&self) -> usize {
        self.caret
    }

    /// The height that the candidates take.
    pub fn candidates_height(&self, ui: &Ui) -> f32 {
        self.completions.as_ref().map_or(0.0, |completions| {
            let rows = completions.candidates.len() as f32;
            (rows * (ui.spacing().interact_size.y + 1.0)).min(LIST) + ui.spacing().item_spacing.y
        })
    }

    /// Draws the line and its candidates. Returns what was entered.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        scene: Option<&Scene>,
        history: &[String],
    ) -> Option<String> {
        let id = egui::Id::unique("console line");
        let mut moved = false;
        if ui.memory(|memory| memory.has_focus(id)) {
            let typed_before = typed_before_tab(ui);
            let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
            let tab = pressed(Key::Tab);
            if std::mem::take(&mut self.tab_waits) || tab && !typed_before {
                moved |= self.complete(scene);
            } else if tab {
                // What was typed before it is not in the line yet.
                self.tab_waits = true;
                ui.ctx().request_repaint();
            }
            if pressed(Key::ArrowUp) {
                moved |= self.go_back(history);
            }
            if pressed(Key::ArrowDown) {
                moved |= self.go_forward(history);
            }
        }
        self.list(ui);
        if moved {
            // Before the field sees what was typed behind the key.
            let letters = self.text[..self.caret].chars().count();
            let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
            let cursor = CCursorRange::one(CCursor::new(letters));
            state.cursor.set_char_range(Some(cursor));
            state.store(ui.ctx(), id);
        }
        let before = self.text.clone();
        let edit = ui
            .horizontal(|ui| {
                let label = ui.label(say!("console.line"));
                let edit = TextEdit::singleline(&mut self.text)
                    .id(id)
                    .code_editor()
                    .lock_focus(true)
                    .desired_width(f32::INFINITY)
                    .show(ui);
                edit.response.response.clone().labelled_by(label.id);
                edit
            })
            .inner;
        if self.text != before {
            self.completions = None;
            self.chosen = None;
            self.earlier = None;
        }
        if let Some(range) = edit.cursor_range {
            let letters = range.primary.index.0;
            let at = self.text.char_indices().nth(letters);
            self.caret = at.map_or(self.text.len(), |(at, _)| at);
        }
        let entered =
            edit.response.response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if !entered {
            return None;
        }
        ui.memory_mut(|memory| memory.request_focus(id));
        self.caret = 0;
        self.earlier = None;
        self.completions = None;
        let text = std::mem::take(&mut self.text);
        (!text.trim().is_empty()).then_some(text)
    }

    /// Tab: what all candidates begin with, then one after the other.
    fn complete(&mut self, scene: Option<&Scene>) -> bool {
        let Some(scene) = scene else {
            return false;
        };
        // Nothing was written since the last Tab: the next candidate.
        if let Some(completions) = &self.completions {
            let count = completions.candidates.len();
            let next = self.chosen.map_or(0, |chosen| (chosen + 1) % count);
            self.put(next);
            return true;
        }
        let found = complete(scene, &self.text, self.caret);
        let begun = self.caret - found.start;
        let common = found.common().to_owned();
        match found.candidates.len() {
            0 => return false,
            1 => {
                self.replace(found.start, &common);
                self.completions = None;
            }
            _ => {
                if common.len() > begun {
                    self.replace(found.start, &common);
                }
                // The first may be what all begin with.
                let first = found.candidates.first();
                self.chosen = first.filter(|first| first.text == common).map(|_| 0);
                self.completions = Some(found);
            }
        }
        true
    }

    /// Puts a candidate into the line.
    fn put(&mut self, index: usize) {
        let Some(completions) = self.completions.clone() else {
            return;
        };
        if let Some(candidate) = completions.candidates.get(index) {
            self.replace(completions.start, &candidate.text);
            self.chosen = Some(index);
        }
    }

    /// Replaces what stands from a place to the caret.
    fn replace(&mut self, start: usize, text: &str) {
        self.text.replace_range(start..self.caret, text);
        self.caret = start + text.len();
        self.chosen = None;
    }

    fn go_back(&mut self, history: &[String]) -> bool {
        let (at, draft) = match self.earlier.take() {
            Some((at, draft)) => ((at + 1).min(history.len().saturating_sub(1)), draft),
            None => (0, self.text.clone()),
        };
        self.recall(history, at, draft)
    }

    fn go_forward(&mut self, history: &[String]) -> bool {
        match self.earlier.take() {
            None => false,
            Some((0, draft)) => {
                self.text = draft;
                self.caret = self.text.len();
                self.completions = None;
                true
            }
            Some((at, draft)) => self.recall(history, at - 1, draft),
        }
    }

    fn recall(&mut self, history: &[String], at: usize, draft: String) -> bool {
        let Some(text) = history.iter().rev().nth(at) else {
            return false;
        };
        self.text.clone_from(text);
        self.caret = self.text.len();
        self.completions = None;
        self.chosen = None;
        self.earlier = Some((at, draft));
        true
    }

    /// The candidates, with what each does.
    fn list(&mut self, ui: &mut Ui) {
        let Some(completions) = &self.completions else {
            return;
        };
        let row = ui.spacing().interact_size.y;
        let count = completions.candidates.len();
        let mut wanted = None;
        let area = ScrollArea::vertical()
            .id_salt("candidates")
            .max_height(LIST)
            .auto_shrink([false, true]);
        ui.spacing_mut().item_spacing.y = 1.0;
        area.show_rows(ui, row, count, |ui, range| {
            for index in range {
                let candidate = &completions.candidates[index];
                ui.horizontal(|ui| {
                    let form = RichText::new(&candidate.form).monospace();
                    if ui
                        .selectable_label(self.chosen == Some(index), form)
                        .clicked()
                    {
                        wanted = Some(index);
                    }
                    let about = egui::Label::new(RichText::new(&candidate.about).weak());
                    ui.add(about.truncate());
                });
            }
        });
        ui.spacing_mut().item_spacing.y = 5.0;
        if let Some(index) = wanted {
            self.put(index);
        }
    }
}
