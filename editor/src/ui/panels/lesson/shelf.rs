//! The lessons in the gallery, each with a picture of its text.

use egui::{Button, Image, RichText, ScrollArea, Ui, vec2};

use super::text::BODY;
use crate::ui::editor::Editor;
use crate::ui::lesson::letters::shown;
use crate::ui::messages::say;

/// Points of a picture.
const PICTURE: egui::Vec2 = vec2(224.0, 126.0);

/// Draws the lessons that fit the gallery's words. Returns the name of the one that was chosen.
pub fn show(editor: &mut Editor, ui: &mut Ui) -> Option<String> {
    let files = editor.workbench.files().clone();
    let language = editor.lessons.language;
    let filter = editor.gallery.filter.to_lowercase();
    let mut chosen = None;
    let mut any = false;
    let area = ScrollArea::vertical().auto_shrink(false);
    area.show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            for listed in editor.lessons.list(&files) {
                let (Ok(title), Some(lesson)) = (&listed.title, &listed.lesson) else {
                    continue;
                };
                let title = title.in_language(language);
                let known = format!("{title} {}", listed.name).to_lowercase();
                if !filter.split_whitespace().all(|word| known.contains(word)) {
                    continue;
                }
                any = true;
                let pictures = &mut editor.lesson_panel.pictures;
                let figure = lesson.about.figures.first();
                let picture = figure.and_then(|figure| {
                    let picture = pictures.of_lesson(ui.ctx(), lesson, &figure.file);
                    picture.ok()
                });
                ui.vertical(|ui| {
                    ui.set_width(PICTURE.x + 12.0);
                    let button = match &picture {
                        Some(picture) => {
                            Button::image(Image::new(&picture.texture).fit_to_exact_size(PICTURE))
                        }
                        None => Button::new(title).min_size(PICTURE),
                    };
                    let button = ui.add(button);
                    button
                        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, title));
                    if button.clicked() {
                        chosen = Some(listed.name.clone());
                    }
                    ui.label(shown(ui, title, BODY, RichText::strong));
                    ui.label(RichText::new(&listed.name).small().weak());
                });
            }
        });
        if !any {
            ui.weak(say!("lesson.none"));
        }
    });
    chosen
}
