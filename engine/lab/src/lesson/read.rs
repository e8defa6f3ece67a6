//! Reading a lesson, and holding its parts together.

use std::collections::BTreeSet;

use lightbench_assets::files::{FileError, check as check_path};
use lightbench_render::{Place, Problem, Problems};

use super::model::{About, LESSON_FILE};
use super::source::Source;
use super::text::{Text, text_file};
use super::words::{Language, Words};

/// The file with the checks that a student has.
pub const CHECKS: &str = "checks.rhai";
/// The folder with the files of a project that a student begins with.
pub const STARTER: &str = "starter";
/// The folder with the files of a project that checks need, over those of the student.
pub const CHECK_FILES: &str = "checks";
/// The folder with files that solve all tasks. It is not in a student's pack, nor in the program.
pub const SOLUTION: &str = "solution";
/// The folder with checks that students do not have, made as the lesson's own: a file `checks.rhai`,
/// and a folder `checks`.
pub const HIDDEN: &str = "hidden";

/// A lesson that was read and holds together.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The name of its folder, as `01-first-light`.
    pub name: String,
    /// What its file says.
    pub about: About,
    /// Its files.
    pub source: Source,
}

impl Lesson {
    /// Reads a lesson.
    ///
    /// # Errors
    /// All that is wrong with its file, or the first thing that keeps it from being read, each with
    /// the file and the line.
    pub fn read(name: &str, source: Source) -> Result<Self, Problems> {
        let path = source.shown(LESSON_FILE);
        let text = source.read_text(LESSON_FILE);
        let text = text.map_err(|error| problem_of(&path, &error))?;
        let about: About = toml::from_str(&text).map_err(|error| {
            let before = &text[..error.span().map_or(0, |span| span.start).min(text.len())];
            let line = before.matches('\n').count() as u32 + 1;
            let column = before.rsplit('\n').next().unwrap_or("").chars().count() as u32 + 1;
            Problem::new(Place::new(path.as_str(), line, column), error.message())
                .with_source(&text)
        })?;
        let lesson = Self {
            name: name.to_owned(),
            about,
            source,
        };
        let problems = Reader {
            lesson: &lesson,
            path: &path,
            text: &text,
            problems: Vec::new(),
        }
        .check();
        match problems.is_empty() {
            true => Ok(lesson),
            false => Err(Problems(problems)),
        }
    }

    /// Its text in a language.
    ///
    /// # Errors
    /// A text that is not there or can't be read.
    pub fn text(&self, language: Language) -> Result<Text, FileError> {
        let file = text_file(language);
        Ok(Text::new(&file, self.source.read_text(&file)?))
    }
}

fn problem_of(path: &str, error: &FileError) -> Problem {
    let problem = Problem::new(Place::file(path), error.to_string());
    problem.with_hint("`lightbench new lesson NAME` makes a lesson that has all of its files")
}

/// Looks for what is wrong in a lesson's file.
struct Reader<'a> {
    lesson: &'a Lesson,
    path: &'a str,
    text: &'a str,
    problems: Vec<Problem>,
}

impl Reader<'_> {
    fn check(mut self) -> Vec<Problem> {
        self.about();
        self.constants();
        self.names();
        self.points();
        self.files();
        self.places();
        self.problems
    }

    /// Notes a problem at the line that holds a text in quotes.
    fn wrong(&mut self, quoted: &str, message: impl Into<String>, hint: Option<&str>) {
        let needle = format!("\"{quoted}\"");
        let line = self.text.lines().position(|line| line.contains(&needle));
        let line = line.filter(|_| !quoted.is_empty());
        let line = line.map_or(0, |line| line as u32 + 1);
        let mut problem =
            Problem::new(Place::new(self.path, line, 0), message).with_source(self.text);
        problem.hint = hint.map(str::to_owned);
        self.problems.push(problem);
    }

    fn about(&mut self) {
        let about = &self.lesson.about;
        let number = self
            .lesson
            .name
            .split('-')
            .next()
            .and_then(|number| number.parse().ok());
        if number != Some(about.order) {
            let message = format!(
                "the order is {}, but the folder is called `{}`",
                about.order, self.lesson.name
            );
            let hint = format!("call it `{:02}-` and a name", about.order);
            self.wrong("", message, Some(&hint));
        }
        let mut incomplete: Vec<(&str, &Words)> = vec![("the lesson", &about.title)];
        incomplete.extend(about.constants.iter().map(|c| (c.name.as_str(), &c.title)));
        incomplete.extend(
            about
                .tasks
                .iter()
                .map(|task| (task.id.as_str(), &task.title)),
        );
        let criteria = about.tasks.iter().flat_map(|task| &task.criteria);
        incomplete.extend(criteria.map(|c| (c.id.as_str(), &c.says)));
        incomplete.extend(about.questions.iter().map(|q| (q.id.as_str(), &q.asks)));
        incomplete.extend(about.mistakes.iter().map(|m| (m.id.as_str(), &m.says)));
        for (name, words) in incomplete {
            if words.is_incomplete() {
                self.wrong(
                    name,
                    format!("`{name}` lacks its words in English or in Spanish"),
                    None,
                );
            }
        }
    }

    fn constants(&mut self) {
        for constant in &self.lesson.about.constants {
            let numbers = [constant.from, constant.to, constant.step, constant.default];
            let right = numbers.iter().all(|number| number.is_finite())
                && constant.from <= constant.to
                && constant.step > 0.0
                && constant.steps() < 1_000_000_000;
            if !right {
                let message = format!(
                    "`{}` must go `from` a number `to` one that is not less, in a `step` above 0",
                    constant.name
                );
                self.wrong(&constant.name, message, None);
            }
        }
    }

    /// Each name once, of letters that functions may have.
    fn names(&mut self) {
        let about = &self.lesson.about;
        let criteria = about.tasks.iter().flat_map(|task| &task.criteria);
        let groups: [(&str, Vec<&str>); 4] = [
            (
                "task",
                about.tasks.iter().map(|task| task.id.as_str()).collect(),
            ),
            (
                "question",
                about.questions.iter().map(|q| q.id.as_str()).collect(),
            ),
            ("criterion", criteria.map(|c| c.id.as_str()).collect()),
            (
                "mistake",
                about.mistakes.iter().map(|m| m.id.as_str()).collect(),
            ),
        ];
        for (what, names) in groups {
            let mut seen = BTreeSet::new();
            for name in names {
                let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
                if name.is_empty() || !name.chars().all(plain) {
                    let hint = "small letters, digits and `_` can be in it";
                    self.wrong(
                        name,
                        format!("`{name}` can't be the name of a {what}"),
                        Some(hint),
                    );
                }
                if !seen.insert(name) {
                    self.wrong(name, format!("there are two {what}s `{name}`"), None);
                }
            }
        }
        if about.tasks.is_empty() {
            self.wrong(
                "",
                "a lesson has at least one task",
                Some("write a table `[[task]]`"),
            );
        }
    }

    fn points(&mut self) {
        let about = &self.lesson.about;
        let criteria = about.tasks.iter().flat_map(|task| &task.criteria);
        let given = criteria.map(|criterion| (criterion.id.as_str(), criterion.points));
        let asked = about.questions.iter().map(|q| (q.id.as_str(), q.points));
        for (name, points) in given.chain(asked) {
            if points == 0 || points > 1000 {
                self.wrong(
                    name,
                    format!("`{name}` must give from 1 to 1000 points"),
                    None,
                );
            }
        }
        for question in &about.questions {
            if !(0.0..1.0).contains(&question.tolerance) {
                let message = format!(
                    "the tolerance of `{}` must be a share from 0 to 1, as 0.01",
                    question.id
                );
                self.wrong(&question.id, message, None);
            }
        }
    }

    fn files(&mut self) {
        let (about, source) = (&self.lesson.about, &self.lesson.source);
        for file in [CHECKS.to_owned()]
            .into_iter()
            .chain(Language::ALL.map(|(_, language)| text_file(language)))
        {
            if let Err(error) = source.read_text(&file) {
                self.problems.push(problem_of(&source.shown(&file), &error));
            }
        }
        for path in &about.submits {
            if let Err(error) = check_path(path) {
                self.wrong(path, error.to_string(), None);
            } else if !source.has(&format!("{STARTER}/{path}")) {
                let message =
                    format!("`{path}` is to be handed in, but the folder `{STARTER}` lacks it");
                self.wrong(
                    path,
                    message,
                    Some("put a file there that runs and solves nothing"),
                );
            }
        }
        for task in &about.tasks {
            for path in task
                .files
                .iter()
                .filter(|path| !about.submits.contains(path))
            {
                let message = format!("`{path}` of the task `{}` is not in `submits`", task.id);
                self.wrong(path, message, None);
            }
            if task.files.is_empty() {
                self.wrong(
                    &task.id,
                    format!("the task `{}` is about no file", task.id),
                    None,
                );
            }
        }
    }

    /// The places in the texts that are named.
    fn places(&mut self) {
        let about = &self.lesson.about;
        let mut named: Vec<(&str, &str)> = Vec::new();
        for task in &about.tasks {
            named.push((&task.id, &task.read));
            let criteria = task.criteria.iter();
            named.extend(criteria.filter_map(|c| Some((c.id.as_str(), c.read.as_deref()?))));
        }
        named.extend(
            about
                .questions
                .iter()
                .map(|q| (q.id.as_str(), q.read.as_str())),
        );
        let mistakes = about.mistakes.iter();
        named.extend(mistakes.filter_map(|m| Some((m.id.as_str(), m.read.as_deref()?))));
        for (_, language) in Language::ALL {
            // A text that is missing was told already.
            let Ok(text) = self.lesson.text(language) else {
                continue;
            };
            let places = text.places();
            for (name, place) in &named {
                if !places.contains(*place) {
                    let hint = format!(
                        "write `<a id=\"{place}\"></a>` before a heading of {}",
                        text.file
                    );
                    let message = format!(
                        "`{name}` names the place `{place}`, which {} lacks",
                        text.file
                    );
                    self.wrong(name, message, Some(&hint));
                }
            }
        }
    }
}
