//! From what a person typed to files: the project, scenes, pipelines and models.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use lightbench::assets::files::{Files, Origin, find_project};

/// The project's files over the shipped ones: those of `--project`, else those of the project that
/// the current folder belongs to, else only the shipped ones.
///
/// # Errors
/// A folder that is not there or can't be read.
pub fn open(project: Option<&Path>) -> anyhow::Result<Files> {
    if let Some(folder) = project {
        return Files::with_project(folder)
            .with_context(|| format!("--project {} can't be opened", folder.display()));
    }
    // Without a current folder there is no project either.
    match find_project(".") {
        Some(folder) => Ok(Files::with_project(folder)?),
        None => Ok(Files::shipped()),
    }
}

/// What the loader of a script takes: a name as it is; a path to a file anywhere on the disk, let
/// in; else the path of a file in the project or the program.
///
/// # Errors
/// A path to nothing.
pub fn script(files: &mut Files, name_or_path: &str) -> anyhow::Result<String> {
    let is_path = name_or_path.contains(['/', '\\'])
        || [".rhai", ".scene"]
            .iter()
            .any(|end| name_or_path.ends_with(end));
    let on_disk = Path::new(name_or_path);
    if !is_path {
        return Ok(name_or_path.to_owned());
    }
    if !on_disk.exists() && files.exists(name_or_path) {
        return Ok(name_or_path.to_owned());
    }
    Ok(files.grant(on_disk)?)
}

/// The path under which a file in the current folder, in the project or in the program is read.
///
/// # Errors
/// A file that is in none of them.
pub fn path_in_project(files: &Files, path: &str) -> anyhow::Result<String> {
    let path = path.replace('\\', "/");
    let path = path.trim_start_matches("./");
    if files.exists(path) {
        return Ok(path.to_owned());
    }
    // In a folder below the project's top, paths are those that the shell completes.
    let below = || {
        let here = std::fs::canonicalize(".").ok()?;
        let below = here.strip_prefix(files.project()?).ok()?.join(path);
        let parts: Option<Vec<&str>> = below.iter().map(|part| part.to_str()).collect();
        Some(parts?.join("/")).filter(|path| files.exists(path))
    };
    match below() {
        Some(path) => Ok(path),
        None => Err(files.origin(path).err().map_or_else(
            || anyhow::anyhow!("there is no file `{path}`"),
            anyhow::Error::from,
        )),
    }
}

/// Where a file comes from, in a word or as a path.
pub fn origin(files: &Files, origin: &Origin) -> String {
    match origin {
        Origin::Shipped => "shipped".to_owned(),
        Origin::Project(path) => match files.project() {
            Some(project) if path.starts_with(project) => "project".to_owned(),
            _ => path.display().to_string(),
        },
    }
}

/// Makes the folder of a file that will be written, and shows that it can be written, before the
/// long work begins.
///
/// # Errors
/// A folder that can't be made or written.
pub fn writable(file: &Path) -> anyhow::Result<()> {
    let folder = match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    if file.is_dir() {
        anyhow::bail!("{} is a folder; name a file in it", file.display());
    }
    let refused = || {
        format!(
            "can't write into {}; choose a folder that you may write to with --out",
            folder.display()
        )
    };
    std::fs::create_dir_all(&folder).with_context(refused)?;
    // Nothing but a try tells whether a folder can be written. The file goes away by itself.
    tempfile::tempfile_in(&folder).with_context(refused)?;
    Ok(())
}
