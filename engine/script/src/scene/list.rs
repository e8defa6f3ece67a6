//! Which scenes there are.

use lightbench_assets::files::{FileError, Files, Origin};

use super::SCENES;
use super::saved::EXTENSION;
use crate::host::stem_in;

/// A scene that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneEntry {
    /// Short name for the command line.
    pub name: String,
    /// Its file.
    pub path: String,
    /// The first line of the comment at its top; the name where there is none.
    pub title: String,
    /// The rest of that comment, to its first empty line.
    pub description: String,
    /// Which layer the file comes from.
    pub origin: Origin,
}

/// All scenes, those of the project over those of the program, by name: scripts first, then files
/// that hold a world.
///
/// Title and description are read from the comment at the top of the file; no script is run.
///
/// # Errors
/// A folder that can't be read.
pub fn list_scenes(files: &Files) -> Result<Vec<SceneEntry>, FileError> {
    let mut entries = Vec::new();
    for file in files.list(SCENES, "rhai")? {
        let Some(name) = stem_in(SCENES, &file.path).map(str::to_owned) else {
            continue;
        };
        let text = files.read_text(&file.path).unwrap_or_default();
        let (title, description) = introduction(&text);
        entries.push(SceneEntry {
            title: if title.is_empty() {
                name.clone()
            } else {
                title
            },
            name,
            path: file.path,
            description,
            origin: file.origin,
        });
    }
    // A file that holds a world is asked for by its path, and its name says what it is.
    for file in files.list(SCENES, EXTENSION)? {
        let name = file.path.rsplit('/').next().unwrap_or(&file.path);
        let title = name.to_owned();
        entries.push(SceneEntry {
            title,
            name: file.path.clone(),
            path: file.path,
            description: String::new(),
            origin: file.origin,
        });
    }
    Ok(entries)
}

/// The first line of the comment at the top, and the lines after it up to an empty one.
fn introduction(text: &str) -> (String, String) {
    let mut comment = text
        .lines()
        .map_while(|line| line.trim_start().strip_prefix("//"))
        .map(str::trim);
    let title = comment.next().unwrap_or_default().trim_end_matches('.');
    let description: Vec<&str> = comment
        .skip_while(|line| line.is_empty())
        .take_while(|line| !line.is_empty())
        .collect();
    (title.to_owned(), description.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn introductions() {
        let text = "// Many lights.\n//\n// Shows how\n// cost grows.\n//\n// More.\nlet x = 1;";
        let (title, description) = introduction(text);
        assert_eq!(
            (title.as_str(), description.as_str()),
            ("Many lights", "Shows how cost grows.")
        );
        assert_eq!(
            introduction("let x = 1; // no"),
            (String::new(), String::new())
        );
    }
}
