//! A student's project: a folder with a marker file.

use std::fs;
use std::path::{Path, PathBuf};

use super::{FileError, write_atomic};

/// The file that marks the top folder of a project.
pub const PROJECT_MARKER: &str = "lightbench.toml";

const MARKER: &str = "\
# This file marks the top folder of a Lightbench project.
# `lightbench`, started anywhere below it, works on this project. A table `[limits]` here bounds what its
# scripts may use, as in `load_seconds = 5`.
";

const README: &str = "\
# My Lightbench project

- `scripts/scenes/` has your scenes, `scripts/behaviours/` scripts that belong to one thing in them,
  `scripts/pipelines/` your lighting pipelines, `shaders/` your shaders, `scripts/experiments/` scripts
  that `lightbench run` runs. `out/` is for the pictures and reports that you make.
- Lightbench brings its own scenes, pipelines and shaders inside the program. A file here with the
  same path is used in place of the one in the program. Edit a shipped file in the editor and it is
  copied here first.
- Delete your copy to have the shipped file again. A new version of Lightbench never changes this
  folder.

Start with `lightbench edit` in this folder, and see `lightbench list scenes`. `lightbench docs api` tells
all that a scene can say, and `lightbench list files` names small examples to copy. `lightbench new pipeline
mine` makes a pipeline and a shader to change, and `lightbench docs pipelines` tells what else a pipeline
can say.
";

const FOLDERS: [&str; 6] = [
    "scripts/scenes",
    "scripts/behaviours",
    "scripts/pipelines",
    "scripts/experiments",
    "shaders",
    "out",
];

/// Makes a new project in a folder that is empty or not there yet. Returns the
/// folder's full path.
///
/// # Errors
/// A folder with something in it, or one that can't be made or written.
pub fn create_project(folder: impl AsRef<Path>) -> Result<PathBuf, FileError> {
    let folder = folder.as_ref();
    let failed = |error| FileError::io(folder, error);
    if folder.exists() && !folder.is_dir() {
        return Err(FileError::NotAFolder {
            path: folder.to_owned(),
        });
    }
    fs::create_dir_all(folder).map_err(failed)?;
    if let Some(entry) = fs::read_dir(folder).map_err(failed)?.next() {
        let first = entry.map_err(failed)?.file_name();
        return Err(FileError::NotEmpty {
            path: folder.to_owned(),
            first: first.to_string_lossy().into_owned(),
        });
    }
    for below in FOLDERS {
        let below = folder.join(below);
        fs::create_dir_all(&below).map_err(|error| FileError::io(&below, error))?;
    }
    write_atomic(folder.join("README.md"), README.as_bytes())?;
    // Last, because the marker says that the project is whole.
    write_atomic(folder.join(PROJECT_MARKER), MARKER.as_bytes())?;
    fs::canonicalize(folder).map_err(failed)
}

/// The project that a folder belongs to: the nearest one, going up, with a
/// marker file.
#[must_use]
pub fn find_project(start: impl AsRef<Path>) -> Option<PathBuf> {
    let start = fs::canonicalize(start).ok()?;
    let mut folders = start.ancestors();
    folders
        .find(|folder| folder.join(PROJECT_MARKER).is_file())
        .map(Path::to_owned)
}
