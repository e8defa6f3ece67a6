//! Studies on the command line: from arguments to a plan, the processes that measure it, and what is
//! written of it.

pub mod against;
pub mod bundle;
pub mod merge;
pub mod outcome;
pub mod plan;
pub mod running;
pub mod worker;

use std::env;

/// A scene's name from its path.
pub fn scene_name(path: &str) -> String {
    let file = path.rsplit('/').next().unwrap_or_default();
    file.strip_suffix(".rhai").unwrap_or(file).to_owned()
}

/// The time, RFC 3339.
pub fn now() -> String {
    let now = jiff::Timestamp::now();
    now.strftime("%Y-%m-%dT%H:%M:%SZ").to_string()
}

/// The command that is running, as a POSIX shell takes it again.
pub fn this_command() -> String {
    let arguments = env::args_os().skip(1);
    command_line(arguments.map(|a| a.to_string_lossy().into_owned()))
}

/// A command as a POSIX shell takes it again.
fn command_line(arguments: impl Iterator<Item = String>) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./,=:+@%".contains(c);
    let mut line = "lightbench".to_owned();
    for argument in arguments {
        line.push(' ');
        if !argument.is_empty() && argument.chars().all(plain) {
            line.push_str(&argument);
        } else {
            line.push_str(&format!("'{}'", argument.replace('\'', r"'\''")));
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_can_be_typed_again() {
        let words = ["compare", "a b", "--out", "práctica/x", "it's", ""].map(str::to_owned);
        assert_eq!(
            command_line(words.into_iter()),
            r"lightbench compare 'a b' --out práctica/x 'it'\''s' ''"
        );
    }
}
