//! Measured answers: numbers that a student read from a report, and the report itself.

use std::collections::BTreeMap;

use lightbench_assets::files::Files;
use lightbench_script::Data;
use serde::Deserialize;

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
        Words::same(format!("{ANSWERS}:{line}: {}", error.message()))
    })
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
