//! All scripts and shaders that can be opened.

use egui::{Button, Key, Modifiers, Popup, PopupCloseBehavior, RichText, ScrollArea, TextEdit, Ui};
use lightbench::assets::files::{Files, Listed, Origin};

use crate::ui::messages::say;

/// The list, while it is open.
#[derive(Default)]
pub struct FileList {
    files: Vec<Listed>,
    filter: String,
    was_open: bool,
}

/// The folders with what is edited, and the ends of the names.
const FOLDERS: [(&str, &str); 3] = [("scripts", "rhai"), ("shaders", "wgsl"), ("lessons", "")];

/// Texts that lie among lessons.
const TEXTS: [&str; 4] = [".rhai", ".wgsl", ".md", ".scene"];

impl FileList {
    /// Draws the button and, below it, the list. Returns the file that was chosen.
    pub fn show(&mut self, ui: &mut Ui, files: &Files) -> Option<String> {
        let button = ui.button(say!("code.open_file"));
        let mut chosen = None;
        let popup = Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        let open = popup.is_open();
        if open && !self.was_open {
            self.files = all(files);
            self.filter.clear();
        }
        let opened = open && !self.was_open;
        self.was_open = open;
        popup.show(|ui| {
            ui.set_width(430.0);
            let label = ui.label(say!("code.scripts_and_shaders_by_words_of"));
            let field = TextEdit::singleline(&mut self.filter).desired_width(f32::INFINITY);
            let field = ui.add(field).labelled_by(label.id);
            if opened {
                field.request_focus();
            }
            let entered = field.lost_focus()
                && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter));
            let rows: Vec<&Listed> = self
                .files
                .iter()
                .filter(|file| fits(&file.path, &self.filter))
                .collect();
            if entered {
                chosen = rows.first().map(|file| file.path.clone());
            }
            let height = ui.spacing().interact_size.y;
            let area = ScrollArea::vertical().max_height(360.0).auto_shrink(false);
            ui.spacing_mut().item_spacing.y = 1.0;
            area.show_rows(ui, height, rows.len(), |ui, range| {
                for file in &rows[range] {
                    let mut text = RichText::new(&file.path);
                    if matches!(file.origin, Origin::Project(_)) {
                        text = text.strong();
                    }
                    let width = ui.available_width();
                    let row = Button::selectable(false, text).min_size(egui::vec2(width, 0.0));
                    if ui.add(row).clicked() {
                        chosen = Some(file.path.clone());
                    }
                }
            });
            if rows.is_empty() {
                ui.weak(say!("code.nothing_is_called_so"));
            }
            if chosen.is_some() {
                ui.close();
            }
        });
        chosen
    }
}

/// Those of the project and those inside the program, by their paths.
fn all(files: &Files) -> Vec<Listed> {
    let mut all = Vec::new();
    for (folder, ending) in FOLDERS {
        // A folder that can't be read has nothing to open.
        let mut listed = files.list(folder, ending).unwrap_or_default();
        listed.retain(|file| TEXTS.iter().any(|end| file.path.ends_with(end)));
        all.extend(listed);
    }
    all
}

/// Whether each word that was typed is in a path.
fn fits(path: &str, typed: &str) -> bool {
    let path = path.to_lowercase();
    typed
        .split_whitespace()
        .all(|word| path.contains(&word.to_lowercase()))
}
