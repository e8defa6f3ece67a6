//! The files that a check draws with: those of the lesson, and those that were handed in, and no others.

use lightbench_assets::files::{FileError, Files};

use super::Lesson;
use super::read::{CHECK_FILES, STARTER};
use super::source::Source;

/// A project for the time of a check. It goes away with this.
pub(super) struct Stage {
    pub(super) files: Files,
    _folder: tempfile::TempDir,
}

impl Stage {
    fn new() -> Result<Self, FileError> {
        let folder = tempfile::tempdir().map_err(|error| FileError::Io {
            path: std::env::temp_dir(),
            error,
        })?;
        Ok(Self {
            files: Files::with_project(folder.path())?,
            _folder: folder,
        })
    }

    /// Copies what lies below a folder of a lesson, but for some files.
    fn take(&self, source: &Source, folder: &str, without: &[String]) -> Result<(), FileError> {
        let paths = source.list(folder)?;
        for path in paths.iter().filter(|path| !without.contains(path)) {
            self.files
                .write(path, &source.read(&format!("{folder}/{path}"))?)?;
        }
        Ok(())
    }

    /// What the checks themselves draw with: the lesson's files without those that a student hands in.
    pub(super) fn of_checks(
        lesson: &Lesson,
        checks: &Source,
        file: &str,
    ) -> Result<Self, FileError> {
        let stage = Self::new()?;
        stage.take(&lesson.source, STARTER, &lesson.about.submits)?;
        stage.take(checks, CHECK_FILES, &[])?;
        stage.files.write(file, &checks.read(file)?)?;
        Ok(stage)
    }

    /// What was handed in: the submitted files over the starter, and the checks' own over both.
    pub(super) fn of_work(
        lesson: &Lesson,
        checks: &Source,
        submitted: &[(String, Vec<u8>)],
    ) -> Result<Self, FileError> {
        let stage = Self::new()?;
        stage.take(&lesson.source, STARTER, &lesson.about.submits)?;
        for (path, bytes) in submitted {
            stage.files.write(path, bytes)?;
        }
        stage.take(checks, CHECK_FILES, &[])?;
        Ok(stage)
    }
}
