//! What keys do to a text beyond single letters: indentation and comments.
//!
//! Each function takes the text and the letters that are chosen, counted from 0, and gives what
//! takes their place.

use std::ops::Range;

use super::search::{byte_of, letters_before};

/// What scripts and shaders are indented by.
const INDENT: &str = "    ";

/// A piece of the text that is replaced, in bytes, and the letters that are chosen after that.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub range: Range<usize>,
    /// What takes its place.
    pub with: String,
    /// The letters that are chosen then.
    pub chosen: Range<usize>,
}

impl Edit {
    /// Makes the change.
    pub fn apply(&self, text: &mut String) {
        text.replace_range(self.range.clone(), &self.with);
    }
}

/// The bytes of all lines that the chosen letters touch, without the last line's end.
fn lines_of(text: &str, chosen: &Range<usize>) -> Range<usize> {
    let (from, to) = (byte_of(text, chosen.start), byte_of(text, chosen.end));
    let start = text[..from].rfind('\n').map_or(0, |at| at + 1);
    // What ends before the first letter of a line does not touch it.
    let last = if to > from && text[..to].ends_with('\n') {
        to - 1
    } else {
        to
    };
    let end = text[last..].find('\n').map_or(text.len(), |at| last + at);
    start..end
}

/// What Enter writes, after what stands before it in its line: the next line begins where this one
/// does, and further in after a brace.
pub fn line_break(before: &str) -> String {
    let indent = &before[..before.len() - before.trim_start_matches([' ', '\t']).len()];
    let opens = before.trim_end().ends_with(['{', '(', '[']);
    format!("\n{indent}{}", if opens { INDENT } else { "" })
}

/// What Tab writes, after what stands before it in its line: blanks up to the next column of four.
pub fn blanks(before: &str) -> String {
    let column = before.chars().count();
    " ".repeat(INDENT.len() - column % INDENT.len())
}

/// What stands before a letter in its line.
pub fn line_before(text: &str, letter: usize) -> &str {
    let before = &text[..byte_of(text, letter)];
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    &before[start..]
}

/// Whether the letters lie in several lines.
pub fn has_lines(text: &str, chosen: &Range<usize>) -> bool {
    text[byte_of(text, chosen.start)..byte_of(text, chosen.end)].contains('\n')
}

/// Tab with several lines chosen: they go in.
pub fn indent(text: &str, chosen: &Range<usize>) -> Edit {
    each_line(text, chosen, |line| match line {
        "" => String::new(),
        line => format!("{INDENT}{line}"),
    })
}

/// Shift and Tab: the lines go out.
pub fn outdent(text: &str, chosen: &Range<usize>) -> Edit {
    each_line(text, chosen, |line| {
        let blanks = line.bytes().take(INDENT.len());
        let blanks = blanks.take_while(|byte| *byte == b' ').count();
        line[blanks..].to_owned()
    })
}

/// Makes comments of the lines, or no longer where all are.
pub fn toggle_comment(text: &str, chosen: &Range<usize>, sign: &str) -> Edit {
    let lines = &text[lines_of(text, chosen)];
    let mut written = lines.lines().filter(|line| !line.trim().is_empty());
    let all = written
        .clone()
        .all(|line| line.trim_start().starts_with(sign));
    let inset = |line: &str| line.len() - line.trim_start().len();
    let least = written.clone().map(inset).min().unwrap_or(0);
    let remove = all && written.next().is_some();
    each_line(text, chosen, |line| {
        if line.trim().is_empty() {
            return line.to_owned();
        }
        if !remove {
            return format!("{}{sign} {}", &line[..least], &line[least..]);
        }
        let rest = line.trim_start().strip_prefix(sign).unwrap_or_default();
        let rest = rest.strip_prefix(' ').unwrap_or(rest);
        format!("{}{rest}", &line[..inset(line)])
    })
}

fn each_line(text: &str, chosen: &Range<usize>, change: impl Fn(&str) -> String) -> Edit {
    let range = lines_of(text, chosen);
    let lines: Vec<String> = text[range.clone()].split('\n').map(change).collect();
    let with = lines.join("\n");
    let first = letters_before(text, range.start);
    let (before, after) = (text[range.clone()].chars().count(), with.chars().count());
    let chosen = if chosen.is_empty() {
        // The caret stays at its letter.
        let end = first + after;
        let caret = (chosen.start + after)
            .saturating_sub(before)
            .clamp(first, end);
        caret..caret
    } else {
        first..first + after
    };
    Edit {
        range,
        with,
        chosen,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn done(text: &str, edit: &Edit) -> (String, Range<usize>) {
        let mut text = text.to_owned();
        edit.apply(&mut text);
        (text, edit.chosen.clone())
    }

    #[test]
    fn a_new_line_keeps_the_indentation_and_goes_in_after_a_brace() {
        assert_eq!(line_break("  if a { "), "\n      ");
        assert_eq!(line_break("\té"), "\n\t");
        assert_eq!(line_break("a"), "\n");
        assert_eq!(line_before("é\n  ab", 5), "  a");
        assert_eq!(line_before("é\n  ab", 1), "é");
        assert_eq!(line_before("é\n", 2), "");
    }

    #[test]
    fn tab_writes_blanks_or_moves_lines() {
        assert_eq!(blanks("äb"), "  ");
        assert_eq!(blanks(""), "    ");
        assert!(has_lines("a\nb", &(0..2)));
        assert!(!has_lines("a\nb", &(0..1)));
        let text = "a\n\n b\nc";
        let edit = indent(text, &(0..5));
        assert_eq!(done(text, &edit), ("    a\n\n     b\nc".to_owned(), 0..13));
        let edit = outdent("      a\n b\n", &(0..11));
        assert_eq!(done("      a\n b\n", &edit), ("  a\nb\n".to_owned(), 0..5));
        let edit = outdent("    a", &(5..5));
        assert_eq!(done("    a", &edit), ("a".to_owned(), 1..1));
    }

    #[test]
    fn comments_come_and_go() {
        let text = "  a\n\n    b\n";
        let edit = toggle_comment(text, &(0..9), "//");
        let (commented, chosen) = done(text, &edit);
        assert_eq!(commented, "  // a\n\n  //   b\n");
        let edit = toggle_comment(&commented, &chosen, "//");
        assert_eq!(done(&commented, &edit).0, text);
        let edit = toggle_comment("", &(0..0), "//");
        assert_eq!(done("", &edit), (String::new(), 0..0));
    }
}
