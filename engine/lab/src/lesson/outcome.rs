//! What a check found, as data.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::words::{Language, Words};

/// Version of the data. It grows when a field changes its meaning or goes away.
pub const OUTCOME_SCHEMA: u32 = 1;

/// What a check of a whole lesson found. The same work gives the same outcome.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// [`OUTCOME_SCHEMA`].
    pub schema: u32,
    /// The name of the lesson, as `01-first-light`.
    pub lesson: String,
    /// Its title.
    pub title: Words,
    /// The student, if one was named.
    pub student: Option<String>,
    /// Points that the work got.
    pub points: u32,
    /// Points that there are.
    pub of: u32,
    /// Whether a person should look at it, since something is near its threshold.
    pub marked: bool,
    /// The tasks, and then the questions, in their order.
    pub tasks: Vec<TaskOutcome>,
    /// The titles of the places in the text that are named as worth reading again.
    #[serde(default)]
    pub places: BTreeMap<String, Words>,
}

/// What was found of one task or question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskOutcome {
    /// Its name.
    pub id: String,
    /// Its title.
    pub title: Words,
    /// Points that it got.
    pub points: u32,
    /// Points that there are.
    pub of: u32,
    /// Why it was not judged, or not to its end.
    pub refusal: Option<Refusal>,
    /// Its criteria, in their order.
    pub criteria: Vec<CriterionOutcome>,
    /// How long it took. Not part of the file, since it differs each time.
    #[serde(skip)]
    pub seconds: f64,
}

/// Why a task was not judged, or not to its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refusal {
    /// What kind of reason it is.
    pub kind: RefusalKind,
    /// The reason.
    pub says: Words,
    /// The place in the text to read again.
    pub read: Option<String>,
}

/// Kinds of reasons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RefusalKind {
    /// A file is missing.
    Missing,
    /// The files are those of the starter.
    Unchanged,
    /// A file imports what the lesson does not allow.
    Import,
    /// A file is a copy of a shipped one.
    Copy,
    /// The work can't be loaded or drawn.
    Broken,
    /// The check itself failed.
    Check,
}

/// What was found of one criterion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriterionOutcome {
    /// Its name.
    pub id: String,
    /// What must hold.
    pub says: Words,
    /// Points that it got.
    pub points: u32,
    /// Points that there are.
    pub of: u32,
    /// How it was judged.
    pub state: State,
    /// Whether a person should look at it, since it is near the threshold.
    pub marked: bool,
    /// What was judged, in the order of the checks.
    pub findings: Vec<Finding>,
}

/// How a criterion was judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// Each judgement of it holds.
    Passed,
    /// A judgement of it does not hold.
    Failed,
    /// It was not judged.
    NotReached,
}

/// One judgement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Whether it holds.
    pub holds: bool,
    /// Whether another driver might have judged otherwise.
    pub near: bool,
    /// What was expected.
    pub expected: Words,
    /// What was found.
    pub found: Words,
    /// Where it differs, of pictures.
    pub place: Option<Words>,
    /// What went wrong, as far as that is seen.
    pub cause: Option<Words>,
    /// The place in the text to read again, where it does not hold.
    pub read: Option<String>,
    /// Pictures: the name of each file, and what it shows.
    pub pictures: Vec<(String, Words)>,
    /// Whether a check has found it that students do not have.
    #[serde(default)]
    pub hidden: bool,
}

impl Outcome {
    /// The outcome as the text of a JSON file.
    ///
    /// # Errors
    /// None that is known: all of it can be written.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    /// A task or question by its name.
    #[must_use]
    pub fn task(&self, id: &str) -> Option<&TaskOutcome> {
        self.tasks.iter().find(|task| task.id == id)
    }

    /// The title of a place in the text, in a language; the name of the place where it has none.
    #[must_use]
    pub fn title_of<'a>(&'a self, place: &'a str, language: Language) -> &'a str {
        let title = self.places.get(place);
        title.map_or(place, |title| title.in_language(language))
    }

    /// A criterion by its name.
    #[must_use]
    pub fn criterion(&self, id: &str) -> Option<&CriterionOutcome> {
        let criteria = self.tasks.iter().flat_map(|task| &task.criteria);
        criteria.into_iter().find(|criterion| criterion.id == id)
    }
}

impl TaskOutcome {
    /// The places in the text that it names.
    pub fn places(&self) -> impl Iterator<Item = &str> {
        let findings = self.criteria.iter().flat_map(|one| &one.findings);
        let refused = self.refusal.iter().filter_map(|one| one.read.as_deref());
        refused.chain(findings.filter_map(|finding| finding.read.as_deref()))
    }

    /// What went wrong in it: its refusal, and the causes of its findings.
    pub fn causes(&self) -> impl Iterator<Item = &Words> {
        let findings = self
            .criteria
            .iter()
            .flat_map(|criterion| &criterion.findings);
        let causes = findings.filter_map(|finding| finding.cause.as_ref());
        self.refusal
            .iter()
            .map(|refusal| &refusal.says)
            .chain(causes)
    }
}
