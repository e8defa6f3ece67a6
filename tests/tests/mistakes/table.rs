//! Reads the table of mistakes.
//!
//! A mistake begins after an empty line, with a line of text that says what it is. Then come edits,
//! and after them the report, in lines that begin with `>`.
//!
//! An edit names a file. Of the lines below it those with `-` are in the file, once and in this
//! order, and those with `+` take their place; then others may follow. `remove`, `empty` and `cut`
//! before a file's name take it away, empty it or leave its first half. `portable` alone means a
//! device that has no more than every device has. In the report, lines of shipped files are `*`.

/// A change of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edit {
    /// The file's path.
    pub file: String,
    /// `remove`, `empty`, `cut`, or nothing.
    pub whole: String,
    /// Lines that go.
    pub from: Vec<String>,
    /// Lines that come.
    pub to: Vec<String>,
}

/// A mistake and its report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mistake {
    /// What it is.
    pub title: String,
    /// Its line in the table.
    pub line: usize,
    /// How it is made.
    pub edits: Vec<Edit>,
    /// On the device with the fewest abilities.
    pub portable: bool,
    /// Each problem as `PLACE: MESSAGE`, with the way out below it.
    pub expected: String,
}

/// Reads the table.
pub fn read(text: &str) -> Vec<Mistake> {
    let mut mistakes: Vec<Mistake> = Vec::new();
    let mut open = false;
    for (number, line) in (1..).zip(text.lines()) {
        if line.is_empty() || line.starts_with('#') {
            open = false;
            continue;
        }
        let Some(mistake) = mistakes.last_mut().filter(|_| open) else {
            mistakes.push(Mistake {
                title: line.to_owned(),
                line: number,
                ..Mistake::default()
            });
            open = true;
            continue;
        };
        if let Some(report) = line.strip_prefix("> ") {
            mistake.expected.push_str(report);
            mistake.expected.push('\n');
        } else if line == "portable" {
            mistake.portable = true;
        } else if let (Some(from), Some(edit)) = (line.strip_prefix("- "), mistake.edits.last_mut())
        {
            if edit.to.is_empty() {
                edit.from.push(from.to_owned());
            } else {
                // Another part of the same file.
                let file = edit.file.clone();
                mistake.edits.push(Edit {
                    file,
                    from: vec![from.to_owned()],
                    ..Edit::default()
                });
            }
        } else if let (Some(to), Some(edit)) = (line.strip_prefix("+ "), mistake.edits.last_mut()) {
            edit.to.push(to.to_owned());
        } else {
            let (whole, file) = line.split_once(' ').unwrap_or(("", line));
            assert!(
                ["", "remove", "empty", "cut"].contains(&whole) && file.contains('/'),
                "line {number} of the table: `{line}`"
            );
            mistake.edits.push(Edit {
                file: file.to_owned(),
                whole: whole.to_owned(),
                ..Edit::default()
            });
        }
    }
    mistakes
}
