//! Words and signs of shaders and scripts, without comments and blanks.

/// A kind of token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Name,
    Number,
    Text,
    Sign,
}

/// A word, a number, a text in quotes, or a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind,
    /// As it is written; of a text, what stands between its quotes.
    pub(super) text: &'a str,
    /// The line, from 1.
    pub(super) line: u32,
}

impl Token<'_> {
    pub(super) fn is(&self, text: &str) -> bool {
        self.text == text && self.kind != Kind::Text
    }
}

/// Splits a file. Texts are looked for in scripts alone: shaders have none. Each sign is a token of
/// its own, but for `::`.
pub(super) fn tokens(code: &str, has_texts: bool) -> Vec<Token<'_>> {
    let bytes = code.as_bytes();
    let mut found = Vec::new();
    let (mut at, mut line) = (0, 1_u32);
    while let Some(c) = code[at..].chars().next() {
        let rest = &code[at..];
        let end = if c.is_whitespace() {
            at + c.len_utf8()
        } else if rest.starts_with("//") {
            rest.find('\n').map_or(code.len(), |length| at + length)
        } else if rest.starts_with("/*") {
            at + comment(rest)
        } else if has_texts && matches!(c, '"' | '`' | '\'') {
            let (end, length) = quoted(rest, c);
            found.push(Token {
                kind: Kind::Text,
                text: &rest[1..end],
                line,
            });
            at + length
        } else if c.is_alphanumeric() || c == '_' {
            let number = c.is_ascii_digit();
            let belongs = |c: char| c.is_alphanumeric() || c == '_' || (number && c == '.');
            let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
            let kind = if number { Kind::Number } else { Kind::Name };
            found.push(Token {
                kind,
                text: &rest[..length],
                line,
            });
            at + length
        } else {
            let length = if rest.starts_with("::") {
                2
            } else {
                c.len_utf8()
            };
            found.push(Token {
                kind: Kind::Sign,
                text: &rest[..length],
                line,
            });
            at + length
        };
        line += bytes[at..end].iter().filter(|byte| **byte == b'\n').count() as u32;
        at = end;
    }
    found
}

/// The length of a block comment, which may hold others.
fn comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest.starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// Where a text ends before its last quote, and behind it; the end of the file where it is not closed.
fn quoted(text: &str, quote: char) -> (usize, usize) {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        if escaped {
            escaped = false;
        } else if c == '\\' && quote != '`' {
            escaped = true;
        } else if c == quote {
            return (at, at + c.len_utf8());
        }
    }
    (text.len(), text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(code: &str, has_texts: bool) -> Vec<&str> {
        tokens(code, has_texts)
            .iter()
            .map(|token| token.text)
            .collect()
    }

    #[test]
    fn comments_and_blanks_are_left_out() {
        let code = "fn a() { // one\n/* two /* three */ */ let b = 1.5e3; }";
        assert_eq!(
            texts(code, false),
            ["fn", "a", "(", ")", "{", "let", "b", "=", "1.5e3", ";", "}"]
        );
        let lines: Vec<u32> = tokens(code, false).iter().map(|token| token.line).collect();
        assert_eq!(lines, [1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2]);
    }

    #[test]
    fn texts_are_one_token() {
        let code = "p.shader(\"a // \\\" b\").x(`c`) é::f";
        let found = tokens(code, true);
        let in_quotes: Vec<&str> = found
            .iter()
            .filter(|t| t.kind == Kind::Text)
            .map(|t| t.text)
            .collect();
        assert_eq!(in_quotes, ["a // \\\" b", "c"]);
        assert_eq!(texts("é::f", true), ["é", "::", "f"]);
        assert_eq!(texts("\"never closed é", true), ["never closed é"]);
        assert_eq!(texts("/* never closed", true).len(), 0);
        assert_eq!(texts("\"", true), [""]);
    }
}
