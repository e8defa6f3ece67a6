//! Finds the line of a complaint that names none.
//!
//! The reader of WGSL has no place for operands that do not fit each other. So the text is read again
//! with parts left out: the function without whose body the complaint is gone has the mistake, and the
//! first of its lines after which the rest can be left out without losing the complaint is the line.

/// The line, counted from 1. `complains` is whether a text still makes the same complaint; `active`
/// is the text without comments and branches that are not taken, in the same lines.
pub(super) fn line_of(
    text: &str,
    active: &str,
    mut complains: impl FnMut(&str) -> bool,
) -> Option<u32> {
    let lines: Vec<&str> = text.lines().collect();
    let depths = depths(active);
    for (begin, end) in blocks(&depths) {
        if complains(&without(&lines, &depths, begin, begin, end)) {
            continue;
        }
        let mut inside = begin + 1..end;
        let found = inside.find(|line| complains(&without(&lines, &depths, *line, begin, end)));
        return Some(found.unwrap_or(begin) as u32 + 1);
    }
    None
}

/// How many braces are open after each line.
fn depths(active: &str) -> Vec<usize> {
    let mut depth = 0_usize;
    let after = active.lines().map(|line| {
        for c in line.chars() {
            match c {
                '{' => depth += 1,
                '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        depth
    });
    after.collect()
}

/// First and last line of everything in braces that takes more than one line.
fn blocks(depths: &[usize]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut begin = None;
    for (line, depth) in depths.iter().enumerate() {
        match begin {
            None if *depth > 0 => begin = Some(line),
            Some(first) if *depth == 0 => {
                found.push((first, line));
                begin = None;
            }
            _ => {}
        }
    }
    found
}

/// The text without what comes after line `last` in the block from `begin` to `end`. Directives stay.
fn without(lines: &[&str], depths: &[usize], last: usize, begin: usize, end: usize) -> String {
    let mut text = String::new();
    for (number, line) in lines.iter().enumerate() {
        let left_out = number > last && number > begin && number <= end;
        if !left_out || line.trim_start().starts_with('#') {
            text.push_str(line);
        }
        if number == end {
            text.extend(std::iter::repeat_n('}', depths[last]));
        }
        text.push('\n');
    }
    text
}

/// What such a complaint means, and the way out.
pub(super) fn in_words(message: &str) -> Option<(String, &'static str)> {
    const OPERATORS: [(&str, &str); 18] = [
        ("LogicalAnd", "&&"),
        ("LogicalOr", "||"),
        ("And", "&"),
        ("InclusiveOr", "|"),
        ("ExclusiveOr", "^"),
        ("GreaterEqual", ">="),
        ("Greater", ">"),
        ("LessEqual", "<="),
        ("Less", "<"),
        ("NotEqual", "!="),
        ("Equal", "=="),
        ("Add", "+"),
        ("Subtract", "-"),
        ("Multiply", "*"),
        ("Divide", "/"),
        ("Modulo", "%"),
        ("ShiftLeft", "<<"),
        ("ShiftRight", ">>"),
    ];
    if let Some(operands) = message.strip_prefix("Incompatible operands: ") {
        let name = operands.split('(').next().unwrap_or_default();
        let sign = OPERATORS.iter().find(|(known, _)| *known == name)?.1;
        return Some((
            format!("the two sides of a `{sign}` in this line do not fit it"),
            "numbers of one type can be added and compared; `&&` and `||` join conditions",
        ));
    }
    if ["Invalid access into ", "Invalid sub-access into "]
        .iter()
        .any(|begin| message.starts_with(begin))
    {
        return Some((
            "something in this line has no elements, but is followed by `[`".to_owned(),
            "only arrays, vectors and matrices have elements",
        ));
    }
    if message.starts_with("Function without return type") {
        return Some((
            "a function in this line gives nothing that could be used".to_owned(),
            "let it return something, as in `fn name() -> f32`",
        ));
    }
    let of_no_kind = [
        "Invalid scalar ",
        "Invalid vector ",
        "Invalid pointer ",
        "Invalid image ",
        "Index ",
        "Call to builtin ",
    ];
    of_no_kind
        .iter()
        .any(|begin| message.starts_with(begin))
        .then(|| {
            (
                "something in this line is not what it is used as".to_owned(),
                "look at the types of its parts",
            )
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_is_found_by_leaving_out_the_others() {
        let text = "struct S {\n  a: f32,\n}\nfn first() {\n  let wrong = 0;\n}\nfn second() {\n\
            \x20 if true {\n    let b = 1;\n#ifdef A\n    let c = bad;\n#endif\n    let d = 2;\n  }\n}\n";
        // Braces and directives are in pairs in everything that is tried.
        let complains = |text: &str| {
            assert_eq!(
                text.matches('{').count(),
                text.matches('}').count(),
                "{text}"
            );
            assert!(text.contains("#ifdef") && text.contains("#endif"));
            text.contains("bad")
        };
        assert_eq!(line_of(text, &text.replace('#', " "), complains), Some(11));
        assert_eq!(line_of(text, text, |_| true), None);
    }
}
