//! The lecturer's page: all students on one sheet.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use lightbench_lab::lesson::Language;

use super::escaped;
use super::html::document;
use crate::grading::{Reason, Record};

/// All students with their points, those to look at first, and how each criterion went. `page_of` gives
/// where a student's page lies.
#[must_use]
pub fn overview(
    title: &str,
    of: u32,
    records: &[Record],
    reasons: &BTreeMap<String, Vec<Reason>>,
    page_of: &dyn Fn(&Record) -> String,
) -> String {
    let judged = records.iter().filter(|record| record.points().is_some());
    let mut points: Vec<u32> = judged.filter_map(Record::points).collect();
    points.sort_unstable();
    let count = records.len();
    let noun = if count == 1 { "hand-in" } else { "hand-ins" };
    let mut body = format!("<h1>{}</h1>\n<p>{count} {noun}", escaped(title));
    if let (Some(least), Some(most)) = (points.first(), points.last()) {
        let middle = points[points.len() / 2];
        let _ = write!(
            body,
            "; points from {least} to {most} of {of}, median {middle}"
        );
    }
    body += ".</p>\n";
    let looks = |record: &&Record| record.needs_a_person() || reasons.contains_key(&record.student);
    let (first, rest): (Vec<&Record>, Vec<&Record>) = records.iter().partition(looks);
    let others = if first.is_empty() {
        "All"
    } else {
        "The others"
    };
    for (heading, records) in [("To look at", first), (others, rest)] {
        if records.is_empty() {
            continue;
        }
        let _ = writeln!(
            body,
            "<h2>{heading}</h2>\n<div class=\"wide\"><table><tr><th>Student<th>Name<th>State\
             <th class=\"number\">Points<th>Why</tr>"
        );
        for record in records {
            body += &row(record, reasons, &page_of(record));
        }
        body += "</table></div>\n";
    }
    body += &criteria(records);
    document(title, Language::English, &body)
}

fn row(record: &Record, reasons: &BTreeMap<String, Vec<Reason>>, page: &str) -> String {
    let points = record.points().map(|points| points.to_string());
    let marks = reasons.get(&record.student).into_iter().flatten();
    let why: Vec<String> = record
        .problem()
        .map(str::to_owned)
        .into_iter()
        .chain(marks.map(ToString::to_string))
        .chain(record.late.then(|| "late".to_owned()))
        .map(|text| escaped(&text))
        .collect();
    format!(
        "<tr><td><a href=\"{}\">{}</a><td>{}<td>{}<td class=\"number\">{}<td>{}</tr>\n",
        escaped(page),
        escaped(&record.student),
        escaped(&record.name),
        record.state(),
        points.unwrap_or_else(|| "–".to_owned()),
        why.join("<br>")
    )
}

/// How many have the points of each criterion, so that a lecturer sees what was hard, or what a check
/// gets wrong.
fn criteria(records: &[Record]) -> String {
    let outcomes: Vec<_> = records.iter().filter_map(Record::outcome).collect();
    let Some(first) = outcomes.first() else {
        return String::new();
    };
    let mut text = String::from(
        "<h2>Criteria</h2>\n<div class=\"wide\"><table><tr><th>Task<th>What must hold\
         <th class=\"number\">Hold</tr>\n",
    );
    for task in &first.tasks {
        for criterion in &task.criteria {
            let holds = |outcome: &&&lightbench_lab::lesson::Outcome| {
                let found = outcome.task(&task.id).map(|task| &task.criteria);
                let found = found.and_then(|all| all.iter().find(|c| c.id == criterion.id));
                found.is_some_and(|found| found.points == found.of)
            };
            let _ = writeln!(
                text,
                "<tr><td>{}<td>{}<td class=\"number\">{} of {}</tr>",
                escaped(task.title.in_language(Language::English)),
                escaped(criterion.says.in_language(Language::English)),
                outcomes.iter().filter(holds).count(),
                outcomes.len()
            );
        }
    }
    text + "</table></div>\n"
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn those_to_look_at_come_first_and_criteria_are_counted() {
        let records = [
            samples::checked(),
            samples::refused(),
            samples::stopped(),
            samples::failed(),
        ];
        let page_of = |record: &Record| format!("students/{}/page.html", record.student);
        let text = overview("Linear light", 10, &records, &BTreeMap::new(), &page_of);
        let at = |part: &str| text.find(part).unwrap_or_else(|| panic!("{part}: {text}"));
        assert!(at("<h2>To look at</h2>") < at("students/18/page.html"));
        assert!(at("students/20/page.html") < at("<h2>The others</h2>"));
        assert!(at("<h2>The others</h2>") < at("students/17/page.html"));
        at("4 hand-ins; points from 0 to 6 of 10, median 2");
        at("<td>A curve<td>the shape holds<td class=\"number\">2 of 2</tr>");
        at("<td>A curve<td>the ends holds<td class=\"number\">0 of 2</tr>");
    }
}
