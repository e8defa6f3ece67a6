//! Random edits of a text, such as a hasty hand or a half-written file make.

use crate::Numbers;

/// Signs and characters that do not belong where they come to stand.
const ODD: [&str; 24] = [
    "\0", "\t", "\r", "\n", "é", "λ", "\u{202e}", "\u{feff}", "🙂", "`", "\"", "'", "#", "#{", "@",
    "{", "}", "(", ")", ";", "::", "/*", "//", "->",
];

/// Numbers that are at the edge of something.
const NUMBERS: [&str; 17] = [
    "0",
    "1",
    "2",
    "3",
    "7",
    "64",
    "255",
    "256",
    "65536",
    "4294967295",
    "4294967296",
    "-1",
    "0.0",
    "0.5",
    "1e30",
    "1e400",
    "100000000000000000000",
];

/// One to three random edits of a text. `others` are texts that may take its place.
pub fn mutate(text: &str, others: &[String], numbers: &mut Numbers) -> String {
    let mut text = text.to_owned();
    for _ in 0..=numbers.below(3).min(numbers.below(3)) {
        text = one_edit(&text, others, numbers);
    }
    text
}

fn one_edit(text: &str, others: &[String], numbers: &mut Numbers) -> String {
    match numbers.below(16) {
        0 | 1 => lines(text, numbers, |lines, at, _| {
            lines.remove(at);
        }),
        2 => lines(text, numbers, |lines, at, _| {
            let line = lines[at].clone();
            lines.insert(at, line);
        }),
        3 => lines(text, numbers, |lines, at, other| lines.swap(at, other)),
        4 | 5 => tokens(text, numbers, |tokens, at, other, _| tokens.swap(at, other)),
        6 => tokens(text, numbers, |tokens, at, _, _| {
            tokens.remove(at);
        }),
        7 => tokens(text, numbers, |tokens, at, _, _| {
            let token = tokens[at].clone();
            tokens.insert(at, token);
        }),
        8 | 9 => tokens(text, numbers, |tokens, at, other, _| {
            tokens[at] = tokens[other].clone();
        }),
        10 | 11 => change_number(text, numbers),
        12 => change_letter(text, numbers),
        13 => {
            let cut = boundary(text, numbers.below(text.len() + 1));
            text[..cut].to_owned()
        }
        14 => {
            let at = boundary(text, numbers.below(text.len() + 1));
            format!(
                "{}{}{}",
                &text[..at],
                ODD[numbers.below(ODD.len())],
                &text[at..]
            )
        }
        _ => match numbers.below(4) {
            0 => String::new(),
            1 => {
                let (a, b) = (numbers.below(text.len() + 1), numbers.below(text.len() + 1));
                let (from, to) = (boundary(text, a.min(b)), boundary(text, a.max(b)));
                format!("{}{}", &text[..from], &text[to..])
            }
            _ => others[numbers.below(others.len())].clone(),
        },
    }
}

/// The nearest place at or before a byte where the text can be cut.
fn boundary(text: &str, byte: usize) -> usize {
    (0..=byte)
        .rev()
        .find(|at| text.is_char_boundary(*at))
        .unwrap_or(0)
}

fn lines(
    text: &str,
    numbers: &mut Numbers,
    edit: impl FnOnce(&mut Vec<String>, usize, usize),
) -> String {
    let mut lines: Vec<String> = text.split('\n').map(str::to_owned).collect();
    let (at, other) = (numbers.below(lines.len()), numbers.below(lines.len()));
    edit(&mut lines, at, other);
    lines.join("\n")
}

/// Words and signs, without the blanks between them and mostly outside of comments.
fn tokens(
    text: &str,
    numbers: &mut Numbers,
    edit: impl FnOnce(&mut Vec<String>, usize, usize, &mut Numbers),
) -> String {
    let mut pieces: Vec<String> = Vec::new();
    for c in text.chars() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        match pieces.last_mut() {
            Some(last) if word(c) && last.chars().all(word) => last.push(c),
            Some(last) if c.is_whitespace() && last.chars().all(char::is_whitespace) => {
                last.push(c)
            }
            _ => pieces.push(c.to_string()),
        }
    }
    let mut in_comment = false;
    let mut solid: Vec<usize> = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        if piece == "/" && pieces.get(index + 1).is_some_and(|next| next == "/") {
            in_comment = true;
        }
        if piece.contains('\n') {
            in_comment = false;
        }
        if !in_comment && !piece.trim().is_empty() {
            solid.push(index);
        }
    }
    if solid.is_empty() {
        return text.to_owned();
    }
    let first = numbers.below(solid.len());
    // Neighbours are swapped more often than strangers.
    let second = match numbers.below(2) {
        0 => (first + 1 + numbers.below(3)).min(solid.len() - 1),
        _ => numbers.below(solid.len()),
    };
    edit(&mut pieces, solid[first], solid[second], numbers);
    pieces.concat()
}

fn change_number(text: &str, numbers: &mut Numbers) -> String {
    tokens(text, numbers, |pieces, _, _, numbers| {
        let digits: Vec<usize> = (0..pieces.len())
            .filter(|index| pieces[*index].starts_with(|c: char| c.is_ascii_digit()))
            .collect();
        if digits.is_empty() {
            return;
        }
        let at = digits[numbers.below(digits.len())];
        let value = pieces[at]
            .trim_end_matches(char::is_alphabetic)
            .parse::<i64>();
        pieces[at] = match (value, numbers.below(3)) {
            (Ok(value), 0) => (value + 1).to_string(),
            (Ok(value), 1) => (value - 1).to_string(),
            _ => NUMBERS[numbers.below(NUMBERS.len())].to_owned(),
        };
    })
}

/// A slip of the finger in a word.
fn change_letter(text: &str, numbers: &mut Numbers) -> String {
    tokens(text, numbers, |pieces, at, _, numbers| {
        let mut letters: Vec<char> = pieces[at].chars().collect();
        let letter = numbers.below(letters.len());
        match numbers.below(3) {
            0 => {
                letters.remove(letter);
            }
            1 => letters.insert(letter, letters[letter]),
            _ => letters[letter] = char::from(b'a' + numbers.below(26) as u8),
        }
        pieces[at] = letters.into_iter().collect();
    })
}
