//! One line of scene script, run on the scene on screen.

mod line;

use std::collections::VecDeque;

use egui::{RichText, ScrollArea, Ui};
use lightbench::script::reference::{Help, help_at};

use crate::ui::editor::Editor;
use crate::ui::messages::say;
use crate::ui::theme::Palette;
use crate::ui::workbench::hand::Evaluated;
use line::Line;

/// Lines of output kept.
const MOST_OUTPUT: usize = 500;

/// What one line of output is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Input,
    Value,
    Printed,
    Error,
}

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct ConsolePanel {
    line: Line,
    output: VecDeque<(Kind, String)>,
}

impl ConsolePanel {
    fn say(&mut self, kind: Kind, text: impl Into<String>) {
        if self.output.len() == MOST_OUTPUT {
            self.output.pop_front();
        }
        self.output.push_back((kind, text.into()));
    }

    fn tell(&mut self, evaluated: Evaluated) {
        for line in evaluated.printed {
            self.say(Kind::Printed, line.text);
        }
        match evaluated.result {
            Ok(None) => {}
            Ok(Some(value)) => self.say(Kind::Value, value),
            Err(problem) => {
                // The line itself stands above.
                let place = match problem.place.column {
                    0 => String::new(),
                    column => say!("console.column", column = column),
                };
                let hint = problem.hint.map_or_else(String::new, |h| format!(" ({h})"));
                self.say(Kind::Error, format!("{place}{}{hint}", problem.message));
            }
        }
    }
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let help = match editor.workbench.scenes.scene() {
        Some(scene) => help_at(
            scene,
            editor.console.line.text(),
            editor.console.line.caret(),
        ),
        None => Vec::new(),
    };
    let below = 52.0 + editor.console.line.candidates_height(ui);
    let height = (ui.available_height() - below).max(30.0);
    output(&editor.console, ui, height);
    let panel = &mut editor.console;
    let scene = editor.workbench.scenes.scene();
    let entered = panel.line.show(ui, scene, &editor.kept.console);
    explain(ui, &help);
    let Some(text) = entered else {
        return;
    };
    panel.say(Kind::Input, format!("> {text}"));
    if let Err(error) = editor.kept.remember(&text) {
        editor.workbench.log.warn(error);
    }
    match editor.workbench.evaluate(&text) {
        Some(evaluated) => editor.console.tell(evaluated),
        None => editor
            .console
            .say(Kind::Error, say!("console.no_scene_is_loaded_yet")),
    }
}

fn output(panel: &ConsolePanel, ui: &mut Ui, height: f32) {
    let palette = Palette::of(ui);
    let area = ScrollArea::both()
        .id_salt("output")
        .max_height(height)
        .min_scrolled_height(height)
        .auto_shrink(false)
        .stick_to_bottom(true);
    area.show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        if panel.output.is_empty() {
            let text = say!("console.a_line_of_scene_script_as");
            ui.label(RichText::new(text).weak());
        }
        for (kind, text) in &panel.output {
            let text = RichText::new(text).monospace();
            ui.label(match kind {
                Kind::Input => text.weak(),
                Kind::Value => text.color(palette.accent),
                Kind::Printed => text,
                Kind::Error => text.color(palette.error),
            });
        }
    });
}

/// The text of the name at the caret, in one line.
fn explain(ui: &mut Ui, help: &[Help]) {
    let Some(first) = help.first() else {
        ui.label(" ");
        return;
    };
    let text = format!("{}   {}", first.forms.join("  "), first.about);
    let label = ui.add(egui::Label::new(RichText::new(text).weak()).truncate());
    label.on_hover_ui(|ui| {
        for help in help {
            ui.label(RichText::new(help.forms.join("\n")).monospace());
            ui.label(&help.about);
            if let Some(example) = &help.example {
                ui.label(RichText::new(example).monospace().weak());
            }
            ui.add_space(4.0);
        }
    });
}
