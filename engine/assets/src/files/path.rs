//! Relative paths of a project: Unicode, forward slashes, no way out.

use super::FileError;

/// Whether a path may be used in a project, on every system.
///
/// # Errors
/// What is wrong with it, in words.
pub fn check(path: &str) -> Result<(), FileError> {
    let reason = if path.is_empty() {
        "it is empty"
    } else if path.contains('\\') {
        "write forward slashes, /"
    } else if path.starts_with('/') {
        "it must be relative to the project's folder"
    } else if path.contains(':') {
        "it must be relative to the project's folder, and a colon is not portable"
    } else if path.chars().any(char::is_control) {
        "it has a control character in it"
    } else if path.split('/').any(|part| part == "..") {
        "`..` would lead out of a folder; name the file from the project's folder"
    } else if path.split('/').any(|part| part.is_empty() || part == ".") {
        "it has an empty part; write each folder once, with one slash"
    } else {
        return Ok(());
    };
    Err(FileError::BadPath {
        path: path.to_owned(),
        reason,
    })
}

/// The path of what a file names relative to itself, such as a picture in a
/// material library. Back slashes count as forward ones, and `..` goes up, but
/// not out of the project or the granted folder.
///
/// # Errors
/// A path that would lead out.
pub fn join(from_file: &str, relative: &str) -> Result<String, FileError> {
    let bad = |reason| FileError::BadPath {
        path: relative.to_owned(),
        reason,
    };
    let relative_slashes = relative.replace('\\', "/");
    if relative_slashes.starts_with('/') || relative_slashes.contains(':') {
        return Err(bad("it must be relative to the file that names it"));
    }
    let mut parts: Vec<&str> = from_file.split('/').collect();
    parts.pop();
    // The first part of a granted path stands for its folder.
    let root = usize::from(from_file.starts_with(super::GRANT_PREFIX));
    for part in relative_slashes.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.len() > root => {
                parts.pop();
            }
            ".." => return Err(bad("it leads out of the folder that may be read")),
            part => parts.push(part),
        }
    }
    let path = parts.join("/");
    check(&path)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn paths_that_lead_out_are_refused() {
        for path in [
            "",
            "/etc/passwd",
            "..",
            "../x",
            "a/../../x",
            "a/..",
            "./a",
            "a//b",
            "a/",
            "C:/x",
            "C:x",
            "a\\b",
            "\\\\host\\x",
            "a\0b",
            "a\nb",
            "//host/x",
            ".",
        ] {
            let error = check(path).unwrap_err();
            assert!(matches!(error, FileError::BadPath { .. }), "{path}");
        }
        for path in [
            "a",
            "a/b.c",
            "práctica 1 ñ/файл.rhai",
            "日本/🎈.obj",
            "a..b",
            "...",
            "@x",
        ] {
            check(path).unwrap();
        }
    }

    #[test]
    fn joining_goes_up_but_not_out() {
        assert_eq!(join("models/a/x.obj", "x.mtl").unwrap(), "models/a/x.mtl");
        assert_eq!(
            join("models/a/x.obj", "../maps\\w d.png").unwrap(),
            "models/maps/w d.png"
        );
        assert_eq!(join("x.obj", "./x.mtl").unwrap(), "x.mtl");
        assert_eq!(join("@0/x.obj", "maps/x.png").unwrap(), "@0/maps/x.png");
        assert!(join("@0/x.obj", "../x.png").is_err());
        assert!(join("x.obj", "../x.png").is_err());
        assert!(join("x.obj", "/etc/passwd").is_err());
        assert!(join("x.obj", "C:\\maps\\x.png").is_err());
        assert!(join("x.obj", "").is_err());
    }
}
