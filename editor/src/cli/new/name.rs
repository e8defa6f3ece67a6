//! What pipelines and lessons may be called.

/// The longest name, in characters. With four bytes for each and an ending, a file's name stays
/// below the 255 bytes that common file systems allow.
const LONGEST: usize = 50;

/// Names that Windows keeps for devices, with any ending (Microsoft, "Naming Files, Paths, and
/// Namespaces").
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];
/// The same, with a digit behind.
const NUMBERED_DEVICES: [&str; 2] = ["com", "lpt"];

/// Whether something of that name, a pipeline or a lesson, can have files on every system, and can be named in a command:
/// a dot, a comma or a slash would mean something there.
///
/// # Errors
/// What is wrong, with a name that would do.
pub fn check(name: &str, what: &str) -> Result<(), String> {
    let stem = name.strip_suffix(".rhai").unwrap_or(name);
    let reason = if stem != name {
        return Err(format!(
            "`{name}` is the name of a file, not of a {what}{}",
            way_out(stem)
        ));
    } else if name.is_empty() {
        "is empty"
    } else if let Some(bad) = name.chars().find(|c| !allowed(*c)) {
        return Err(format!(
            "`{}` can't be in a {what}'s name: letters, digits, `_` and `-` can{}",
            bad.escape_debug(),
            way_out(stem)
        ));
    } else if !name.starts_with(char::is_alphanumeric) {
        "does not begin with a letter or a digit"
    } else if name.chars().count() > LONGEST {
        return Err(format!(
            "the name has {} characters; a {what}'s name has at most {LONGEST}",
            name.chars().count()
        ));
    } else if is_device(name) {
        "is a device on Windows, so no file can have that name there"
    } else {
        return Ok(());
    };
    Err(format!("`{name}` {reason}{}", way_out(stem)))
}

fn allowed(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_' || letter == '-'
}

fn is_device(name: &str) -> bool {
    let name = name.to_lowercase();
    DEVICES.contains(&name.as_str())
        || NUMBERED_DEVICES.iter().any(|device| {
            let digit = name.strip_prefix(device).unwrap_or_default();
            digit.len() == 1 && digit.chars().all(|c| c.is_ascii_digit())
        })
}

/// The nearest name that is allowed: "; try `my_pipeline`".
fn way_out(name: &str) -> String {
    let mut better = String::new();
    for letter in name.chars() {
        if allowed(letter) {
            better.push(letter);
        } else if !better.ends_with('_') {
            better.push('_');
        }
    }
    let better = better.trim_matches(['_', '-']);
    let better: String = better.chars().take(LONGEST).collect();
    if better.is_empty() {
        return "; try `mine`".to_owned();
    }
    if is_device(&better) {
        return format!("; try `my_{better}`");
    }
    format!("; try `{better}`")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn names_that_every_system_can_store_are_taken() {
        for name in [
            "mine",
            "Mine_2",
            "2nd-try",
            "iluminación",
            "свет",
            "光",
            "console",
            "com",
            "com10",
            "lpt1_b",
        ] {
            assert_eq!(check(name, "pipeline"), Ok(()), "{name}");
        }
    }

    #[test]
    fn others_are_refused_with_one_that_would_do() {
        for (name, part, better) in [
            ("", "is empty", "`mine`"),
            ("my pipeline", "` ` can't be in", "`my_pipeline`"),
            ("a/b", "`/` can't", "`a_b`"),
            ("..\\up", "`.` can't", "`up`"),
            ("../../up", "`.` can't", "`up`"),
            ("a:b", "`:` can't", "`a_b`"),
            ("a,b", "`,` can't", "`a_b`"),
            ("v1.2", "`.` can't", "`v1_2`"),
            ("what?", "`?` can't", "`what`"),
            ("tab\there", "`\\t` can't", "`tab_here`"),
            ("mine.rhai", "name of a file", "`mine`"),
            ("-x", "does not begin", "`x`"),
            ("_", "does not begin", "`mine`"),
            ("CON", "device", "`my_CON`"),
            ("lpt7", "device", "`my_lpt7`"),
            ("con.rhai", "name of a file", "`my_con`"),
            // An accent as a letter of its own: systems disagree on whether that is another name.
            ("iluminacio\u{301}n", "can't be in", "`iluminacio_n`"),
            ("***", "`*` can't", "`mine`"),
        ] {
            let said = check(name, "pipeline").unwrap_err();
            assert!(said.contains(part), "{name}: {said}");
            assert!(said.contains(&format!("try {better}")), "{name}: {said}");
        }
        let long = "x".repeat(51);
        assert!(check(&long, "pipeline").unwrap_err().contains("at most 50"));
        assert_eq!(check(&long[1..], "pipeline"), Ok(()));
    }
}
