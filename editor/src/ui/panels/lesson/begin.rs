//! The list of lessons, and the form that begins one.

use egui::{Frame, RichText, ScrollArea, TextEdit, Ui};
use lightbench::assets::files::Files;

use super::{Given, Wish};
use crate::ui::lesson::{Beginning, Lessons, Open};
use crate::ui::messages::message;
use crate::ui::theme::Palette;

/// All lessons, to open one.
pub(super) fn list(lessons: &mut Lessons, ui: &mut Ui, files: &Files, given: &mut Given) {
    let about = given.say(message!("lesson.list"), message!("lesson.list_es"));
    ui.label(RichText::new(about).weak());
    ui.add_space(4.0);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for lesson in lessons.list(files) {
            match &lesson.title {
                Ok(title) => {
                    let number = lesson.name.split('-').next().unwrap_or_default();
                    let text = format!("{number}  {}", super::plain(given.words(title)));
                    ui.horizontal(|ui| {
                        if ui.link(text).clicked() {
                            *given.wish = Some(Wish::Open(lesson.name.clone()));
                        }
                        let word =
                            given.say(message!("lesson.points"), message!("lesson.points_es"));
                        ui.weak(format!("{} {word}", lesson.points));
                    });
                }
                Err(why) => _ = ui.label(RichText::new(why).color(Palette::of(ui).error)),
            }
        }
    });
}

/// What is asked to begin the lesson that is read.
pub(super) fn begin(beginning: &mut Beginning, open: &Open, ui: &mut Ui, given: &mut Given) {
    let fill = ui.visuals().faint_bg_color;
    Frame::new().fill(fill).inner_margin(6).show(ui, |ui| {
        ui.set_width(ui.available_width());
        let about = given.say(
            message!("lesson.begin_about"),
            message!("lesson.begin_about_es"),
        );
        ui.label(about);
        let folder = given.say(message!("lesson.folder"), message!("lesson.folder_es"));
        ui.horizontal_wrapped(|ui| {
            let label = ui.label(folder);
            let field = TextEdit::singleline(&mut beginning.folder).desired_width(220.0);
            ui.add(field).labelled_by(label.id);
            let choose = given.say(message!("lesson.choose"), message!("lesson.choose_es"));
            if ui.button(choose).clicked() {
                *given.wish = Some(Wish::ChooseFolder);
            }
        });
        ui.horizontal_wrapped(|ui| {
            let student = given.say(message!("lesson.student"), message!("lesson.student_es"));
            let label = ui.label(student);
            let hint = given.say(message!("lesson.optional"), message!("lesson.optional_es"));
            let field = TextEdit::singleline(&mut beginning.student);
            let field = field.desired_width(140.0).hint_text(hint);
            let about = given.say(
                message!("lesson.student_about"),
                message!("lesson.student_about_es"),
            );
            ui.add(field).labelled_by(label.id).on_hover_text(about);
            let begin = given.say(message!("lesson.begin"), message!("lesson.begin_es"));
            let can = !beginning.folder.trim().is_empty();
            if ui.add_enabled(can, egui::Button::new(begin)).clicked() {
                *given.wish = Some(Wish::Begin);
            }
        });
        let hands_in = given.say(message!("lesson.hand_in"), message!("lesson.hand_in_es"));
        let files = open.lesson.about.submits.join(", ");
        ui.label(RichText::new(format!("{hands_in} {files}")).weak());
        if let Some(why) = &beginning.why_not {
            ui.label(RichText::new(why).color(Palette::of(ui).error));
        }
    });
    ui.add_space(4.0);
}
