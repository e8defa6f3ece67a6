//! Measured answers: numbers that a student read from a report, and the report itself.

use std::collections::BTreeMap;

use lightbench_assets::files::Files;
use lightbench_script::Data;
use serde::Deserialize;

use super::folders::in_quotes;
use super::words::Words;

/// The file with a student's answers.
pub const ANSWERS: &str = "answers.toml";
/// The largest report that is read, in bytes.
const MOST_BYTES: usize = 32 << 20;

/// One answer, in a table that is called like the question.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The number.
    pub value: f64,
    /// The report that it was read from, by its path in the project.
    pub report: String,
}

/// The answers of a submission, by the names of the questions.
///
/// # Errors
/// In words, a file that can't be read.
pub fn read_answers(work: &Files) -> Result<BTreeMap<String, Answer>, Words> {
    let text = work
        .read_text(ANSWERS)
        .map_err(|error| Words::same(error.to_string()))?;
    toml::from_str(&text).map_err(|error: toml::de::Error| {
        let before = &text[..error.span().map_or(0, |span| span.start).min(text.len())];
        let line = before.matches('\n').count() + 1;
        let said = format!("{ANSWERS}:{line}: {}", error.message());
        let written = text.lines().nth(line - 1).unwrap_or_default();
        match has_decimal_comma(written) {
            true => Words::new(
                format!("{said}; decimals stand behind a point, as in `value = 4.3`"),
                format!("{said}; los decimales van tras un punto, como en `value = 4.3`"),
            ),
            false => Words::same(said),
        }
    })
}

/// Whether a line gives a number as `4,3`, as much of the world writes it.
fn has_decimal_comma(line: &str) -> bool {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let parts = line
        .split_once('=')
        .and_then(|(_, value)| value.split_once(','));
    parts.is_some_and(|(whole, rest)| digit(whole.chars().last()) && digit(rest.chars().next()))
}

/// A file of answers with another one in it. All other lines stay as they are; the lines that a new
/// project has for the question, as comments, are replaced.
#[must_use]
pub fn write_answer(text: &str, question: &str, answer: &Answer) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let header = format!("[{question}]");
    let as_comment = format!("# {header}");
    let is_header = |line: &String| line.trim() == header || line.trim() == as_comment;
    let at = lines.iter().position(is_header).unwrap_or_else(|| {
        if lines.last().is_some_and(|line| !line.trim().is_empty()) {
            lines.push(String::new());
        }
        lines.push(header.clone());
        lines.len() - 1
    });
    lines[at] = header;
    let value = format!("value = {:?}", answer.value);
    let report = format!("report = {}", in_quotes(&answer.report));
    let mut place = at + 1;
    for (name, line) in [("value", value), ("report", report)] {
        // The table ends where another one begins, or with an empty line.
        let ends = |line: &String| line.trim().is_empty() || line.trim().starts_with('[');
        let end = lines[at + 1..].iter().position(ends);
        let end = end.map_or(lines.len(), |length| at + 1 + length);
        let sets = |line: &String| {
            let plain = line.trim_start_matches(['#', ' ', '\t']);
            let rest = plain.strip_prefix(name).map(str::trim_start);
            rest.is_some_and(|rest| rest.starts_with('='))
        };
        match lines[at + 1..end].iter().position(sets) {
            Some(index) => {
                place = at + 1 + index;
                let unit = lines[place].split_once(" # ").filter(|_| name == "value");
                lines[place] = match unit {
                    Some((_, unit)) => format!("{line} # {unit}"),
                    None => line,
                };
            }
            None => lines.insert(place, line),
        }
        place += 1;
    }
    let mut text = lines.join("\n");
    text.push('\n');
    text
}

/// A report, as scripts see it.
pub(super) fn read_report(work: &Files, path: &str) -> Result<Data, Words> {
    let bytes = work
        .read(path)
        .map_err(|error| Words::same(error.to_string()))?;
    if bytes.len() > MOST_BYTES {
        let most = MOST_BYTES >> 20;
        return Err(Words::new(
            format!("{path} has more than {most} MiB"),
            format!("{path} tiene más de {most} MiB"),
        ));
    }
    let value = serde_json::from_slice(&bytes);
    value
        .map(data)
        .map_err(|error| Words::same(format!("{path}: {error}")))
}

fn data(value: serde_json::Value) -> Data {
    use serde_json::Value;
    match value {
        Value::Null => Data::Nothing,
        Value::Bool(on) => Data::Switch(on),
        Value::Number(number) => number.as_f64().map_or(Data::Nothing, Data::Number),
        Value::String(text) => Data::Text(text),
        Value::Array(items) => Data::List(items.into_iter().map(data).collect()),
        Value::Object(entries) => Data::Map(
            entries
                .into_iter()
                .map(|(name, value)| (name, data(value)))
                .collect(),
        ),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn answer(value: f64, report: &str) -> Answer {
        Answer {
            value,
            report: report.to_owned(),
        }
    }

    fn read(text: &str) -> BTreeMap<String, Answer> {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn a_decimal_comma_is_told() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(
            folder.path().join(ANSWERS),
            "[passes]\nvalue = 4,3\nreport = \"a\"\n",
        )
        .unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        let said = read_answers(&files).unwrap_err();
        assert!(said.en.contains("answers.toml:2") && said.en.contains("behind a point"));
        assert!(said.es.contains("tras un punto"), "{said:?}");
        for fine in ["value = 4.3", "values = [4, 3]", "a, 4 = 3", "value = 4, 3"] {
            assert!(!has_decimal_comma(fine), "{fine}");
        }
    }

    #[test]
    fn answers_take_the_place_of_comments_and_of_earlier_ones() {
        let new = "# How many?\n# [passes]\n# value = 0.0 # m\n# report = \"reports/passes/report.json\"\n\n\
                   # And this?\n# [other]\n# value = 0.0\n# report = \"x\"\n\n";
        let first = write_answer(new, "other", &answer(-3.0, "a \"b\""));
        assert_eq!(
            read(&first),
            [("other".to_owned(), answer(-3.0, "a \"b\""))].into()
        );
        let second = write_answer(&first, "passes", &answer(2.75, "r.json"));
        let third = write_answer(&second, "other", &answer(1e30, "c"));
        let all = [
            ("other".to_owned(), answer(1e30, "c")),
            ("passes".to_owned(), answer(2.75, "r.json")),
        ];
        assert_eq!(read(&third), all.into());
        assert!(third.contains("value = 2.75 # m\n"), "{third}");
        assert!(third.starts_with("# How many?\n[passes]\n"), "{third}");
        assert!(third.contains("# And this?\n[other]\n"), "{third}");
    }

    #[test]
    fn answers_are_added_to_any_file() {
        let two = [("a", 1.0), ("b", 2.0)];
        for text in ["", "# mine", "[a]\n[b]\n", "[b]\nreport = \"x\" # mine\n"] {
            let written = two.iter().fold(text.to_owned(), |text, (name, value)| {
                write_answer(&text, name, &answer(*value, "r"))
            });
            let all = two.map(|(name, value)| (name.to_owned(), answer(value, "r")));
            assert_eq!(read(&written), all.into(), "{written}");
            assert_eq!(
                text.contains("# mine") && text.starts_with('#'),
                written.contains("# mine")
            );
        }
    }
}
