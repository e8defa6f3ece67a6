//! Lessons in the editor, without a widget in it: which one is open, its text, what a check found, and
//! what is typed to begin one or to answer its questions.

pub mod checking;
pub mod letters;
pub mod pictures;
pub mod places;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use lightbench::assets::files::{Files, write_atomic};
use lightbench::lab::lesson::{
    ANSWERS, Answer, Block, Language, Lesson, LessonOf, Outcome, Words, find_lesson, lesson_of,
    list_lessons, read_answers, read_document, write_answer,
};

use checking::Checking;

use crate::ui::messages::say;

/// The folder of what a check wrote, in a project.
pub const CHECKED: &str = "out/check";
/// What the last check found.
const OUTCOME: &str = "outcome.json";

/// A part of the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Page {
    /// The text.
    #[default]
    Text,
    /// The tasks, and what a check found of them.
    Tasks,
    /// Parameters of the scene and of the pipeline.
    Parameters,
}

/// A lesson of the list.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Its name.
    pub name: String,
    /// Its title, or what is wrong with it.
    pub title: Result<Words, String>,
    /// The points that it gives.
    pub points: u32,
    /// The lesson, if nothing is wrong with it.
    pub lesson: Option<Lesson>,
}

/// What is typed to begin a lesson.
#[derive(Clone, Debug, Default)]
pub struct Beginning {
    /// The folder of the new project.
    pub folder: String,
    /// The student; may be empty.
    pub student: String,
    /// Why it was not begun.
    pub why_not: Option<String>,
}

/// What is typed as an answer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Typed {
    /// The number.
    pub value: String,
    /// The report, by its path in the project.
    pub report: String,
}

/// A lesson that is open.
pub struct Open {
    /// The lesson.
    pub lesson: Lesson,
    /// What it was found by: its name, or its folder.
    pub asked: String,
    /// What the project says, if it was begun from this lesson.
    pub begun: Option<LessonOf>,
    /// The text.
    pub text: Vec<Block>,
    /// The titles of its places.
    pub titles: Arc<BTreeMap<String, String>>,
    /// Why there is no text.
    pub no_text: Option<String>,
    /// What the last check found, and when.
    pub outcome: Option<(Outcome, SystemTime)>,
    /// What is typed as answers, by the names of the questions.
    pub typed: BTreeMap<String, Typed>,
    /// What came of writing the last answer.
    pub answered: Option<Result<(), String>>,
    /// The reports of the project.
    pub reports: Vec<String>,
}

/// The lessons that can be opened, and the one that is.
#[derive(Default)]
pub struct Lessons {
    /// The language of the panel.
    pub language: Language,
    /// What is shown of the lesson.
    pub page: Page,
    /// A place of the text to go to.
    pub going: Option<String>,
    /// The lesson that is open.
    pub open: Option<Open>,
    /// Why the lesson that was asked for is not open.
    pub why_not: Option<String>,
    /// What is typed to begin it.
    pub beginning: Beginning,
    /// The check.
    pub checking: Checking,
    list: Option<Vec<Listed>>,
    /// The project that was looked at last.
    project: Option<PathBuf>,
}

impl Lessons {
    /// All lessons of the project and the program.
    pub fn list(&mut self, files: &Files) -> &[Listed] {
        self.list.get_or_insert_with(|| {
            let names = list_lessons(files).unwrap_or_default();
            names.into_iter().map(|name| listed(files, name)).collect()
        })
    }

    /// Those of the list, as far as it was read.
    pub fn known(&self) -> &[Listed] {
        self.list.as_deref().unwrap_or_default()
    }

    /// Opens a lesson.
    pub fn open(&mut self, files: &Files, name: &str) {
        let lesson = match find_lesson(files, name) {
            Ok(lesson) => lesson,
            Err(problems) => {
                self.open = None;
                self.why_not = Some(problems.to_string());
                return;
            }
        };
        self.why_not = None;
        let begun = files.project().and_then(lesson_of);
        let begun = begun.filter(|begun| begun.name == lesson.name);
        if self
            .open
            .as_ref()
            .is_none_or(|open| open.lesson.name != lesson.name)
        {
            self.page = Page::Text;
            self.beginning.folder.clear();
        }
        self.beginning.why_not = None;
        let mut open = Open {
            text: Vec::new(),
            titles: Arc::default(),
            no_text: None,
            outcome: None,
            typed: BTreeMap::new(),
            answered: None,
            reports: Vec::new(),
            asked: name.to_owned(),
            lesson,
            begun,
        };
        open.read_text(self.language);
        if let Some(project) = files.project().filter(|_| open.begun.is_some()) {
            open.read_outcome(project);
            open.read_answers(files);
            open.list_reports(project);
        }
        if self.beginning.folder.is_empty() {
            self.beginning.folder = place_to_begin(files, &open.lesson.name);
        }
        self.open = Some(open);
    }

    /// Closes the lesson: the list is shown.
    pub fn close(&mut self) {
        self.open = None;
        self.why_not = None;
    }

    /// Goes to a place of the text.
    pub fn read(&mut self, place: &str) {
        self.page = Page::Text;
        self.going = Some(place.to_owned());
    }

    /// Goes on in another language.
    pub fn speak(&mut self, language: Language) {
        self.language = language;
        if let Some(open) = &mut self.open {
            open.read_text(language);
        }
    }

    /// Looks whether the project is another one than before. Returns the lesson that it was begun from.
    pub fn follow(&mut self, files: &Files) -> Option<LessonOf> {
        if self.project.as_deref() == files.project() {
            return None;
        }
        self.project = files.project().map(Path::to_owned);
        self.list = None;
        self.checking.forget();
        let begun = files.project().and_then(lesson_of);
        // What was open may be begun now, or no longer.
        let name = begun.as_ref().map(|begun| begun.asked().to_owned());
        let name = name.or_else(|| Some(self.open.as_ref()?.asked.clone()));
        if let Some(name) = name {
            self.open(files, &name);
        }
        begun
    }

    /// Takes in files of the project that changed.
    pub fn changed(&mut self, files: &Files, paths: Option<&[String]>) {
        let is_ours = |begins: &str| {
            paths.is_none_or(|paths| paths.iter().any(|path| path.starts_with(begins)))
        };
        if is_ours("lessons/") {
            self.list = None;
            if let Some(name) = self.open.as_ref().map(|open| open.asked.clone()) {
                self.open(files, &name);
            }
        }
        let Some(open) = self.open.as_mut().filter(|open| open.begun.is_some()) else {
            return;
        };
        if is_ours(ANSWERS) {
            open.read_answers(files);
        }
        if let Some(project) = files.project().filter(|_| is_ours("reports/")) {
            open.list_reports(project);
        }
    }

    /// Takes in what a check found, when it is done.
    pub fn take_outcome(&mut self, files: &Files) {
        if !self.checking.poll() {
            return;
        }
        if let (Some(open), Some(project)) = (&mut self.open, files.project()) {
            open.read_outcome(project);
            self.page = Page::Tasks;
        }
    }
}

impl Open {
    fn read_text(&mut self, language: Language) {
        match self.lesson.text(language) {
            Ok(text) => {
                self.text = read_document(&text.markdown);
                let title =
                    |place: &str| Some((place.to_owned(), text.title_of(place)?.to_owned()));
                self.titles = Arc::new(text.places().into_iter().filter_map(title).collect());
                self.no_text = None;
            }
            Err(error) => {
                self.text.clear();
                self.no_text = Some(error.to_string());
            }
        }
    }

    fn read_outcome(&mut self, project: &Path) {
        self.outcome = None;
        let file = project.join(CHECKED).join(OUTCOME);
        let Ok(text) = std::fs::read_to_string(&file) else {
            return;
        };
        let written = std::fs::metadata(&file).and_then(|about| about.modified());
        // One that another version wrote may be of another form: the next check writes it anew.
        if let (Ok(outcome), Ok(written)) = (serde_json::from_str::<Outcome>(&text), written)
            && outcome.lesson == self.lesson.name
        {
            self.outcome = Some((outcome, written));
        }
    }

    /// Whether something that is handed in was changed since the last check.
    pub fn is_stale(&self, project: &Path) -> bool {
        let Some((_, checked)) = &self.outcome else {
            return false;
        };
        let submits = self.lesson.about.submits.iter().map(String::as_str);
        let mut times = submits.chain([ANSWERS]).filter_map(|path| {
            let about = std::fs::metadata(project.join(path)).ok()?;
            about.modified().ok()
        });
        times.any(|time| time > *checked)
    }

    fn read_answers(&mut self, files: &Files) {
        if self.lesson.about.questions.is_empty() {
            return;
        }
        match read_answers(files) {
            Ok(answers) => {
                self.answered = self.answered.take().filter(Result::is_ok);
                for question in &self.lesson.about.questions {
                    let typed = self.typed.entry(question.id.clone()).or_default();
                    if let Some(answer) = answers.get(&question.id) {
                        typed.value = answer.value.to_string();
                        typed.report.clone_from(&answer.report);
                    }
                }
            }
            Err(words) => self.answered = Some(Err(words.en)),
        }
    }

    fn list_reports(&mut self, project: &Path) {
        let folders = std::fs::read_dir(project.join("reports"));
        let names = folders.into_iter().flatten().flatten();
        let reports = names.filter_map(|folder| {
            let name = folder.file_name().into_string().ok()?;
            let report = folder.path().join("report.json");
            report
                .is_file()
                .then(|| format!("reports/{name}/report.json"))
        });
        self.reports = reports.collect();
        self.reports.sort();
    }

    /// Writes an answer into the project's file of answers. What came of it is in `answered`.
    pub fn answer(&mut self, project: &Path, question: &str) {
        let Some(typed) = self.typed.get(question) else {
            return;
        };
        let written = || {
            let number = typed.value.trim().replace(',', ".");
            let value = number.parse::<f64>().ok().filter(|value| value.is_finite());
            let value = value.ok_or_else(|| say!("lesson.no_number", typed = typed.value))?;
            let file = project.join(ANSWERS);
            let text = match std::fs::read_to_string(&file) {
                Ok(text) => text,
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
                Err(error) => return Err(format!("{}: {error}", file.display())),
            };
            let answer = Answer {
                value,
                report: typed.report.trim().to_owned(),
            };
            let text = write_answer(&text, question, &answer);
            write_atomic(&file, text.as_bytes()).map_err(|error| error.to_string())
        };
        self.answered = Some(written());
    }
}

fn listed(files: &Files, name: String) -> Listed {
    match find_lesson(files, &name) {
        Ok(lesson) => Listed {
            points: lesson.about.points(),
            title: Ok(lesson.about.title.clone()),
            name,
            lesson: Some(lesson),
        },
        Err(problems) => Listed {
            name,
            title: Err(problems.to_string()),
            points: 0,
            lesson: None,
        },
    }
}

/// A folder to begin a lesson in: beside the project, or where the program was started.
fn place_to_begin(files: &Files, name: &str) -> String {
    let beside = files.project().and_then(Path::parent).map(Path::to_owned);
    let folder = beside
        .or_else(|| std::env::current_dir().ok())
        .unwrap_or_default();
    let first = folder.join(name);
    let others = (2..).map(|number| folder.join(format!("{name}-{number}")));
    let mut all = std::iter::once(first).chain(others);
    let free = all.find(|folder| !folder.exists()).unwrap_or_default();
    free.to_string_lossy().into_owned()
}
