//! Judging what checks found, for the criteria of a task.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_render::TargetImage;
use lightbench_render::problem::suggestion;
use lightbench_script::{Bound, Evidence, Examiner, Expected, LaboratoryError, Told};

use super::compare::{Verdict, compare};
use super::model::{About, Task};
use super::outcome::{CriterionOutcome, Finding, State};
use super::words::{Words, numbers, quantity};
use super::{causes, pictures};

/// The judgements of one lesson, shared with the checks that make them.
#[derive(Clone)]
pub(super) struct Notes(Arc<Mutex<Inner>>);

struct Inner {
    about: About,
    lesson: String,
    student: Option<String>,
    /// Where pictures are written.
    pictures: Option<PathBuf>,
    /// The task that is judged now.
    task: Option<usize>,
    criteria: Vec<CriterionOutcome>,
    /// Whether a check judges that students do not have.
    hidden: bool,
}

impl Notes {
    pub(super) fn new(
        about: &About,
        lesson: &str,
        student: Option<&str>,
        pictures: Option<PathBuf>,
    ) -> Self {
        Self(Arc::new(Mutex::new(Inner {
            about: about.clone(),
            lesson: lesson.to_owned(),
            student: student.map(str::to_owned),
            pictures,
            task: None,
            criteria: Vec::new(),
            hidden: false,
        })))
    }

    /// Says whether what is judged from now on is judged by a check that students do not have.
    pub(super) fn hidden(&self, hidden: bool) {
        self.lock().hidden = hidden;
    }

    /// Begins a task: its criteria are judged until the next one begins.
    pub(super) fn begin(&self, task: usize) {
        let mut inner = self.lock();
        inner.task = Some(task);
        inner.criteria = unjudged(&inner.about.tasks[task]);
    }

    /// Begins a question, which has no criteria but itself.
    pub(super) fn begin_question(&self) {
        let mut inner = self.lock();
        inner.task = None;
        inner.criteria.clear();
    }

    /// What was judged of the task.
    pub(super) fn take(&self) -> Vec<CriterionOutcome> {
        std::mem::take(&mut self.lock().criteria)
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The criteria of a task before anything is judged.
pub(super) fn unjudged(task: &Task) -> Vec<CriterionOutcome> {
    let criteria = task.criteria.iter();
    criteria
        .map(|criterion| CriterionOutcome {
            id: criterion.id.clone(),
            says: criterion.says.clone(),
            points: 0,
            of: criterion.points,
            state: State::NotReached,
            marked: false,
            findings: Vec::new(),
        })
        .collect()
}

impl Examiner for Notes {
    fn judge(&mut self, criterion: &str, evidence: Evidence) -> Result<bool, LaboratoryError> {
        let mut inner = self.lock();
        inner.judge(criterion, evidence)
    }

    fn constant(&self, name: &str) -> Result<f64, LaboratoryError> {
        let inner = self.lock();
        let constants = &inner.about.constants;
        let Some(constant) = constants.iter().find(|constant| constant.name == name) else {
            let names = constants.iter().map(|constant| constant.name.as_str());
            return Err(unknown("constant", name, names));
        };
        Ok(constant.value(&inner.lesson, inner.student.as_deref()))
    }
}

fn unknown<'a>(what: &str, name: &str, names: impl Iterator<Item = &'a str>) -> LaboratoryError {
    let hint = suggestion(name, names).map_or_else(String::new, |hint| format!("; {hint}"));
    LaboratoryError::Other(format!("the lesson has no {what} `{name}` here{hint}"))
}

impl Inner {
    fn judge(&mut self, criterion: &str, evidence: Evidence) -> Result<bool, LaboratoryError> {
        let index = self.criteria.iter().position(|known| known.id == criterion);
        let (Some(index), Some(task)) = (index, self.task) else {
            let names = self.criteria.iter().map(|criterion| criterion.id.as_str());
            return Err(unknown("criterion", criterion, names));
        };
        let task = &self.about.tasks[task];
        let read = task.criteria[index]
            .read
            .clone()
            .unwrap_or_else(|| task.read.clone());
        let number = self.criteria[index].findings.len() + 1;
        let stem = format!("{}-{criterion}-{number}", task.id);
        let mut finding = self.finding(evidence, &stem)?;
        finding.hidden = self.hidden;
        if !finding.holds && finding.read.is_none() {
            finding.read = Some(read);
        }
        let holds = finding.holds;
        let outcome = &mut self.criteria[index];
        outcome.marked |= finding.near;
        outcome.findings.push(finding);
        let all_hold = outcome.findings.iter().all(|finding| finding.holds);
        (outcome.state, outcome.points) = match all_hold {
            true => (State::Passed, outcome.of),
            false => (State::Failed, 0),
        };
        Ok(holds)
    }

    fn finding(&self, evidence: Evidence, stem: &str) -> Result<Finding, LaboratoryError> {
        match evidence {
            Evidence::Picture {
                found,
                expected,
                mistakes,
                bound,
            } => {
                for (id, _) in &mistakes {
                    self.mistake(id)?;
                }
                self.picture(&found, &expected, &mistakes, bound, stem)
            }
            Evidence::Number {
                found,
                expected,
                mistakes,
                bound,
                unit,
            } => {
                let error = |expected: f64| {
                    let off = (found - expected).abs();
                    let allowed = bound.absolute + bound.relative * expected.abs();
                    if off == 0.0 { 0.0 } else { off / allowed }
                };
                let verdict = Verdict::of(error(expected));
                for (id, _) in &mistakes {
                    self.mistake(id)?;
                }
                let mistake = mistakes.iter().find(|(_, would)| error(*would) <= 1.0);
                let mut finding = said(
                    verdict,
                    Words::same(quantity(expected, &unit)),
                    Words::same(quantity(found, &unit)),
                );
                self.explain(&mut finding, mistake.map(|(id, _)| id.as_str()))?;
                Ok(finding)
            }
            Evidence::Limit {
                found,
                limit,
                at_least,
                margin,
                unit,
                mistake,
            } => {
                let verdict = Verdict {
                    holds: if at_least {
                        found >= limit
                    } else {
                        found <= limit
                    },
                    near: found != limit && (found - limit).abs() <= margin * limit.abs(),
                };
                let limit = quantity(limit, &unit);
                let expected = match at_least {
                    true => Words::new(format!("at least {limit}"), format!("al menos {limit}")),
                    false => Words::new(format!("at most {limit}"), format!("como mucho {limit}")),
                };
                let mut finding = said(verdict, expected, Words::same(quantity(found, &unit)));
                self.explain(&mut finding, mistake.as_deref())?;
                Ok(finding)
            }
            Evidence::Statement {
                holds,
                found,
                expected,
                mistake,
            } => {
                let verdict = Verdict { holds, near: false };
                let mut finding = said(verdict, words(expected), words(found));
                self.explain(&mut finding, mistake.as_deref())?;
                Ok(finding)
            }
        }
    }

    fn picture(
        &self,
        found: &TargetImage,
        expected: &Expected,
        mistakes: &[(String, Expected)],
        bound: Bound,
        stem: &str,
    ) -> Result<Finding, LaboratoryError> {
        let comparison = compare(found, expected, bound);
        let verdict = Verdict::of(comparison.error);
        let at = |x: u32, y: u32| (y * found.width + x) as usize;
        let shown = comparison.worst.or_else(|| {
            let first = expected.texels.iter().position(Option::is_some)? as u32;
            Some((first % found.width, first / found.width))
        });
        let channels = expected.channels;
        let (right, drawn) = shown.map_or_else(Default::default, |(x, y)| {
            let right = expected.texels[at(x, y)].unwrap_or_default();
            (
                numbers(&right[..channels]),
                numbers(&found.texels[at(x, y)][..channels]),
            )
        });
        let mut finding = said(verdict, Words::same(right), Words::same(drawn));
        finding.place = comparison.area.zip(comparison.worst).map(|([first, last], (x, y))| {
            let share = quantity(100.0 * comparison.wrong as f64 / comparison.compared.max(1) as f64, "%");
            let [left, top] = first;
            let [right, bottom] = last;
            Words::new(
                format!("{share} of the texels compared, from ({left}, {top}) to ({right}, {bottom}); farthest off at ({x}, {y}), whose values are given here"),
                format!("{share} de los téxeles comparados, de ({left}, {top}) a ({right}, {bottom}); el que más difiere es ({x}, {y}), cuyos valores se dan aquí"),
            )
        });
        if !verdict.holds {
            let explained = |(_, by): &&(String, Expected)| {
                causes::is_explained(found, expected, by, bound, comparison.distance)
            };
            let mistake = mistakes.iter().find(explained);
            self.explain(&mut finding, mistake.map(|(id, _)| id.as_str()))?;
            if finding.cause.is_none() {
                finding.cause = causes::of_picture(found, expected, bound, comparison.distance);
            }
        }
        if let Some(folder) = self
            .pictures
            .as_ref()
            .filter(|_| !verdict.holds || verdict.near)
        {
            for drawn in pictures::draw(found, expected, &comparison) {
                let file = format!("{stem}-{}.png", drawn.name);
                let written = drawn
                    .picture
                    .to_png()
                    .and_then(|bytes| crate::files::write_atomically(&folder.join(&file), &bytes));
                written.map_err(|error| LaboratoryError::Other(error.to_string()))?;
                finding.pictures.push((file, drawn.shows));
            }
        }
        Ok(finding)
    }

    /// Adds what a mistake of the lesson says, where the finding does not hold.
    fn explain(&self, finding: &mut Finding, mistake: Option<&str>) -> Result<(), LaboratoryError> {
        let Some(id) = mistake else {
            return Ok(());
        };
        let (says, read) = self.mistake(id)?;
        if !finding.holds {
            finding.cause = Some(says);
            finding.read = read;
        }
        Ok(())
    }

    fn mistake(&self, id: &str) -> Result<(Words, Option<String>), LaboratoryError> {
        let known = self.about.mistake(id);
        let names = || {
            self.about
                .mistakes
                .iter()
                .map(|mistake| mistake.id.as_str())
        };
        let known = known.ok_or_else(|| unknown("mistake", id, names()))?;
        Ok((known.says.clone(), known.read.clone()))
    }
}

fn words(told: Told) -> Words {
    Words::new(told.en, told.es)
}

fn said(verdict: Verdict, expected: Words, found: Words) -> Finding {
    Finding {
        holds: verdict.holds,
        near: verdict.near,
        expected,
        found,
        place: None,
        cause: None,
        read: None,
        pictures: Vec::new(),
        hidden: false,
    }
}
