//! The functions that pipelines share, from the files in which they are written.

use std::fmt::Write as _;

use lightbench_assets::files::{FileError, Files};

use super::functions::wrapped;

/// The heading.
const PARTS: &str = "Parts";
/// Where the files lie.
pub(super) const FOLDER: &str = "scripts/pipelines/parts";

/// A file of functions.
struct Part {
    name: String,
    script: String,
}

fn read(files: &Files) -> Result<Vec<Part>, FileError> {
    let listed = files.list(FOLDER, "rhai")?;
    let read = |path: &str| {
        let name = path.rsplit('/').next().unwrap_or_default();
        Ok(Part {
            name: name.trim_end_matches(".rhai").to_owned(),
            script: files.read_text(path)?,
        })
    };
    listed.iter().map(|file| read(&file.path)).collect()
}

/// The section, as Markdown: each file with what its header says, and its functions with their
/// comments.
///
/// # Errors
/// A file that can't be read.
pub(super) fn parts(files: &Files) -> Result<String, FileError> {
    let mut text = format!("\n## {PARTS}\n\n{}", include_str!("prose/parts.txt"));
    for Part { name, script } in read(files)? {
        let header = script.lines().map_while(|line| line.strip_prefix("// "));
        // Writing to a text can't fail.
        let _ = write!(
            text,
            "\n### `import \"pipelines/parts/{name}\" as {name};`\n\n{}\n",
            wrapped(&header.collect::<Vec<_>>().join(" "))
        );
        for (form, about) in functions(&script) {
            text += &wrapped(&format!("- `{name}::{form}`: {about}"));
        }
    }
    Ok(text)
}

/// The section's row in the table of all functions.
///
/// # Errors
/// A file that can't be read.
pub(super) fn parts_row(files: &Files) -> Result<String, FileError> {
    let mut names = Vec::new();
    for Part { name, script } in read(files)? {
        for (form, _) in functions(&script) {
            let function = form.split('(').next().unwrap_or_default();
            names.push(format!("`{name}::{function}`"));
        }
    }
    let anchor = PARTS.to_lowercase();
    Ok(format!("| [{PARTS}](#{anchor}) | {} |\n", names.join(", ")))
}

/// The functions of a script: how each is called, and the comment above it.
pub(super) fn functions(script: &str) -> Vec<(&str, String)> {
    let mut found = Vec::new();
    let mut about: Vec<&str> = Vec::new();
    for line in script.lines() {
        if let Some(comment) = line.strip_prefix("///") {
            about.push(comment.trim());
            continue;
        }
        let form = line.strip_prefix("fn ");
        if let Some(form) = form.and_then(|form| form.strip_suffix(" {")) {
            found.push((form, about.join(" ")));
        }
        about.clear();
    }
    found
}
