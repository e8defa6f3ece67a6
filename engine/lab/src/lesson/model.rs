//! What a lesson is: what its file `lesson.toml` says.

use serde::Deserialize;

use super::words::Words;

/// The file that makes a folder a lesson.
pub const LESSON_FILE: &str = "lesson.toml";

/// A lesson as its author describes it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// Its title.
    pub title: Words,
    /// Its place in the course, which its folder's name begins with.
    pub order: u32,
    /// Under which licence its texts may be used, by its name in the SPDX list.
    pub licence: String,
    /// The scene that it is about: a name or a path, in its starter or shipped.
    pub scene: String,
    /// The pipeline that draws it.
    pub pipeline: String,
    /// The files that a student hands in, by their paths in the project.
    pub submits: Vec<String>,
    /// What these files may import: modules of shaders as `lightbench::scene`, scripts and files of
    /// shaders by their paths.
    #[serde(default)]
    pub imports: Vec<String>,
    /// Numbers that are drawn for each student.
    #[serde(default, rename = "constant")]
    pub constants: Vec<Constant>,
    /// What is to be done.
    #[serde(default, rename = "task")]
    pub tasks: Vec<Task>,
    /// What is to be measured.
    #[serde(default, rename = "question")]
    pub questions: Vec<Question>,
    /// Pictures of its text that are rendered from its solution.
    #[serde(default, rename = "figure")]
    pub figures: Vec<Figure>,
    /// Mistakes that students make, to be named where a check finds their trace.
    #[serde(default, rename = "mistake")]
    pub mistakes: Vec<KnownMistake>,
}

/// A number that is drawn for each student.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// Its name, for checks.
    pub name: String,
    /// What it is.
    pub title: Words,
    /// Its unit; may be empty.
    #[serde(default)]
    pub unit: String,
    /// The least that it can be.
    pub from: f64,
    /// The most that it can be.
    pub to: f64,
    /// The distance between two numbers that it can be.
    pub step: f64,
    /// What it is where no student is named.
    pub default: f64,
}

/// Something to be done, with what it is judged by.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// Its name. The checks have a function `check_` with it.
    pub id: String,
    /// Its title.
    pub title: Words,
    /// Those of the submitted files that it is about.
    pub files: Vec<String>,
    /// The place in the text that tells of it.
    pub read: String,
    /// What gives points.
    #[serde(rename = "criterion")]
    pub criteria: Vec<Criterion>,
}

impl Task {
    /// The points of all of its criteria.
    #[must_use]
    pub fn points(&self) -> u32 {
        self.criteria.iter().map(|criterion| criterion.points).sum()
    }

    /// The function that checks it.
    #[must_use]
    pub fn function(&self) -> String {
        format!("check_{}", self.id)
    }
}

/// Something that is right or not, and gives points if it is.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Criterion {
    /// Its name, for checks.
    pub id: String,
    /// How much it gives.
    pub points: u32,
    /// What must hold.
    pub says: Words,
    /// The place in the text to read again; that of the task, unless given.
    pub read: Option<String>,
}

/// A question whose answer is a number that the student measures.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// Its name. The checks have a function `answer_` with it, which gives the number.
    pub id: String,
    /// What the right answer gives.
    pub points: u32,
    /// What is asked.
    pub asks: Words,
    /// In which unit; may be empty.
    #[serde(default)]
    pub unit: String,
    /// How far the answer may be off, as a share of it: it is rounded.
    pub tolerance: f64,
    /// The place in the text to read again.
    pub read: String,
}

impl Question {
    /// The function that computes its answer.
    #[must_use]
    pub fn function(&self) -> String {
        format!("answer_{}", self.id)
    }
}

/// A picture of the text: the lesson's scene through its pipeline, with the solution.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// The file, below the lesson's folder.
    pub file: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Values of parameters of the scene, as `name=value`.
    #[serde(default)]
    pub set: Vec<String>,
}

/// A mistake with its explanation.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownMistake {
    /// Its name, for checks.
    pub id: String,
    /// What is said of it.
    pub says: Words,
    /// The place in the text to read again; that of the criterion, unless given.
    pub read: Option<String>,
}

impl About {
    /// The points of all tasks and questions.
    #[must_use]
    pub fn points(&self) -> u32 {
        let tasks: u32 = self.tasks.iter().map(Task::points).sum();
        let questions: u32 = self.questions.iter().map(|question| question.points).sum();
        tasks + questions
    }

    /// The mistake of that name.
    #[must_use]
    pub fn mistake(&self, id: &str) -> Option<&KnownMistake> {
        self.mistakes.iter().find(|mistake| mistake.id == id)
    }
}
