//! Results for Gradescope.

use lightbench_lab::lesson::{CriterionOutcome, Language, Outcome, TaskOutcome};
use serde_json::{Value, json};

use super::{explained, refused};
use crate::grading::Record;

/// What an autograder of Gradescope writes to `results/results.json`: the fields `score`, `output` and
/// `tests`, each test with `name`, `score`, `max_score`, `output` and `status` (Gradescope's autograder
/// specification). `None` for what could not be checked: then a person decides.
#[must_use]
pub fn gradescope(record: &Record, language: Language) -> Option<Value> {
    let score = record.points()?;
    let mut result = json!({
        "score": score,
        "output": record.problem().unwrap_or_default(),
        "execution_time": record.seconds,
        "visibility": "visible",
    });
    if let Some(outcome) = record.outcome() {
        let tests: Vec<Value> = outcome
            .tasks
            .iter()
            .flat_map(|task| of_task(outcome, task, language))
            .collect();
        result["tests"] = tests.into();
    }
    Some(result)
}

fn of_task(outcome: &Outcome, task: &TaskOutcome, language: Language) -> Vec<Value> {
    let title = task.title.in_language(language);
    let test = |name: String, score: u32, of: u32, output: String| {
        json!({
            "name": name,
            "score": score,
            "max_score": of,
            "status": if score == of { "passed" } else { "failed" },
            "output": output,
        })
    };
    if task.criteria.is_empty() || task.refusal.is_some() {
        let why = refused(task, language).unwrap_or_default().to_owned();
        return vec![test(title.to_owned(), task.points, task.of, why)];
    }
    let criterion = |criterion: &CriterionOutcome| {
        let says = criterion.says.in_language(language);
        let name = match title == says {
            true => title.to_owned(),
            false => format!("{title}: {says}"),
        };
        let output = explained(outcome, criterion, language).join("\n");
        test(name, criterion.points, criterion.of, output)
    };
    task.criteria.iter().map(criterion).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::samples;
    use super::*;

    #[test]
    fn scores_of_the_tests_add_up() {
        for record in [samples::checked(), samples::refused()] {
            let result = gradescope(&record, Language::English).unwrap();
            let tests = result["tests"].as_array().unwrap();
            let sum = |name: &str| tests.iter().map(|t| t[name].as_u64().unwrap()).sum::<u64>();
            assert_eq!(Some(sum("score")), result["score"].as_u64());
            assert_eq!(sum("max_score"), 10);
        }
    }

    #[test]
    fn what_was_stopped_has_no_points_and_what_failed_has_no_result() {
        let stopped = gradescope(&samples::stopped(), Language::English).unwrap();
        assert_eq!(stopped["score"], 0);
        assert_eq!(stopped["output"], "it was stopped after 60 s");
        assert_eq!(gradescope(&samples::failed(), Language::English), None);
    }
}
