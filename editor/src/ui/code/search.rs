//! Finding words in a text.

use std::ops::Range;

/// Places that are found at most: more are not looked at one by one.
const MOST: usize = 10_000;

/// All places of a text at which something stands, in bytes, none over another.
pub fn find_all(text: &str, wanted: &str, match_case: bool) -> Vec<Range<usize>> {
    if wanted.is_empty() {
        return Vec::new();
    }
    if match_case {
        let found = text.match_indices(wanted).take(MOST);
        return found.map(|(at, word)| at..at + word.len()).collect();
    }
    let wanted: Vec<char> = wanted.chars().flat_map(char::to_lowercase).collect();
    let mut found = Vec::new();
    let mut rest = text.char_indices();
    while let Some((at, _)) = rest.clone().next() {
        match length_of_match(&text[at..], &wanted) {
            Some(length) => {
                found.push(at..at + length);
                if found.len() == MOST {
                    return found;
                }
                while rest
                    .clone()
                    .next()
                    .is_some_and(|(next, _)| next < at + length)
                {
                    rest.next();
                }
            }
            None => _ = rest.next(),
        }
    }
    found
}

/// The bytes at the beginning of a text that are the letters wanted, small or capital.
fn length_of_match(text: &str, wanted: &[char]) -> Option<usize> {
    let mut left = wanted.iter();
    for (at, letter) in text.char_indices() {
        if left.len() == 0 {
            return Some(at);
        }
        for small in letter.to_lowercase() {
            if left.next() != Some(&small) {
                return None;
            }
        }
    }
    (left.len() == 0).then_some(text.len())
}

/// Where the letter is that begins at a byte, counted in letters as the text field counts.
pub fn letters_before(text: &str, byte: usize) -> usize {
    text[..byte].chars().count()
}

/// The byte at which a letter begins, or the end of the text.
pub fn byte_of(text: &str, letters: usize) -> usize {
    let mut starts = text.char_indices();
    starts.nth(letters).map_or(text.len(), |(at, _)| at)
}

/// The byte at which a line begins, counted from 1, with the column in letters, counted from 1;
/// beyond the end of the line or the text it is that end.
pub fn byte_of_place(text: &str, line: usize, column: usize) -> usize {
    let mut start = 0;
    let mut content = "";
    for (index, piece) in text.split_inclusive('\n').enumerate() {
        if index + 1 == line.max(1) {
            content = piece.trim_end_matches('\n');
            break;
        }
        start += piece.len();
    }
    start + byte_of(content, column.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_with_and_without_regard_to_case() {
        let text = "Light light LIGHTlight";
        assert_eq!(find_all(text, "light", true), [6..11, 17..22]);
        assert_eq!(
            find_all(text, "lIght", false),
            [0..5, 6..11, 12..17, 17..22]
        );
        assert!(find_all(text, "", false).is_empty());
        assert_eq!(
            find_all("aaa", "aa", false),
            std::slice::from_ref(&(0..2)),
            "none over another"
        );
        assert_eq!(find_all("aaa", "aa", true), std::slice::from_ref(&(0..2)));
    }

    #[test]
    fn letters_of_several_bytes_keep_places_right() {
        let text = "Größe größe İx";
        assert!(find_all(text, "GRÖSSE", false).is_empty());
        assert_eq!(find_all(text, "größe", false), [0..7, 8..15]);
        // This capital letter is two small ones.
        assert_eq!(find_all(text, "x", false), std::slice::from_ref(&(18..19)));
        assert_eq!(letters_before(text, 8), 6);
        assert_eq!(byte_of(text, 6), 8);
        assert_eq!(byte_of(text, 999), text.len());
    }

    #[test]
    fn places_of_lines_and_columns() {
        let text = "ab\nöde\n\nlast";
        assert_eq!(byte_of_place(text, 1, 1), 0);
        assert_eq!(byte_of_place(text, 2, 1), 3);
        assert_eq!(byte_of_place(text, 2, 2), 5);
        assert_eq!(byte_of_place(text, 2, 99), 7);
        assert_eq!(byte_of_place(text, 3, 0), 8);
        assert_eq!(byte_of_place(text, 4, 0), 9);
        assert_eq!(byte_of_place(text, 99, 5), text.len());
    }
}
