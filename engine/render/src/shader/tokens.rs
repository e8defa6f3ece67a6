//! The words of a WGSL text with their places: enough to find where a name is declared.

/// A word, a number or a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'a> {
    /// What is written.
    pub text: &'a str,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

impl Token<'_> {
    /// Whether it is a name, a keyword or a number.
    pub fn is_word(&self) -> bool {
        self.text.starts_with(is_word)
    }
}

/// Whether a character belongs to words.
pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Splits a text without comments. Each sign is a token of its own.
pub fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    for (line, row) in (1..).zip(text.split('\n')) {
        let mut rest = row.char_indices().zip(1..).peekable();
        while let Some(((begin, first), column)) = rest.next() {
            if first.is_whitespace() {
                continue;
            }
            let mut end = begin + first.len_utf8();
            if is_word(first) {
                while let Some(((at, c), _)) = rest.next_if(|((_, c), _)| is_word(*c)) {
                    end = at + c.len_utf8();
                }
            }
            found.push(Token {
                text: &row[begin..end],
                line,
                column,
            });
        }
    }
    found
}

/// The text with blanks in place of comments; lines and columns stay.
pub fn without_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut depth = 0_u32;
    let mut in_line = false;
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let next = rest.peek().copied();
        if c == '\n' {
            in_line = false;
            plain.push('\n');
        } else if in_line {
            plain.push(' ');
        } else if depth == 0 && (c, next) == ('/', Some('/')) {
            in_line = true;
            plain.push(' ');
        } else if (c, next) == ('/', Some('*')) || (depth > 0 && (c, next) == ('*', Some('/'))) {
            // WGSL's block comments nest.
            depth = if c == '/' { depth + 1 } else { depth - 1 };
            rest.next();
            plain.push_str("  ");
        } else {
            plain.push(if depth > 0 { ' ' } else { c });
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_know_their_places() {
        let found = tokens("fn é_1(a:f32)\n\t-> x");
        let found: Vec<_> = found.iter().map(|t| (t.text, t.line, t.column)).collect();
        let expected = [
            ("fn", 1, 1),
            ("é_1", 1, 4),
            ("(", 1, 7),
            ("a", 1, 8),
            (":", 1, 9),
            ("f32", 1, 10),
            (")", 1, 13),
            ("-", 2, 2),
            (">", 2, 3),
            ("x", 2, 5),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn comments_leave_blanks() {
        assert_eq!(
            without_comments("a // b\nc /* d /* e */ \n f */ g / h"),
            "a     \nc              \n      g / h"
        );
        assert_eq!(without_comments("a /* b"), "a     ");
    }
}
