//! Results for tools that read those of tests.

use lightbench_lab::lesson::{CriterionOutcome, Language, Outcome, State, TaskOutcome};

use super::{escaped, explained, refused};
use crate::grading::{Ending, Record};

/// All students as test suites, with their criteria as test cases, in the XML that JUnit's tools write
/// and continuous integration reads.
#[must_use]
pub fn junit(records: &[Record], language: Language) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n");
    for record in records {
        text += &suite(record, language);
    }
    text + "</testsuites>\n"
}

struct Case {
    task: String,
    name: String,
    /// The element inside, without points.
    inside: Option<(&'static str, String)>,
}

fn suite(record: &Record, language: Language) -> String {
    let cases: Vec<Case> = match &record.ending {
        Ending::Checked(outcome) => {
            let tasks = outcome.tasks.iter();
            tasks
                .flat_map(|task| of_task(outcome, task, language))
                .collect()
        }
        ending => {
            let kind = match ending {
                Ending::Failed(_) => "error",
                _ => "failure",
            };
            let why = record.problem().unwrap_or_default().to_owned();
            vec![Case {
                task: "submission".to_owned(),
                name: "checked".to_owned(),
                inside: Some((kind, why)),
            }]
        }
    };
    let count = |kind: &str| {
        let of_kind = |case: &&Case| case.inside.as_ref().is_some_and(|inside| inside.0 == kind);
        cases.iter().filter(of_kind).count()
    };
    let mut text = format!(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3}\">\n",
        escaped(&record.student),
        cases.len(),
        count("failure"),
        count("error"),
        count("skipped"),
        record.seconds
    );
    for case in &cases {
        let head = format!(
            "    <testcase classname=\"{}\" name=\"{}\"",
            escaped(&case.task),
            escaped(&case.name)
        );
        text += &match &case.inside {
            None => format!("{head}/>\n"),
            Some((kind, why)) => {
                let first = why.lines().next().unwrap_or_default();
                format!(
                    "{head}><{kind} message=\"{}\">{}</{kind}></testcase>\n",
                    escaped(first),
                    escaped(why)
                )
            }
        };
    }
    text + "  </testsuite>\n"
}

fn of_task(outcome: &Outcome, task: &TaskOutcome, language: Language) -> Vec<Case> {
    let case = |name: String, inside| Case {
        task: task.id.clone(),
        name,
        inside,
    };
    if let Some(why) = refused(task, language) {
        return vec![case(task.id.clone(), Some(("failure", why.to_owned())))];
    }
    let criterion = |criterion: &CriterionOutcome| {
        let why = || explained(outcome, criterion, language).join("\n");
        let inside = match criterion.state {
            State::Passed => None,
            State::Failed => Some(("failure", why())),
            State::NotReached => Some(("skipped", why())),
        };
        case(criterion.id.clone(), inside)
    };
    task.criteria.iter().map(criterion).collect()
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn every_criterion_is_a_case_and_the_numbers_add_up() {
        let records = [samples::checked(), samples::refused(), samples::failed()];
        let text = junit(&records, Language::English);
        let suite = "<testsuite name=\"17\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\" time=\"1.500\">";
        assert!(text.contains(suite), "{text}");
        assert!(text.contains("<testcase classname=\"curve\" name=\"shape\"/>"));
        let expected = "message=\"expected: 0.5 &lt; x; found: &quot;0.25&quot; (pixel 3, 4) (found by a check";
        assert!(text.contains(expected), "{text}");
        assert!(text.contains("gamma &amp; twice"));
        assert!(text.contains("<failure message=\"Nothing is changed yet\">"));
        assert!(text.contains("<error message=\"no device\">"));
    }
}
