//! Folders made from lessons: a student's project, and the pack that a student gets.

use std::fs;
use std::path::{Path, PathBuf};

use lightbench_assets::files::{FileError, PROJECT_MARKER, create_project, write_atomic};
use serde::Deserialize;

use super::Lesson;
use super::answers::ANSWERS;
use super::model::Constant;
use super::print::{PrintError, print};
use super::read::{HIDDEN, SOLUTION, STARTER};
use super::words::{Language, number};

/// The lesson that a project was begun for.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct LessonOf {
    /// The name of the lesson.
    pub name: String,
    /// The student, if one was named.
    pub id: Option<String>,
    /// The lesson's folder, where it is none that the program brings along.
    pub folder: Option<PathBuf>,
}

impl LessonOf {
    /// What [`find_lesson`](super::find_lesson) finds the lesson by: its folder while that is there, else its
    /// name.
    #[must_use]
    pub fn asked(&self) -> &str {
        let folder = self.folder.as_deref().filter(|folder| folder.is_dir());
        folder.and_then(Path::to_str).unwrap_or(&self.name)
    }
}

#[derive(Deserialize)]
struct Marker {
    lesson: Option<LessonOf>,
}

/// The page with a lesson's text in a project that was made for it.
pub const LESSON_PAGE: &str = "lesson.html";

/// The lesson that a project says it is for.
#[must_use]
pub fn lesson_of(project: &Path) -> Option<LessonOf> {
    let text = fs::read_to_string(project.join(PROJECT_MARKER)).ok()?;
    let marker: Marker = toml::from_str(&text).ok()?;
    marker.lesson
}

/// Makes a project in a folder that is empty or not there yet, with the starter of a lesson and a
/// student's numbers in `README.md`, and the text as a page. Gives its full path.
///
/// # Errors
/// A folder with something in it, or one that can't be written; a text or a picture that can't be read.
pub fn begin(
    lesson: &Lesson,
    student: Option<&str>,
    language: Language,
    folder: &Path,
) -> Result<PathBuf, PrintError> {
    let project = create_project(folder)?;
    for path in lesson.source.list(STARTER)? {
        let bytes = lesson.source.read(&format!("{STARTER}/{path}"))?;
        let place = project.join(&path);
        if let Some(folder) = place.parent() {
            fs::create_dir_all(folder).map_err(|error| FileError::Io {
                path: folder.to_owned(),
                error,
            })?;
        }
        write_atomic(&place, &bytes)?;
    }
    write_atomic(
        project.join("README.md"),
        readme(lesson, student, language).as_bytes(),
    )?;
    // The text beside the work, for who has no other window to read it in.
    let page = print(lesson, language, student)?;
    write_atomic(project.join(LESSON_PAGE), page.as_bytes())?;
    if !lesson.about.questions.is_empty() {
        write_atomic(project.join(ANSWERS), answers(lesson, language).as_bytes())?;
    }
    let mut marker = format!(
        "# This file marks the top folder of a Lightbench project, and the lesson that it is for.\n\n\
         [lesson]\nname = {}\n",
        in_quotes(&lesson.name)
    );
    if let Some(student) = student {
        marker += &format!("id = {}\n", in_quotes(student));
    }
    let folder = lesson.source.folder();
    if let Some(folder) = folder.as_deref().and_then(Path::to_str) {
        marker += &format!("folder = {}\n", in_quotes(folder));
    }
    write_atomic(project.join(PROJECT_MARKER), marker.as_bytes())?;
    Ok(project)
}

/// A text as TOML writes it. What JSON escapes, TOML escapes in the same way (TOML 1.0, "String"), but for
/// the one character that JSON leaves as it is.
pub(super) fn in_quotes(text: &str) -> String {
    let quoted = serde_json::Value::from(text).to_string();
    quoted.replace('\u{7f}', "\\u007f")
}

fn readme(lesson: &Lesson, student: Option<&str>, language: Language) -> String {
    let about = &lesson.about;
    let spanish = language == Language::Spanish;
    let say = |en: &'static str, es: &'static str| if spanish { es } else { en };
    let mut text = format!("# {}\n\n", about.title.in_language(language));
    text += say(
        "The lesson itself is in `lesson.html`, and in the editor's panel \"Lesson\".\n\n",
        "La lección está en `lesson.html` y en el panel «Lesson» del editor.\n\n",
    );
    text += say("You hand in:\n\n", "Entregas:\n\n");
    for path in &about.submits {
        text += &format!("- `{path}`\n");
    }
    if !about.questions.is_empty() {
        text += &format!("- `{ANSWERS}`\n");
    }
    if !about.constants.is_empty() {
        text += &match student {
            Some(student) => format!(
                "\n{} `{student}`:\n\n",
                say("The numbers of", "Los números de")
            ),
            None => format!("\n{}:\n\n", say("The numbers", "Los números")),
        };
        for constant in &about.constants {
            text += &format!("- {}\n", told(constant, &lesson.name, student, language));
        }
    }
    text += say(
        "\nDraw your scene, and check what you have, in this folder:\n\n",
        "\nDibuja tu escena y comprueba lo que llevas, en esta carpeta:\n\n",
    );
    text += &format!(
        "```sh\nlightbench render {} --pipeline {} --out out/mine.png\nlightbench check\n```\n",
        about.scene, about.pipeline
    );
    text
}

fn told(constant: &Constant, lesson: &str, student: Option<&str>, language: Language) -> String {
    let value = number(constant.value(lesson, student));
    let unit = match constant.unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    format!("{}: {value}{unit}", constant.title.in_language(language))
}

/// The file of answers before anything is answered.
fn answers(lesson: &Lesson, language: Language) -> String {
    let mut text = String::new();
    for question in &lesson.about.questions {
        for line in question.asks.in_language(language).lines() {
            text += &format!("# {line}\n");
        }
        let unit = match question.unit.as_str() {
            "" => String::new(),
            unit => format!(" # {unit}"),
        };
        text += &format!(
            "# [{}]\n# value = 0.0{unit}\n# report = \"reports/{}/report.json\"\n\n",
            question.id, question.id
        );
    }
    text
}

/// Copies a lesson into a new folder without its solution and its hidden checks, as students get it.
/// Gives the folder.
///
/// # Errors
/// A folder that is there already, or that can't be written.
pub fn pack(lesson: &Lesson, folder: &Path) -> Result<PathBuf, FileError> {
    let out = folder.join(&lesson.name);
    if out.exists() {
        return Err(FileError::Exists { path: out });
    }
    let kept_back = |path: &str| {
        [SOLUTION, HIDDEN]
            .iter()
            .any(|folder| path.split('/').next() == Some(folder))
    };
    for path in lesson
        .source
        .list_all()?
        .iter()
        .filter(|path| !kept_back(path))
    {
        let place = out.join(path);
        if let Some(folder) = place.parent() {
            fs::create_dir_all(folder).map_err(|error| FileError::Io {
                path: folder.to_owned(),
                error,
            })?;
        }
        write_atomic(&place, &lesson.source.read(path)?)?;
    }
    Ok(out)
}
