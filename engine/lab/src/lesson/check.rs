//! Checking a submission of a lesson.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use lightbench_assets::Progress;
use lightbench_assets::files::FileError;
use lightbench_render::problem::Problems;
use lightbench_render::{GpuOptions, Place, Problem};
use lightbench_script::{CheckFault, CheckScript, Given, Laboratory, LaboratoryError, LogLine};

use super::Lesson;
use super::answers::{ANSWERS, Answer, read_answers, read_report};
use super::compare::Verdict;
use super::examiner::{Notes, unjudged};
use super::model::{About, Question, Task};
use super::outcome::{
    CriterionOutcome, Finding, OUTCOME_SCHEMA, Outcome, Refusal, RefusalKind, State, TaskOutcome,
};
use super::read::CHECKS;
use super::source::Source;
use super::stage::Stage;
use super::submission::{Submission, refusal};
use super::words::{Language, Words, quantity};
use crate::experiment::{Remark, Workbench};

/// How a submission is checked.
#[derive(Clone, Debug, Default)]
pub struct CheckOptions {
    /// The student, for whom numbers are drawn.
    pub student: Option<String>,
    /// Which adapter draws.
    pub gpu: GpuOptions,
    /// The folder that pictures of what differs are written to; none are without one.
    pub pictures: Option<PathBuf>,
    /// A folder with more checks, which a student does not have: `checks.rhai`, and `checks`.
    pub hidden: Option<PathBuf>,
    /// The tasks and questions that are checked; all, if it is empty.
    pub only: Vec<String>,
}

/// What happens during a check.
#[derive(Clone, Debug, PartialEq)]
pub enum CheckEvent {
    /// A task or question begins.
    Begins {
        /// Its title.
        title: Words,
        /// How many there were before.
        done: usize,
        /// How many there are.
        of: usize,
    },
    /// A script of the checks printed a line.
    Printed(LogLine),
    /// A scene printed a line, or something had to be changed for it.
    Remark(Remark),
}

/// Why nothing could be checked.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// A folder or a file can't be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The checks have a mistake.
    #[error(transparent)]
    Checks(#[from] Problems),
    /// No device can draw.
    #[error("{0}")]
    Device(LaboratoryError),
    /// A task that there is not.
    #[error("the lesson has no task or question `{0}`")]
    NoTask(String),
    /// The caller's progress was cancelled.
    #[error("stopped")]
    Stopped,
}

/// Checks a submission: the submitted files in `work`, over the starter. Nothing else of the folder
/// counts, and nothing in it is written.
///
/// # Errors
/// A lesson or a folder that can't be read, or no device. What is wrong with the submission is part of
/// the outcome.
pub fn check(
    lesson: &Lesson,
    work: &Path,
    options: &CheckOptions,
    progress: &Progress,
    tell: impl Fn(CheckEvent) + Clone + Send + Sync + 'static,
) -> Result<Outcome, CheckError> {
    let about = &lesson.about;
    let ids = about.tasks.iter().map(|task| &task.id);
    let ids: Vec<&String> = ids
        .chain(about.questions.iter().map(|question| &question.id))
        .collect();
    if let Some(unknown) = options.only.iter().find(|id| !ids.contains(id)) {
        return Err(CheckError::NoTask(unknown.clone()));
    }
    let wanted = |id: &String| options.only.is_empty() || options.only.contains(id);
    let submission = Submission::read(lesson, work)?;
    let notes = Notes::new(
        about,
        &lesson.name,
        options.student.as_deref(),
        options.pictures.clone(),
    );
    let mut bench = Bench::new(lesson, options, &submission, &notes, progress, tell.clone())?;
    let mut outcomes = Vec::new();
    let of = ids.iter().filter(|id| wanted(id)).count();
    for (index, task) in about
        .tasks
        .iter()
        .enumerate()
        .filter(|(_, task)| wanted(&task.id))
    {
        tell(CheckEvent::Begins {
            title: task.title.clone(),
            done: outcomes.len(),
            of,
        });
        let started = Instant::now();
        let mut outcome = match submission.refuse(task) {
            Some(refusal) => task_outcome(task, unjudged(task), Some(refusal)),
            None => {
                notes.begin(index);
                let refusal = bench.run(&task.function(), &notes)?;
                task_outcome(task, notes.take(), refusal)
            }
        };
        outcome.seconds = started.elapsed().as_secs_f64();
        outcomes.push(outcome);
    }
    for question in about
        .questions
        .iter()
        .filter(|question| wanted(&question.id))
    {
        tell(CheckEvent::Begins {
            title: question.asks.clone(),
            done: outcomes.len(),
            of,
        });
        let started = Instant::now();
        notes.begin_question();
        let mut outcome = bench.answer(question, &submission)?;
        outcome.seconds = started.elapsed().as_secs_f64();
        outcomes.push(outcome);
    }
    let places = titles(lesson, &outcomes)?;
    Ok(Outcome {
        schema: OUTCOME_SCHEMA,
        lesson: lesson.name.clone(),
        title: about.title.clone(),
        student: options.student.clone(),
        points: outcomes.iter().map(|task| task.points).sum(),
        of: outcomes.iter().map(|task| task.of).sum(),
        marked: outcomes
            .iter()
            .flat_map(|task| &task.criteria)
            .any(|criterion| criterion.marked),
        tasks: outcomes,
        places,
    })
}

/// The titles of the places that outcomes name.
fn titles(
    lesson: &Lesson,
    outcomes: &[TaskOutcome],
) -> Result<BTreeMap<String, Words>, CheckError> {
    let [en, es] = [Language::English, Language::Spanish].map(|language| lesson.text(language));
    let (en, es) = (en?, es?);
    let places = outcomes.iter().flat_map(TaskOutcome::places);
    let titled = places.filter_map(|place| {
        let words = Words::new(en.title_of(place)?, es.title_of(place)?);
        Some((place.to_owned(), words))
    });
    Ok(titled.collect())
}

fn task_outcome(
    task: &Task,
    mut criteria: Vec<CriterionOutcome>,
    refusal: Option<Refusal>,
) -> TaskOutcome {
    if refusal.is_some() {
        // What came to no end gives nothing: later judgements of the same criteria are missing.
        for criterion in &mut criteria {
            criterion.points = 0;
            if criterion.state == State::Passed {
                criterion.state = State::NotReached;
            }
        }
    }
    let refusal = refusal.map(|refusal| Refusal {
        read: refusal.read.or_else(|| Some(task.read.clone())),
        ..refusal
    });
    TaskOutcome {
        id: task.id.clone(),
        title: task.title.clone(),
        points: criteria.iter().map(|criterion| criterion.points).sum(),
        of: task.points(),
        refusal,
        criteria,
        seconds: 0.0,
    }
}

/// The checks of a lesson, ready to run.
struct Bench {
    about: About,
    scripts: Vec<CheckScript>,
    // The projects live as long as the scripts that use them.
    _stages: Vec<Stage>,
}

impl Bench {
    fn new(
        lesson: &Lesson,
        options: &CheckOptions,
        submission: &Submission,
        notes: &Notes,
        progress: &Progress,
        tell: impl Fn(CheckEvent) + Clone + Send + Sync + 'static,
    ) -> Result<Self, CheckError> {
        let mut sources = vec![lesson.source.clone()];
        if let Some(hidden) = &options.hidden {
            sources.push(Source::of_folder(hidden)?);
        }
        let (mut scripts, mut stages) = (Vec::new(), Vec::new());
        let mut first: Option<Workbench> = None;
        for source in sources {
            let reference = Stage::of_checks(lesson, &source, CHECKS)?;
            let work = Stage::of_work(lesson, &source, &submission.given())?;
            let mut benches = Vec::new();
            for stage in [&reference, &work] {
                let told = tell.clone();
                let remark = move |remark| told(CheckEvent::Remark(remark));
                let bench = match &first {
                    Some(first) => first.beside(&stage.files, remark),
                    None => {
                        let mut bench =
                            Workbench::new(&stage.files, options.gpu.clone(), progress, remark);
                        bench.open_device().map_err(CheckError::Device)?;
                        first = Some(bench.beside(&stage.files, |_| {}));
                        bench
                    }
                };
                benches.push(Box::new(bench) as Box<dyn Laboratory>);
            }
            let told = tell.clone();
            let print = move |line| told(CheckEvent::Printed(line));
            if let (Some(of_work), Some(of_reference)) = (benches.pop(), benches.pop()) {
                let examiner = Box::new(notes.clone());
                let script = CheckScript::load(
                    &reference.files,
                    CHECKS,
                    [of_reference, of_work],
                    examiner,
                    print,
                    progress,
                )
                .map_err(|problems| problems.with_sources(&reference.files))?;
                if scripts.is_empty() {
                    has_functions(lesson, &script)?;
                }
                scripts.push(script);
            }
            stages.extend([reference, work]);
        }
        Ok(Self {
            about: lesson.about.clone(),
            scripts,
            _stages: stages,
        })
    }

    /// Runs a function of all scripts that have it: the lesson's own, then those of the hidden checks.
    fn run(&mut self, function: &str, notes: &Notes) -> Result<Option<Refusal>, CheckError> {
        for (index, script) in self.scripts.iter_mut().enumerate() {
            notes.hidden(index > 0);
            if !script.functions().iter().any(|(name, _)| name == function) {
                continue;
            }
            if let Err(fault) = script.run(function, None) {
                return told(fault).map(Some);
            }
        }
        Ok(None)
    }

    fn answer(
        &mut self,
        question: &Question,
        submission: &Submission,
    ) -> Result<TaskOutcome, CheckError> {
        let mut outcome = TaskOutcome {
            id: question.id.clone(),
            title: question.asks.clone(),
            points: 0,
            of: question.points,
            refusal: None,
            criteria: Vec::new(),
            seconds: 0.0,
        };
        let answer = read_answers(&submission.work).and_then(|answers| {
            let missing = || {
                Words::new(
                    format!("{ANSWERS} has no table `[{}]` yet", question.id),
                    format!("{ANSWERS} no tiene todavía una tabla `[{}]`", question.id),
                )
            };
            let answer: Answer = answers.get(&question.id).cloned().ok_or_else(missing)?;
            let report = read_report(&submission.work, &answer.report)?;
            Ok((answer, report))
        });
        let refuse = |mut outcome: TaskOutcome, refusal: Refusal| {
            outcome.refusal = Some(Refusal {
                read: Some(question.read.clone()),
                ..refusal
            });
            Ok(outcome)
        };
        let (answer, report) = match answer {
            Ok(read) => read,
            Err(words) => return refuse(outcome, refusal(RefusalKind::Missing, words)),
        };
        let Some(script) = self.scripts.first_mut() else {
            return Ok(outcome);
        };
        let expected = match script.run(&question.function(), Some(&report)) {
            Ok(Given::Number(expected)) => expected,
            Ok(other) => {
                let mistake = match other {
                    Given::Text(id) => self.about.mistake(&id).cloned(),
                    _ => None,
                };
                let says = mistake.map_or_else(
                    || {
                        Words::new(
                            format!(
                                "{} is not the report that the question asks for",
                                answer.report
                            ),
                            format!("{} no es el informe que pide la pregunta", answer.report),
                        )
                    },
                    |mistake| mistake.says,
                );
                return refuse(outcome, refusal(RefusalKind::Broken, says));
            }
            Err(fault) => {
                let fault = told(fault)?;
                return refuse(outcome, fault);
            }
        };
        let allowed = question.tolerance * expected.abs();
        let off = (answer.value - expected).abs();
        let verdict = Verdict::of(if off == 0.0 { 0.0 } else { off / allowed });
        outcome.points = if verdict.holds { question.points } else { 0 };
        outcome.criteria.push(CriterionOutcome {
            id: question.id.clone(),
            says: question.asks.clone(),
            points: outcome.points,
            of: question.points,
            state: if verdict.holds {
                State::Passed
            } else {
                State::Failed
            },
            // The report gives the number itself: no driver is in between.
            marked: false,
            findings: vec![Finding {
                holds: verdict.holds,
                near: false,
                expected: Words::new(
                    format!(
                        "what {} says, within {} %",
                        answer.report,
                        100.0 * question.tolerance
                    ),
                    format!(
                        "lo que dice {}, con un margen del {} %",
                        answer.report,
                        100.0 * question.tolerance
                    ),
                ),
                found: Words::same(quantity(answer.value, &question.unit)),
                place: None,
                cause: None,
                read: (!verdict.holds).then(|| question.read.clone()),
                pictures: Vec::new(),
                hidden: false,
            }],
        });
        Ok(outcome)
    }
}

/// All tasks and questions have their functions.
fn has_functions(lesson: &Lesson, script: &CheckScript) -> Result<(), CheckError> {
    let functions = script.functions();
    let tasks = lesson
        .about
        .tasks
        .iter()
        .map(|task| (task.function(), 1, "work"));
    let questions = lesson
        .about
        .questions
        .iter()
        .map(|question| (question.function(), 2, "work, report"));
    let missing = tasks.chain(questions).filter(|(name, count, _)| {
        !functions
            .iter()
            .any(|(known, arguments)| known == name && arguments == count)
    });
    let problems: Vec<Problem> = missing
        .map(|(name, _, arguments)| {
            Problem::new(
                Place::file(lesson.source.shown(CHECKS)),
                format!("there is no function `{name}({arguments})`"),
            )
            .with_hint(
                "each task has a function `check_` with its name, each question one `answer_`",
            )
        })
        .collect();
    match problems.is_empty() {
        true => Ok(()),
        false => Err(Problems(problems).into()),
    }
}

/// A fault as a reason why a task has no points.
fn told(fault: CheckFault) -> Result<Refusal, CheckError> {
    match fault {
        CheckFault::Stopped => Err(CheckError::Stopped),
        CheckFault::Work(problems) => {
            let problems = problems.to_string();
            Ok(refusal(RefusalKind::Broken, Words::same(problems)))
        }
        CheckFault::Check(problem) => Ok(refusal(
            RefusalKind::Check,
            Words::new(
                format!("The check itself failed; please tell whoever wrote the lesson: {problem}"),
                format!(
                    "Ha fallado la propia comprobación; avisa a quien escribió la lección: {problem}"
                ),
            ),
        )),
    }
}
