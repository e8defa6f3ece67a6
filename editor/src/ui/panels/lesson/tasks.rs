//! The tasks of a lesson with what the last check found, explained with pictures, and its questions.

use std::path::Path;

use egui::{Color32, ComboBox, Context, Id, Image, Modal, RichText, TextEdit, Ui};
use lightbench::lab::lesson::{
    CriterionOutcome, Finding, Question, Refusal, State, Task, TaskOutcome,
};

use super::text::BODY;
use super::{Given, Wish, of_all};
use crate::ui::lesson::letters::shown;
use crate::ui::lesson::{CHECKED, Open};
use crate::ui::messages::message;
use crate::ui::theme::Palette;

/// The narrowest that a picture of three is drawn, in points.
const NARROWEST: f32 = 90.0;

/// Draws all tasks and questions.
pub(super) fn show(open: &mut Open, ui: &mut Ui, given: &mut Given) {
    notes(open, ui, given);
    let about = open.lesson.about.clone();
    for task in &about.tasks {
        let outcome = open.outcome.as_ref();
        let outcome = outcome.and_then(|(outcome, _)| outcome.task(&task.id));
        ui.push_id(&task.id, |ui| one(task, outcome, ui, given));
    }
    for question in &about.questions {
        ui.push_id(&question.id, |ui| asked(open, question, ui, given));
    }
    ui.add_space(20.0);
}

/// What is to be said of the check as a whole.
fn notes(open: &Open, ui: &mut Ui, given: &Given) {
    let warning = Palette::of(ui).warning;
    let Some((outcome, _)) = &open.outcome else {
        if open.begun.is_some() {
            let not_yet = given.say(message!("lesson.not_yet"), message!("lesson.not_yet_es"));
            ui.label(RichText::new(not_yet).weak());
        }
        return;
    };
    if outcome.marked {
        let marked = given.say(message!("lesson.marked"), message!("lesson.marked_es"));
        ui.label(RichText::new(marked).color(warning));
    }
    if given
        .project
        .as_ref()
        .is_some_and(|project| open.is_stale(project))
    {
        let stale = given.say(message!("lesson.stale"), message!("lesson.stale_es"));
        ui.label(RichText::new(stale).color(warning));
    }
}

/// The title of a task, with its points.
fn heading(title: &str, outcome: Option<&TaskOutcome>, of: u32, ui: &mut Ui, given: &Given) {
    ui.add_space(8.0);
    let points = match outcome {
        Some(outcome) => of_all(outcome.points, outcome.of, given),
        None => {
            let word = given.say(message!("lesson.points"), message!("lesson.points_es"));
            format!("{of} {word}")
        }
    };
    let full = outcome.is_some_and(|outcome| outcome.points == outcome.of);
    ui.horizontal_wrapped(|ui| {
        ui.label(shown(ui, title, 14.5, RichText::strong));
        let points = RichText::new(points);
        ui.label(if full {
            points.color(right(ui))
        } else {
            points.weak()
        });
    });
}

fn one(task: &Task, outcome: Option<&TaskOutcome>, ui: &mut Ui, given: &mut Given) {
    heading(given.words(&task.title), outcome, task.points(), ui, given);
    read(&task.read, ui, given);
    let Some(outcome) = outcome else {
        for criterion in &task.criteria {
            let text = format!("• {} ({})", given.words(&criterion.says), criterion.points);
            ui.label(shown(ui, &text, BODY, |text| text));
        }
        return;
    };
    if let Some(refusal) = &outcome.refusal {
        refused(refusal, &task.read, ui, given);
    }
    // What was refused as a whole says nothing of its parts.
    let judged =
        |one: &&CriterionOutcome| outcome.refusal.is_none() || one.state != State::NotReached;
    for judged in outcome.criteria.iter().filter(judged) {
        ui.push_id(&judged.id, |ui| criterion(judged, &task.read, ui, given));
    }
}

fn refused(refusal: &Refusal, known: &str, ui: &mut Ui, given: &mut Given) {
    let error = Palette::of(ui).error;
    let text = given.words(&refusal.says);
    ui.label(shown(ui, text, BODY, |text| text.color(error)));
    if let Some(place) = refusal.read.as_deref().filter(|place| *place != known) {
        read(place, ui, given);
    }
}

fn criterion(judged: &CriterionOutcome, known: &str, ui: &mut Ui, given: &mut Given) {
    let error = Palette::of(ui).error;
    let (state, color) = match judged.state {
        State::Passed => (
            given.say(message!("lesson.right"), message!("lesson.right_es")),
            right(ui),
        ),
        State::Failed => (
            given.say(message!("lesson.wrong"), message!("lesson.wrong_es")),
            error,
        ),
        State::NotReached => (
            given.say(
                message!("lesson.not_judged"),
                message!("lesson.not_judged_es"),
            ),
            ui.visuals().weak_text_color(),
        ),
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(state).color(color).strong());
        ui.label(shown(ui, given.words(&judged.says), BODY, |text| text));
        ui.weak(format!("({})", of_all(judged.points, judged.of, given)));
        if judged.marked {
            let near = given.say(message!("lesson.near"), message!("lesson.near_es"));
            ui.label(RichText::new(near).color(Palette::of(ui).warning));
        }
    });
    let told = judged.findings.iter().find(|finding| !finding.holds);
    let told = told.or_else(|| judged.findings.iter().find(|finding| finding.near));
    if let Some(told) = told {
        ui.indent("finding", |ui| finding(told, known, ui, given));
    }
}

fn finding(finding: &Finding, known: &str, ui: &mut Ui, given: &mut Given) {
    if let Some(cause) = &finding.cause {
        let cause = given.words(cause);
        ui.label(shown(ui, cause, BODY, RichText::strong));
    }
    let lines = [
        (
            message!("lesson.expected"),
            message!("lesson.expected_es"),
            Some(&finding.expected),
        ),
        (
            message!("lesson.found"),
            message!("lesson.found_es"),
            Some(&finding.found),
        ),
        (
            message!("lesson.where"),
            message!("lesson.where_es"),
            finding.place.as_ref(),
        ),
    ];
    for (english, spanish, words) in lines {
        if let Some(words) = words {
            let name = given.say(english, spanish);
            ui.horizontal_wrapped(|ui| {
                ui.weak(name);
                ui.label(shown(ui, given.words(words), BODY, |text| text));
            });
        }
    }
    pictures(finding, ui, given);
    if let Some(place) = finding.read.as_deref().filter(|place| *place != known) {
        read(place, ui, given);
    }
}

/// The pictures of a finding beside each other: what was expected, what was drawn, the difference.
fn pictures(finding: &Finding, ui: &mut Ui, given: &mut Given) {
    let Some(project) = given
        .project
        .clone()
        .filter(|_| !finding.pictures.is_empty())
    else {
        return;
    };
    let count = finding.pictures.len() as f32;
    let gaps = ui.spacing().item_spacing.x * (count - 1.0);
    let width = ((ui.available_width() - gaps) / count).max(NARROWEST);
    ui.horizontal_wrapped(|ui| {
        for (name, shows) in &finding.pictures {
            let file = project.join(CHECKED).join(name);
            let alt = given.words(shows).to_owned();
            ui.vertical(|ui| {
                ui.set_width(width);
                picture(&file, &alt, width, ui, given);
            });
        }
    });
}

fn picture(file: &Path, alt: &str, width: f32, ui: &mut Ui, given: &mut Given) {
    match given.panel.pictures.of_file(ui.ctx(), file) {
        Ok(drawn) => {
            let size = drawn.size * (width / drawn.size.x);
            let image = Image::new(&drawn.texture).fit_to_exact_size(size);
            let button = ui.add(egui::Button::image(image).frame(false));
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, alt));
            let about = given.say(message!("lesson.larger"), message!("lesson.larger_es"));
            if button.on_hover_text(about).clicked() {
                given.panel.large = Some((file.to_owned(), alt.to_owned()));
            }
        }
        Err(why) => {
            let gone = given.say(
                message!("lesson.no_picture"),
                message!("lesson.no_picture_es"),
            );
            ui.weak(gone).on_hover_text(why);
        }
    }
    ui.label(RichText::new(alt).small().weak());
}

/// The picture that somebody wants to see large.
pub(super) fn large(ctx: &Context, given: &mut Given) {
    let Some((file, alt)) = given.panel.large.clone() else {
        return;
    };
    let Ok(shown) = given.panel.pictures.of_file(ctx, &file) else {
        given.panel.large = None;
        return;
    };
    let space = ctx.content_rect().size() - egui::vec2(80.0, 140.0);
    let scale = (space.x / shown.size.x)
        .min(space.y / shown.size.y)
        .clamp(0.1, 4.0);
    let modal = Modal::new(Id::unique("picture of a check")).show(ctx, |ui| {
        let image = Image::new(&shown.texture).alt_text(&alt);
        ui.add(image.fit_to_exact_size(shown.size * scale));
        ui.horizontal(|ui| {
            ui.label(&alt);
            let close = given.say(message!("lesson.close"), message!("lesson.close_es"));
            ui.button(close).clicked()
        })
        .inner
    });
    if modal.inner || modal.should_close() {
        given.panel.large = None;
    }
}

/// The link to a place of the text.
fn read(place: &str, ui: &mut Ui, given: &mut Given) {
    let text = given.say(message!("lesson.read"), message!("lesson.read_es"));
    let title = given.titles.get(place).map_or(place, String::as_str);
    let link = ui.link(RichText::new(format!("{text}: {title}")).small());
    if link.clicked() {
        *given.wish = Some(Wish::Read(place.to_owned()));
    }
}

/// A question, with fields for its answer.
fn asked(open: &mut Open, question: &Question, ui: &mut Ui, given: &mut Given) {
    let outcome = open.outcome.as_ref();
    let outcome = outcome
        .and_then(|(outcome, _)| outcome.task(&question.id))
        .cloned();
    let title = given.say(message!("lesson.question"), message!("lesson.question_es"));
    heading(title, outcome.as_ref(), question.points, ui, given);
    ui.label(shown(ui, given.words(&question.asks), BODY, |text| text));
    read(&question.read, ui, given);
    if open.begun.is_some() {
        answer(open, question, ui, given);
    }
    let Some(outcome) = outcome else {
        return;
    };
    if let Some(refusal) = &outcome.refusal {
        refused(refusal, &question.read, ui, given);
    }
    for judged in &outcome.criteria {
        for told in judged.findings.iter().filter(|finding| !finding.holds) {
            finding(told, &question.read, ui, given);
        }
    }
}

fn answer(open: &mut Open, question: &Question, ui: &mut Ui, given: &mut Given) {
    let reports = open.reports.clone();
    let typed = open.typed.entry(question.id.clone()).or_default();
    ui.horizontal_wrapped(|ui| {
        let label = given.say(message!("lesson.answer"), message!("lesson.answer_es"));
        let label = ui.label(label);
        let field = TextEdit::singleline(&mut typed.value).desired_width(90.0);
        ui.add(field).labelled_by(label.id);
        if !question.unit.is_empty() {
            ui.label(&question.unit);
        }
    });
    ui.horizontal_wrapped(|ui| {
        let label = given.say(message!("lesson.report"), message!("lesson.report_es"));
        let label = ui.label(label);
        let field = TextEdit::singleline(&mut typed.report).desired_width(200.0);
        ui.add(field).labelled_by(label.id);
        if !reports.is_empty() {
            let choose = given.say(message!("lesson.reports"), message!("lesson.reports_es"));
            let combo = ComboBox::from_id_salt("reports").selected_text(choose);
            let combo = combo.show_ui(ui, |ui| {
                for report in &reports {
                    let chosen = typed.report == *report;
                    if ui.selectable_label(chosen, report).clicked() {
                        typed.report.clone_from(report);
                    }
                }
            });
            let name = || egui::WidgetInfo::labeled(egui::Role::ComboBox, true, choose);
            combo.response.widget_info(name);
        }
        let write = given.say(message!("lesson.write"), message!("lesson.write_es"));
        let can = !typed.value.trim().is_empty() && !typed.report.trim().is_empty();
        if ui.add_enabled(can, egui::Button::new(write)).clicked() {
            *given.wish = Some(Wish::Answer(question.id.clone()));
        }
    });
    match &open.answered {
        Some(Ok(())) => {
            let written = given.say(message!("lesson.written"), message!("lesson.written_es"));
            ui.weak(written);
        }
        Some(Err(why)) => _ = ui.label(RichText::new(why).color(Palette::of(ui).error)),
        None => {}
    }
}

/// The colour of what is right: of enough contrast on either ground (WCAG 2.2, 1.4.3).
fn right(ui: &Ui) -> Color32 {
    match ui.visuals().dark_mode {
        true => Color32::from_rgb(110, 190, 120),
        false => Color32::from_rgb(25, 105, 45),
    }
}
