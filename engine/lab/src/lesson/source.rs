//! Where the files of a lesson lie: inside of the program, or in a folder.

use std::path::{Path, PathBuf};

use lightbench_assets::files::{FileError, Files, Origin};
use lightbench_render::problem::suggestion;
use lightbench_render::{Place, Problem, Problems};

use super::Lesson;
use super::model::LESSON_FILE;

/// The folder of the lessons.
pub const LESSONS: &str = "lessons";

/// The files of a lesson, by their paths below its folder.
#[derive(Clone, Debug)]
pub struct Source {
    files: Files,
    /// What their paths in `files` begin with; empty, or with a slash at its end.
    root: String,
    /// The same as a person knows it.
    shown: String,
}

impl Source {
    /// A lesson of the project or of the program.
    pub(super) fn of_files(files: &Files, name: &str) -> Self {
        let root = format!("{LESSONS}/{name}/");
        Self {
            files: files.clone(),
            shown: root.clone(),
            root,
        }
    }

    /// A folder of the disk.
    ///
    /// # Errors
    /// A folder that is not there or can't be read.
    pub fn of_folder(folder: &Path) -> Result<Self, FileError> {
        Ok(Self {
            files: Files::with_project(folder)?,
            root: String::new(),
            shown: format!(
                "{}/",
                folder.display().to_string().trim_end_matches(['/', '\\'])
            ),
        })
    }

    /// The full path of its folder; `None` for a lesson that the program brings along.
    #[must_use]
    pub fn folder(&self) -> Option<PathBuf> {
        let folder = self.files.project()?.join(&self.root);
        let folder = std::path::absolute(folder).ok()?;
        folder.is_dir().then_some(folder)
    }

    /// The path of a file as a person knows it.
    #[must_use]
    pub fn shown(&self, path: &str) -> String {
        format!("{}{path}", self.shown)
    }

    /// The path of a file in the store.
    fn path(&self, path: &str) -> String {
        format!("{}{path}", self.root)
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// A file that is not there or can't be read.
    pub fn read(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.files.read(&self.path(path))
    }

    /// The text of a file.
    ///
    /// # Errors
    /// As [`Source::read`], and text that is not UTF-8.
    pub fn read_text(&self, path: &str) -> Result<String, FileError> {
        self.files.read_text(&self.path(path))
    }

    /// Whether a file is there.
    #[must_use]
    pub fn has(&self, path: &str) -> bool {
        self.files.exists(&self.path(path))
    }

    /// The paths of all files below one of its folders, without that folder's name.
    ///
    /// # Errors
    /// A folder that can't be read.
    pub fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        let folder = self.path(folder);
        let listed = self.files.list(&folder, "")?;
        Ok(listed
            .iter()
            .filter_map(|file| file.path.strip_prefix(&folder)?.strip_prefix('/'))
            .map(str::to_owned)
            .collect())
    }

    /// The paths of all of its files.
    ///
    /// # Errors
    /// A folder that can't be read.
    pub fn list_all(&self) -> Result<Vec<String>, FileError> {
        if !self.root.is_empty() {
            let folder = self.root.trim_end_matches('/');
            let listed = self.files.list(folder, "")?.into_iter();
            return Ok(listed
                .filter_map(|file| Some(file.path.strip_prefix(&self.root)?.to_owned()))
                .collect());
        }
        let mut found = Vec::new();
        let Some(project) = self.files.project() else {
            return Ok(found);
        };
        for entry in entries(project)? {
            if entry.is_dir() {
                let name = entry.file_name().and_then(|name| name.to_str());
                let Some(name) = name.filter(|name| !name.starts_with('.')) else {
                    continue;
                };
                let below = self.files.list(name, "")?.into_iter();
                let own = below.filter(|file| matches!(file.origin, Origin::Project(_)));
                found.extend(own.map(|file| file.path));
            } else if let Some(name) = entry.file_name().and_then(|name| name.to_str()) {
                found.push(name.to_owned());
            }
        }
        found.sort();
        Ok(found)
    }
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let failed = |error| FileError::Io {
        path: folder.to_owned(),
        error,
    };
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path()));
    paths.collect::<Result<_, _>>().map_err(failed)
}

/// The names of all lessons of the project and the program, in their order.
///
/// # Errors
/// A folder that can't be read.
pub fn list_lessons(files: &Files) -> Result<Vec<String>, FileError> {
    let listed = files.list(LESSONS, "toml")?;
    let names = listed.iter().filter_map(|file| {
        let (name, rest) = file
            .path
            .strip_prefix(LESSONS)?
            .strip_prefix('/')?
            .split_once('/')?;
        (rest == LESSON_FILE).then(|| name.to_owned())
    });
    Ok(names.collect())
}

/// The lesson that a person means: by its folder on the disk, its name, or its number.
///
/// # Errors
/// No such lesson, or what is wrong in it.
pub fn find_lesson(files: &Files, asked: &str) -> Result<Lesson, Problems> {
    let folder = Path::new(asked);
    if folder.join(LESSON_FILE).is_file() {
        let canonical = std::fs::canonicalize(folder);
        let name = canonical
            .ok()
            .and_then(|folder| Some(folder.file_name()?.to_str()?.to_owned()));
        let name = name.unwrap_or_else(|| asked.to_owned());
        let source = Source::of_folder(folder);
        let source = source.map_err(|error| Problem::new(Place::file(asked), error.to_string()))?;
        return Lesson::read(&name, source);
    }
    let names = list_lessons(files);
    let names = names.map_err(|error| Problem::new(Place::file(LESSONS), error.to_string()))?;
    let wanted = asked.trim_end_matches(['/', '\\']);
    let wanted = wanted.strip_prefix("lessons/").unwrap_or(wanted);
    let number = |name: &str| {
        name.split('-')
            .next()
            .and_then(|number| number.parse::<u32>().ok())
    };
    let is_meant = |name: &&String| {
        **name == wanted
            || (wanted
                .parse::<u32>()
                .ok()
                .is_some_and(|asked| number(name) == Some(asked)))
    };
    let Some(name) = names.iter().find(is_meant) else {
        let mut problem = Problem::new(Place::file(asked), format!("there is no lesson `{asked}`"));
        problem.hint = suggestion(wanted, names.iter().map(String::as_str)).or_else(|| {
            Some(format!(
                "there are {}; a folder with a file {LESSON_FILE} is one too",
                names.join(", ")
            ))
        });
        return Err(problem.into());
    };
    Lesson::read(name, Source::of_files(files, name))
}
