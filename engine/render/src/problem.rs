//! What can be wrong with a pipeline or a shader, said so that a student can mend it.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use lightbench_assets::files::Files;

use crate::shader::with_plain_line_ends;

/// A position in a file that a person wrote. Lines and columns start at 1; 0 means unknown.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Place {
    /// Path relative to the project, with forward slashes.
    pub file: Arc<str>,
    /// Line, from 1; 0 where only the file is known.
    pub line: u32,
    /// Column in characters, from 1; 0 where only the line is known.
    pub column: u32,
}

impl Place {
    /// A position in `file`.
    pub fn new(file: impl Into<Arc<str>>, line: u32, column: u32) -> Self {
        Self {
            file: file.into(),
            line,
            column,
        }
    }

    /// The file as a whole.
    pub fn file(file: impl Into<Arc<str>>) -> Self {
        Self::new(file, 0, 0)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => write!(f, "{}", self.file),
            (line, 0) => write!(f, "{}:{line}", self.file),
            (line, column) => write!(f, "{}:{line}:{column}", self.file),
        }
    }
}

/// One mistake: where it is, what it is, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// What is wrong, as one sentence.
    pub message: String,
    /// The way out, where one is known ("did you mean `g_normal`?").
    pub hint: Option<String>,
    /// The offending line of the file, where it could be read.
    pub source_line: Option<String>,
}

impl Problem {
    /// A problem without a hint.
    pub fn new(place: Place, message: impl Into<String>) -> Self {
        Self {
            place,
            message: message.into(),
            hint: None,
            source_line: None,
        }
    }

    /// Adds the way out.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Adds the offending line, taken from the text of the file.
    #[must_use]
    pub fn with_source(mut self, text: &str) -> Self {
        let index = (self.place.line as usize).checked_sub(1);
        self.source_line = index
            .and_then(|i| text.lines().nth(i))
            .map(|line| line.trim_end().to_owned());
        self
    }
}

/// Characters of a line that are shown; what a program has written may have thousands in one.
const WIDEST: usize = 160;

/// The part of a line around a column, and the column in it. Columns begin at 1; 0 is none.
fn excerpt(line: &str, column: usize) -> (Cow<'_, str>, usize) {
    let count = line.chars().count();
    if count <= WIDEST {
        return (line.into(), column);
    }
    let first = column
        .saturating_sub(WIDEST / 2)
        .min(count.saturating_sub(WIDEST));
    let part: String = line.chars().skip(first).take(WIDEST).collect();
    let before = if first > 0 { "…" } else { "" };
    let after = if first + WIDEST < count { "…" } else { "" };
    let column = match column {
        0 => 0,
        column => column - first + before.chars().count(),
    };
    (format!("{before}{part}{after}").into(), column)
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)?;
        if let Some(line) = &self.source_line {
            let (line, column) = excerpt(line, self.place.column as usize);
            write!(f, "\n    {line}")?;
            if column > 0 {
                let indent: String = line
                    .chars()
                    .take(column - 1)
                    .map(|c| if c == '\t' { '\t' } else { ' ' })
                    .collect();
                write!(f, "\n    {indent}^")?;
            }
        }
        if let Some(hint) = &self.hint {
            write!(f, "\n    help: {hint}")?;
        }
        Ok(())
    }
}

/// Every mistake that was found, in the order of the file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Problems(pub Vec<Problem>);

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.0.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl Problems {
    /// Adds the offending lines, read from the files that the problems name.
    #[must_use]
    pub fn with_sources(mut self, files: &Files) -> Self {
        for problem in &mut self.0 {
            if problem.source_line.is_none()
                && problem.place.line > 0
                && let Ok(text) = files.read_text(&problem.place.file)
            {
                *problem = problem.clone().with_source(&with_plain_line_ends(&text));
            }
        }
        self
    }
}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self(vec![problem])
    }
}

/// "did you mean `x`?" for the candidate that is [`nearest`], if there is one.
pub fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(name, candidates).map(|candidate| format!("did you mean `{candidate}`?"))
}

/// The candidate that a misspelt name probably means.
///
/// Nearness is the number of slips of the finger; at most one for three letters. Where nothing is so
/// near, a candidate of which the name is the end: `normal` may mean `g_normal`.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const WORD: usize = 4;
    let length = name.chars().count();
    let limit = (length / 3).max(1);
    let rank = |candidate: &'a str| {
        let distance = edit_distance(name, candidate);
        if distance <= limit {
            return Some((distance, candidate));
        }
        let part = length >= WORD && candidate.ends_with(name);
        part.then_some((limit + distance, candidate))
    };
    let ranked = candidates.into_iter().filter_map(rank);
    ranked.min().map(|(_, candidate)| candidate)
}

/// How many letters must be changed, added, left out or swapped with their neighbour to turn one
/// name into the other, ignoring case (Damerau 1964; no letter takes part in two swaps).
fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.to_lowercase().chars().collect();
    let b: Vec<char> = b.to_lowercase().chars().collect();
    let mut before = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let changed = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = changed.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                let swapped: usize = before[j - 2];
                least = least.min(swapped + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

/// A number and what it counts, as in "1 layer" and "5 layers".
pub fn counted(count: usize, what: &str) -> String {
    let ending = match (count, what.ends_with('s')) {
        (1, _) => "",
        (_, true) => "es",
        (_, false) => "s",
    };
    format!("{count} {what}{ending}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_line_the_part_around_the_mistake_is_shown() {
        for (column, begins, ends) in [
            (1, "X", "…"),
            (200, "…", "…"),
            (400, "…", "X"),
            (0, ".", "…"),
        ] {
            let mut line = ".".repeat(400);
            if column > 0 {
                line.replace_range(column - 1..column, "X");
            }
            let (shown, at) = excerpt(&line, column);
            assert!(shown.chars().count() <= WIDEST + 2, "{shown}");
            assert!(
                shown.starts_with(begins) && shown.ends_with(ends),
                "{shown}"
            );
            let under = at.checked_sub(1).and_then(|at| shown.chars().nth(at));
            assert_eq!(under, (column > 0).then_some('X'), "{column}: {shown}");
        }
        assert_eq!(excerpt("short", 3), ("short".into(), 3));
    }

    #[test]
    fn suggests_the_nearest_name_only_when_it_is_near() {
        let names = ["g_normal", "g_albedo", "depth"];
        assert_eq!(
            suggestion("g_nornal", names).as_deref(),
            Some("did you mean `g_normal`?")
        );
        assert_eq!(
            suggestion("Depth", names).as_deref(),
            Some("did you mean `depth`?")
        );
        assert_eq!(
            suggestion("detph", names).as_deref(),
            Some("did you mean `depth`?")
        );
        assert_eq!(suggestion("shadow", names), None);
        assert_eq!(nearest("normal", names), Some("g_normal"));
        assert_eq!(nearest("mal", names), None);
        for (a, b, distance) in [("", "abc", 3), ("ca", "ac", 1), ("abcd", "badc", 2)] {
            assert_eq!(edit_distance(a, b), distance);
            assert_eq!(edit_distance(b, a), distance);
        }
    }

    #[test]
    fn a_problem_shows_place_line_caret_and_help() {
        let problem = Problem::new(Place::new("a.rhai", 2, 5), "no target `x`")
            .with_source("one\ntwo x three\n")
            .with_hint("declare it");
        assert_eq!(
            problem.to_string(),
            "a.rhai:2:5: no target `x`\n    two x three\n        ^\n    help: declare it"
        );
    }
}
