//! What grading gives: tables for the course's system, and a page for each student.

mod csv;
mod gradescope;
mod html;
mod junit;
mod overview;
mod similarity;

pub use csv::csv;
pub use gradescope::gradescope;
pub use html::{Page, student_page};
pub use junit::junit;
pub use overview::overview;
pub use similarity::for_jplag;

use lightbench_lab::lesson::{CriterionOutcome, Language, Outcome, State, TaskOutcome};

/// What a criterion says to a student: what must hold, and where it does not, what was expected and
/// found, why, and what to read again.
fn explained(outcome: &Outcome, criterion: &CriterionOutcome, language: Language) -> Vec<String> {
    let say = |en: &str, es: &str| match language {
        Language::English => en.to_owned(),
        Language::Spanish => es.to_owned(),
    };
    if criterion.state == State::NotReached {
        return vec![say("not judged", "sin evaluar")];
    }
    let mut lines = Vec::new();
    for finding in criterion.findings.iter().filter(|finding| !finding.holds) {
        let words = |words: &lightbench_lab::lesson::Words| words.in_language(language).to_owned();
        let mut line = format!(
            "{}: {}; {}: {}",
            say("expected", "se esperaba"),
            words(&finding.expected),
            say("found", "se encontró"),
            words(&finding.found)
        );
        if let Some(place) = &finding.place {
            line += &format!(" ({})", words(place));
        }
        if finding.hidden {
            line += &format!(" ({})", text_of_hidden(language));
        }
        lines.push(line);
        lines.extend(finding.cause.as_ref().map(words));
        if let Some(read) = &finding.read {
            let title = outcome.title_of(read, language);
            lines.push(format!("{}: {title}", say("read again", "vuelve a leer")));
        }
    }
    lines
}

/// What is said of a finding that a student could not have seen before.
fn text_of_hidden(language: Language) -> &'static str {
    match language {
        Language::English => "found by a check that only whoever grades has",
        Language::Spanish => "lo encontró una comprobación que solo tiene quien corrige",
    }
}

/// Why a task was not judged.
fn refused(task: &TaskOutcome, language: Language) -> Option<&str> {
    let refusal = task.refusal.as_ref()?;
    Some(refusal.says.in_language(language))
}

/// Text for HTML and XML. Characters that XML 1.0 can't hold (section 2.2) are replaced.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\t' | '\n' | '\r' => out.push(c),
            c if (c as u32) < 0x20 || matches!(c as u32, 0xFFFE | 0xFFFF) => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
pub(crate) mod samples {
    //! Records for tests.

    use lightbench_lab::lesson::{
        CriterionOutcome, Finding, OUTCOME_SCHEMA, Outcome, Refusal, RefusalKind, State,
        TaskOutcome, Words,
    };

    use crate::grading::{Ending, RECORD_SCHEMA, Record};

    /// One that got 6 of 10 points, with words that files must escape.
    pub fn checked() -> Record {
        let words = |text: &str| Words::new(text, format!("es {text}"));
        let finding = Finding {
            holds: false,
            near: false,
            expected: words("0.5 < x"),
            found: words("\"0.25\""),
            place: Some(words("pixel 3, 4")),
            cause: Some(words("gamma & twice")),
            read: Some("gamma".to_owned()),
            pictures: vec![("curve-yours.png".to_owned(), words("yours"))],
            hidden: true,
        };
        let criterion = |id: &str, points, state, findings| CriterionOutcome {
            id: id.to_owned(),
            says: words(&format!("the {id} holds")),
            points,
            of: 4,
            state,
            marked: false,
            findings,
        };
        let tasks = vec![
            TaskOutcome {
                id: "curve".to_owned(),
                title: words("A curve"),
                points: 4,
                of: 8,
                refusal: None,
                criteria: vec![
                    criterion("shape", 4, State::Passed, Vec::new()),
                    criterion("ends", 0, State::Failed, vec![finding]),
                ],
                seconds: 0.0,
            },
            TaskOutcome {
                id: "question".to_owned(),
                title: words("How many?"),
                points: 2,
                of: 2,
                refusal: None,
                criteria: Vec::new(),
                seconds: 0.0,
            },
        ];
        record(
            "17",
            "Ada \"the\" <first>, Lovelace",
            Ending::Checked(Box::new(Outcome {
                schema: OUTCOME_SCHEMA,
                lesson: "11-linear-light".to_owned(),
                title: words("Linear light"),
                student: Some("ada".to_owned()),
                points: 6,
                of: 10,
                marked: false,
                tasks,
                places: [("gamma".to_owned(), words("Gamma, twice"))].into(),
            })),
        )
    }

    /// One whose task was refused.
    pub fn refused() -> Record {
        let mut record = checked();
        record.student = "18".to_owned();
        record.name = "=cmd()".to_owned();
        if let Ending::Checked(outcome) = &mut record.ending {
            outcome.points = 2;
            outcome.marked = true;
            outcome.tasks[0].points = 0;
            outcome.tasks[0].refusal = Some(Refusal {
                kind: RefusalKind::Unchanged,
                says: Words::same("Nothing is changed yet"),
                read: None,
            });
        }
        record
    }

    /// One that was stopped.
    pub fn stopped() -> Record {
        let reason = "it was stopped after 60 s".to_owned();
        record("19", "Linus", Ending::Stopped(reason))
    }

    /// One that could not be checked.
    pub fn failed() -> Record {
        record("20", "Grace", Ending::Failed("no device".to_owned()))
    }

    fn record(student: &str, name: &str, ending: Ending) -> Record {
        Record {
            schema: RECORD_SCHEMA,
            student: student.to_owned(),
            name: name.to_owned(),
            late: student == "19",
            archive: Some("hand-in.zip".to_owned()),
            replaced: Vec::new(),
            id: None,
            fingerprint: "f".to_owned(),
            ending,
            seconds: 1.5,
            memory: None,
            not_enforced: Vec::new(),
        }
    }
}
