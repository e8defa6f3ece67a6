//! The lessons in the gallery, each with a picture of its text.

use egui::{Button, Image, RichText, ScrollArea, Ui, vec2};
use lightbench::lab::lesson::Language;

use super::text::BODY;
use crate::ui::editor::Editor;
use crate::ui::lesson::Listed;
use crate::ui::lesson::letters::shown;
use crate::ui::lesson::pictures::Pictures;
use crate::ui::messages::say;

/// Points of a picture.
const PICTURE: egui::Vec2 = vec2(224.0, 126.0);

/// Width of a card with its frame, in points.
const CARD: f32 = PICTURE.x + 12.0;

/// Draws the lessons that fit the gallery's words. Returns the name of the one that was chosen.
pub fn show(editor: &mut Editor, ui: &mut Ui) -> Option<String> {
    let files = editor.workbench.files().clone();
    let language = editor.lessons.language;
    let filter = editor.gallery.filter.to_lowercase();
    let fits = |one: &&Listed| {
        let title = one.title.as_ref().map(|title| title.in_language(language));
        title.is_ok_and(|title| {
            let known = format!("{title} {}", one.name).to_lowercase();
            filter.split_whitespace().all(|word| known.contains(word))
        })
    };
    let listed: Vec<&Listed> = editor.lessons.list(&files).iter().filter(fits).collect();
    let pictures = &mut editor.lesson_panel.pictures;
    let columns = (ui.available_width() / (CARD + 8.0)).floor().max(1.0) as usize;
    let mut chosen = None;
    let area = ScrollArea::vertical().auto_shrink(false);
    area.show(ui, |ui| {
        for row in listed.chunks(columns) {
            ui.horizontal_top(|ui| {
                for one in row {
                    if card(ui, one, language, pictures) {
                        chosen = Some(one.name.clone());
                    }
                }
            });
        }
        if listed.is_empty() {
            ui.weak(say!("lesson.none"));
        }
    });
    chosen
}

/// One lesson with its picture. Returns whether it is chosen.
fn card(ui: &mut Ui, listed: &Listed, language: Language, pictures: &mut Pictures) -> bool {
    let (Ok(title), Some(lesson)) = (&listed.title, &listed.lesson) else {
        return false;
    };
    let title = title.in_language(language);
    let figure = lesson.about.figures.first();
    let picture = figure.and_then(|figure| pictures.of_lesson(ui.ctx(), lesson, &figure.file).ok());
    let whole = ui.vertical(|ui| {
        ui.set_width(CARD);
        let button = match &picture {
            Some(picture) => Button::image(Image::new(&picture.texture).fit_to_exact_size(PICTURE)),
            None => Button::new(title).min_size(PICTURE),
        };
        let button = ui.add(button);
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, title));
        ui.label(shown(ui, title, BODY, RichText::strong));
        ui.label(RichText::new(&listed.name).small().weak());
        button.clicked()
    });
    whole.inner
}
