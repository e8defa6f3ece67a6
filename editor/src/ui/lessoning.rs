//! What the editor does with lessons.

use std::path::Path;

use lightbench::assets::files::Files;
use lightbench::lab::lesson::{Language, begin, lesson_of};

use super::code::{Leaving, Spot};
use super::editor::Editor;
use super::kept::{Kept, KeptLessons};
use super::layout::Panel;
use super::lesson::Lessons;
use super::lesson::checking::Order;
use super::lesson::places::{Leads, follow};
use super::messages::say;

/// Lessons as they were when the program ended.
pub(super) fn kept_lessons(kept: &Kept, files: &Files) -> Lessons {
    let KeptLessons {
        language,
        open,
        student,
    } = &kept.lessons;
    let mut lessons = Lessons::default();
    let known = Language::ALL.iter().find(|(code, _)| code == language);
    lessons.language = known.map_or(Language::default(), |(_, language)| *language);
    lessons.beginning.student.clone_from(student);
    if !open.is_empty() {
        lessons.open(files, open);
    }
    lessons
}

impl Editor {
    /// Opens a lesson in its panel.
    pub fn open_lesson(&mut self, name: &str) {
        self.lessons.open(self.workbench.files(), name);
        self.reveal(Panel::Lesson);
    }

    /// Takes in what happened: another project, or the end of a check.
    pub(super) fn tend_lessons(&mut self) {
        let files = self.workbench.files();
        let begun = self.lessons.follow(files);
        self.lessons.take_outcome(files);
        if begun.is_some() {
            self.reveal(Panel::Lesson);
        }
        let open = self.lessons.open.as_ref();
        let now = KeptLessons {
            language: match self.lessons.language {
                Language::English => String::new(),
                other => other.code().to_owned(),
            },
            open: open.map_or(String::new(), |open| open.asked.clone()),
            student: self.kept.lessons.student.clone(),
        };
        if let Err(error) = self.kept.remember_lessons(now) {
            self.workbench.log.warn(error);
        }
    }

    /// Makes a project with the starter of the lesson, as it was asked for, and goes on there.
    pub(super) fn begin_lesson(&mut self) {
        let Some(open) = &self.lessons.open else {
            return;
        };
        let beginning = &self.lessons.beginning;
        let student = Some(beginning.student.trim()).filter(|student| !student.is_empty());
        let student = student.map(str::to_owned);
        let folder = std::path::absolute(beginning.folder.trim());
        let begun = folder
            .map_err(|error| error.to_string())
            .and_then(|folder| {
                let begun = begin(
                    &open.lesson,
                    student.as_deref(),
                    self.lessons.language,
                    &folder,
                );
                begun.map_err(|error| error.to_string())
            });
        let done = begun.and_then(|project| {
            let kept = KeptLessons {
                student: student.unwrap_or_default(),
                ..self.kept.lessons.clone()
            };
            if let Err(error) = self.kept.remember_lessons(kept) {
                self.workbench.log.warn(error);
            }
            if self.has_something_to_lose() {
                self.code.leaving = Some(Leaving::Project(project));
                return Ok(());
            }
            self.try_to_open_project(&project, false)
        });
        self.lessons.beginning.why_not = done.err();
    }

    /// Shows the scene and the pipeline of the lesson that the project was begun from.
    pub(super) fn show_scene_of_lesson(&mut self) {
        let files = self.workbench.files().clone();
        self.lessons.follow(&files);
        let begun = files.project().and_then(lesson_of);
        let open = self.lessons.open.as_ref();
        let Some(open) = open.filter(|open| begun.is_some() && open.begun == begun) else {
            return;
        };
        let about = &open.lesson.about;
        self.workbench.select_scene(&about.scene);
        self.workbench.select_pipeline(&about.pipeline);
        self.reveal(Panel::Lesson);
    }

    /// Saves what is open and checks the lesson that the project was begun from.
    pub fn check_lesson(&mut self) {
        self.reveal(Panel::Lesson);
        let project = self.workbench.files().project().map(Path::to_owned);
        let begun = self
            .lessons
            .open
            .as_ref()
            .filter(|open| open.begun.is_some());
        let (Some(_), Some(project)) = (begun, project) else {
            self.lessons.checking.why_not = Some(say!("lesson.nothing_to_check").to_owned());
            return;
        };
        let order = Order {
            project,
            language: self.lessons.language,
            gpu: self.workbench.gpu_options().clone(),
            worker: self.workbench.worker().clone(),
        };
        if !self.save_all_files() {
            self.reveal(Panel::Code);
            return;
        }
        self.lessons
            .checking
            .begin(order, self.workbench.wake().clone());
    }

    /// Shows what a link of the text leads to.
    pub(super) fn follow_link(&mut self, link: &str, ctx: &egui::Context) {
        let Some(open) = &self.lessons.open else {
            return;
        };
        let files = self.workbench.files();
        match follow(link, &open.lesson, open.begun.is_some(), files) {
            Leads::Place(place) => self.lessons.read(&place),
            Leads::Address(address) => ctx.open_url(egui::OpenUrl::new_tab(address)),
            Leads::File(path, line) => {
                let spot = line.map(|line| Spot { line, column: 1 });
                self.open_code(&path, spot);
            }
            Leads::Nowhere(why) => {
                self.workbench.log.error(why);
                self.reveal(Panel::Log);
            }
        }
    }
}
