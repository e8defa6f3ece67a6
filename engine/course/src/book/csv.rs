//! The table of points.

use std::collections::BTreeMap;

use crate::grading::{Reason, Record};

/// All students with their points, as a table of comma-separated values (RFC 4180): one line a student,
/// one column a task. What could not be checked has no points, so that nobody takes it for 0.
#[must_use]
pub fn csv(records: &[Record], reasons: &BTreeMap<String, Vec<Reason>>) -> String {
    let tasks = tasks(records);
    let mut head: Vec<String> = [
        "student",
        "name",
        "late",
        "state",
        "look_at_it",
        "points",
        "of",
    ]
    .map(str::to_owned)
    .to_vec();
    head.extend(tasks.iter().map(|task| format!("points of {task}")));
    head.extend(["why".to_owned(), "file".to_owned()]);
    let of = records.iter().find_map(|r| Some(r.outcome()?.of));
    let mut text = line(&head);
    for record in records {
        let marks = reasons.get(&record.student);
        let look = record.needs_a_person() || marks.is_some();
        let mut cells = vec![
            record.student.clone(),
            record.name.clone(),
            yes(record.late),
            record.state().to_owned(),
            yes(look),
            record.points().map(|p| p.to_string()).unwrap_or_default(),
            of.map(|of| of.to_string()).unwrap_or_default(),
        ];
        for task in &tasks {
            let outcome = record.outcome().and_then(|outcome| outcome.task(task));
            let points = match (outcome, record.points()) {
                (Some(outcome), _) => Some(outcome.points),
                // Nothing was judged, and that is 0.
                (None, Some(_)) => Some(0),
                (None, None) => None,
            };
            cells.push(points.map(|points| points.to_string()).unwrap_or_default());
        }
        let why = record.problem().map(str::to_owned).into_iter();
        let why = why.chain(marks.into_iter().flatten().map(ToString::to_string));
        cells.push(why.collect::<Vec<_>>().join("; "));
        cells.push(record.archive.clone().unwrap_or_default());
        text += &line(&cells);
    }
    text
}

/// The tasks of the first outcome: all are of one lesson.
fn tasks(records: &[Record]) -> Vec<String> {
    let outcome = records.iter().find_map(Record::outcome);
    let tasks = outcome.into_iter().flat_map(|outcome| &outcome.tasks);
    tasks.map(|task| task.id.clone()).collect()
}

fn yes(value: bool) -> String {
    if value { "yes" } else { "no" }.to_owned()
}

fn line(cells: &[String]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
    format!("{}\r\n", cells.join(","))
}

/// A cell. One that a spreadsheet would take for a formula begins with an apostrophe, which shows that it
/// is text: names are what students typed.
fn quoted(cell: &str) -> String {
    let formula = cell.starts_with(['=', '+', '-', '@', '\t', '\r']);
    let cell = if formula {
        format!("'{cell}")
    } else {
        cell.to_owned()
    };
    match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn one_line_a_student_with_what_spreadsheets_must_not_run() {
        let records = [
            samples::checked(),
            samples::refused(),
            samples::stopped(),
            samples::failed(),
        ];
        let mut reasons = BTreeMap::new();
        let others = vec!["18".to_owned()];
        reasons.insert(
            "17".to_owned(),
            vec![Reason::SameId("ada".to_owned(), others)],
        );
        let text = csv(&records, &reasons);
        let lines: Vec<&str> = text.split_terminator("\r\n").collect();
        assert_eq!(
            lines,
            [
                "student,name,late,state,look_at_it,points,of,points of curve,points of question,why,file",
                "17,\"Ada \"\"the\"\" <first>, Lovelace\",no,checked,yes,6,10,4,2,the id `ada` is also that of 18,hand-in.zip",
                "18,'=cmd(),no,near a threshold,yes,2,10,0,2,,hand-in.zip",
                "19,Linus,yes,stopped,yes,0,10,0,0,it was stopped after 60 s,hand-in.zip",
                "20,Grace,no,failed,yes,,10,,,no device,hand-in.zip",
            ]
        );
    }
}
