//! A lesson beside the picture: its text, its tasks with what a check found, and parameters.

mod begin;
pub mod shelf;
mod tasks;
mod text;

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{ProgressBar, RichText, ScrollArea, Ui};
use lightbench::lab::lesson::{Language, Words};

use crate::ui::editor::Editor;
use crate::ui::lesson::letters::{parts, shown};
use crate::ui::lesson::pictures::Pictures;
use crate::ui::lesson::{Lessons, Open, Page};
use crate::ui::messages::{self, message};
use crate::ui::panels::parameters;
use crate::ui::theme::Palette;

/// What the panel remembers from frame to frame.
#[derive(Default)]
pub struct LessonPanel {
    /// Pictures of the text and of checks.
    pub pictures: Pictures,
    /// A picture of a check that is shown large: its file and what it shows.
    large: Option<(std::path::PathBuf, String)>,
}

/// What was asked for in a frame.
enum Wish {
    Open(String),
    Close,
    Speak(Language),
    Begin,
    ChooseFolder,
    Check,
    Cancel,
    Follow(String),
    Read(String),
    Answer(String),
}

/// What the parts of the panel are given.
struct Given<'a> {
    panel: &'a mut LessonPanel,
    language: Language,
    project: Option<std::path::PathBuf>,
    /// The titles of the places in the text.
    titles: Arc<BTreeMap<String, String>>,
    wish: &'a mut Option<Wish>,
}

impl Given<'_> {
    fn words<'a>(&self, words: &'a Words) -> &'a str {
        words.in_language(self.language)
    }

    /// The message of the panel's language.
    fn say(&self, english: &'static str, spanish: &'static str) -> &'static str {
        say_in(self.language, english, spanish)
    }
}

/// One of two messages: students read the whole panel in the language of the lesson.
fn say_in(language: Language, english: &'static str, spanish: &'static str) -> &'static str {
    messages::text(match language {
        Language::English => english,
        Language::Spanish => spanish,
    })
}

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let mut lessons = std::mem::take(&mut editor.lessons);
    let mut panel = std::mem::take(&mut editor.lesson_panel);
    let mut wish = None;
    let files = editor.workbench.files().clone();
    let mut given = Given {
        panel: &mut panel,
        language: lessons.language,
        project: files.project().map(std::path::Path::to_owned),
        titles: lessons
            .open
            .as_ref()
            .map(|open| Arc::clone(&open.titles))
            .unwrap_or_default(),
        wish: &mut wish,
    };
    top(&lessons, ui, &mut given);
    ui.separator();
    if let Some(why) = &lessons.why_not {
        ui.label(RichText::new(why).color(Palette::of(ui).error));
    }
    match lessons.open.take() {
        None => begin::list(&mut lessons, ui, &files, &mut given),
        Some(mut open) => {
            page(editor, &mut lessons, &mut open, ui, &mut given);
            lessons.open = Some(open);
        }
    }
    tasks::large(ui.ctx(), &mut given);
    editor.lessons = lessons;
    editor.lesson_panel = panel;
    if let Some(wish) = wish {
        fulfil(editor, wish, ui.ctx());
    }
}

/// The title, the points, the check and the language.
fn top(lessons: &Lessons, ui: &mut Ui, given: &mut Given) {
    ui.horizontal_wrapped(|ui| {
        if let Some(open) = &lessons.open {
            let back = given.say(message!("lesson.all"), message!("lesson.all_es"));
            if ui.button(back).clicked() {
                *given.wish = Some(Wish::Close);
            }
            let title = given.words(&open.lesson.about.title);
            ui.label(shown(ui, title, text::BODY, RichText::strong));
            ui.label(points_so_far(open, given));
        }
        for (code, language) in Language::ALL {
            let name = match language {
                Language::English => "English",
                Language::Spanish => "Español",
            };
            let label = ui.selectable_label(given.language == language, code.to_uppercase());
            label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
            if label.on_hover_text(name).clicked() {
                *given.wish = Some(Wish::Speak(language));
            }
        }
    });
    if lessons
        .open
        .as_ref()
        .is_some_and(|open| open.begun.is_some())
    {
        check(lessons, ui, given);
    }
    if let Some(why) = &lessons.checking.why_not {
        let none = given.say(message!("lesson.no_check"), message!("lesson.no_check_es"));
        let text = format!("{none} {why}");
        ui.label(RichText::new(text).color(Palette::of(ui).error));
    }
}

/// The button that checks, or how far the check is.
fn check(lessons: &Lessons, ui: &mut Ui, given: &mut Given) {
    ui.horizontal_wrapped(|ui| match lessons.checking.progress() {
        Some((fraction, title)) => {
            let stop = given.say(message!("lesson.stop"), message!("lesson.stop_es"));
            if ui.button(stop).clicked() {
                *given.wish = Some(Wish::Cancel);
            }
            let text = match title.is_empty() {
                true => given.say(message!("lesson.starts"), message!("lesson.starts_es")),
                false => &plain(&title),
            };
            let bar = ProgressBar::new(fraction).text(text);
            ui.add(bar.desired_width(ui.available_width().max(120.0)));
        }
        None => {
            let check = given.say(message!("lesson.check"), message!("lesson.check_es"));
            let about = given.say(
                message!("lesson.check_about"),
                message!("lesson.check_about_es"),
            );
            if ui.button(check).on_hover_text(about).clicked() {
                *given.wish = Some(Wish::Check);
            }
        }
    });
}

/// A text with all letters on the line, where no others can be shown.
fn plain(text: &str) -> String {
    parts(text).into_iter().map(|(part, _)| part).collect()
}

/// `7 of 18 points`, or all that there are where nothing was checked.
fn points_so_far(open: &Open, given: &Given) -> String {
    let (points, of) = match &open.outcome {
        Some((outcome, _)) => (Some(outcome.points), outcome.of),
        None => (None, open.lesson.about.points()),
    };
    let word = given.say(message!("lesson.points"), message!("lesson.points_es"));
    match points {
        Some(points) => format!("{} {word}", of_all(points, of, given)),
        None => format!("{of} {word}"),
    }
}

/// `2 of 3`.
fn of_all(points: u32, of: u32, given: &Given) -> String {
    let word = given.say(message!("lesson.of"), message!("lesson.of_es"));
    format!("{points} {word} {of}")
}

fn page(
    editor: &mut Editor,
    lessons: &mut Lessons,
    open: &mut Open,
    ui: &mut Ui,
    given: &mut Given,
) {
    ui.horizontal(|ui| {
        let pages = [
            (
                Page::Text,
                message!("lesson.text"),
                message!("lesson.text_es"),
            ),
            (
                Page::Tasks,
                message!("lesson.tasks"),
                message!("lesson.tasks_es"),
            ),
            (
                Page::Parameters,
                message!("lesson.parameters"),
                message!("lesson.parameters_es"),
            ),
        ];
        for (page, english, spanish) in pages {
            let title = given.say(english, spanish);
            if ui.selectable_label(lessons.page == page, title).clicked() {
                lessons.page = page;
            }
        }
    });
    if open.begun.is_none() {
        begin::begin(&mut lessons.beginning, open, ui, given);
    }
    let area = ScrollArea::vertical().auto_shrink(false);
    match lessons.page {
        Page::Text => {
            let going = &mut lessons.going;
            // Each language and lesson has its own place.
            let salt = (&open.lesson.name, given.language.code());
            area.id_salt(salt)
                .show(ui, |ui| text::show(open, going, ui, given));
        }
        Page::Tasks => {
            area.id_salt("tasks")
                .show(ui, |ui| tasks::show(open, ui, given));
        }
        Page::Parameters => both_parameters(editor, ui, given),
    }
}

/// Parameters of the scene, and below them those of the pipeline.
fn both_parameters(editor: &mut Editor, ui: &mut Ui, given: &Given) {
    let half = (ui.available_height() / 2.0 - 30.0).max(80.0);
    let titles = [
        given.say(message!("lesson.of_scene"), message!("lesson.of_scene_es")),
        given.say(
            message!("lesson.of_pipeline"),
            message!("lesson.of_pipeline_es"),
        ),
    ];
    let parts: [fn(&mut Editor, &mut Ui); 2] = [parameters::scene, parameters::pipeline];
    for (title, part) in titles.into_iter().zip(parts) {
        ui.label(RichText::new(title).strong());
        ui.push_id(title, |ui| {
            let size = egui::vec2(ui.available_width(), half);
            let down = egui::Layout::top_down(egui::Align::Min);
            ui.allocate_ui_with_layout(size, down, |ui| part(editor, ui));
        });
    }
}

fn fulfil(editor: &mut Editor, wish: Wish, ctx: &egui::Context) {
    match wish {
        Wish::Open(name) => editor.open_lesson(&name),
        Wish::Close => editor.lessons.close(),
        Wish::Speak(language) => editor.lessons.speak(language),
        Wish::Begin => editor.begin_lesson(),
        Wish::ChooseFolder => editor.ask_for(crate::ui::dialogs::Question::Lesson),
        Wish::Check => editor.check_lesson(),
        Wish::Cancel => editor.lessons.checking.cancel(),
        Wish::Follow(link) => editor.follow_link(&link, ctx),
        Wish::Read(place) => editor.lessons.read(&place),
        Wish::Answer(question) => {
            let project = editor
                .workbench
                .files()
                .project()
                .map(std::path::Path::to_owned);
            if let (Some(open), Some(project)) = (&mut editor.lessons.open, project) {
                open.answer(&project, &question);
            }
        }
    }
    ctx.request_repaint();
}
