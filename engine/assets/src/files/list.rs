//! What files there are.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::{FileError, Files, Origin, check};

/// How deep folders are searched.
const MAX_DEPTH: usize = 16;

/// A file of some layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// For [`Files::read`].
    pub path: String,
    /// The layer that it is read from.
    pub origin: Origin,
}

impl Files {
    /// All files with an extension (without its dot; empty for any) in a
    /// folder and those below it, of both layers, sorted by path. Hidden files
    /// and those with a name that is not Unicode are left out, and so are links
    /// that lead out of the project.
    ///
    /// # Errors
    /// A path that is not allowed, or a folder that can't be read. A folder
    /// that is not there is empty.
    pub fn list(&self, folder: &str, extension: &str) -> Result<Vec<Listed>, FileError> {
        check(folder)?;
        let mut found = BTreeMap::new();
        for (path, _) in self.shipped {
            let below = path
                .strip_prefix(folder)
                .is_some_and(|rest| rest.starts_with('/'));
            if below && has_extension(path, extension) {
                found.insert((*path).to_owned(), Origin::Shipped);
            }
        }
        if let Some(project) = self.project() {
            collect(project, folder, extension, MAX_DEPTH, &mut found)?;
        }
        let listed = found.into_iter();
        Ok(listed
            .map(|(path, origin)| Listed { path, origin })
            .collect())
    }
    /// All files of the project with one of some extensions, sorted by path, as in [`Files::list`];
    /// none without a project. Folders of what is built and written, `target` and `reports`, are left out.
    ///
    /// # Errors
    /// A folder that can't be read.
    pub fn list_project(&self, extensions: &[&str]) -> Result<Vec<Listed>, FileError> {
        let mut found = BTreeMap::new();
        if let Some(project) = self.project() {
            for extension in extensions {
                collect(project, "", extension, MAX_DEPTH, &mut found)?;
            }
        }
        let outside = |path: &String| path.starts_with("target/") || path.starts_with("reports/");
        let listed = found.into_iter().filter(|(path, _)| !outside(path));
        Ok(listed
            .map(|(path, origin)| Listed { path, origin })
            .collect())
    }
}

fn collect(
    project: &Path,
    folder: &str,
    extension: &str,
    depth: usize,
    found: &mut BTreeMap<String, Origin>,
) -> Result<(), FileError> {
    let on_disk = project.join(folder);
    let leads_out = fs::canonicalize(&on_disk).is_ok_and(|real| !real.starts_with(project));
    if depth == 0 || leads_out || !on_disk.is_dir() {
        return Ok(());
    }
    let failed = |error| FileError::io(&on_disk, error);
    for entry in fs::read_dir(&on_disk).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name();
        let Some(name) = name.to_str().filter(|name| !name.starts_with('.')) else {
            continue;
        };
        let path = match folder {
            "" => name.to_owned(),
            folder => format!("{folder}/{name}"),
        };
        let Ok(kind) = entry.file_type() else {
            continue;
        };
        if kind.is_dir() {
            collect(project, &path, extension, depth - 1, found)?;
        } else if has_extension(name, extension)
            && check(&path).is_ok()
            && let Ok(Some(on_disk)) = super::read::inside(project, &path, &path)
        {
            found.insert(path, Origin::Project(on_disk));
        }
    }
    Ok(())
}

fn has_extension(path: &str, extension: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or(path);
    extension.is_empty()
        || name
            .rsplit_once('.')
            .is_some_and(|(stem, found)| !stem.is_empty() && found.eq_ignore_ascii_case(extension))
}
