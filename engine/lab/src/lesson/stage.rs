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

    /// Copies what lies below a folder of a lesson.
    fn take(&self, source: &Source, folder: &str) -> Result<(), FileError> {
        for path in source.list(folder)? {
            self.files
                .write(&path, &source.read(&format!("{folder}/{path}"))?)?;
        }
        Ok(())
    }

    /// What the checks themselves draw with: their own files over the shipped ones.
    pub(super) fn of_checks(checks: &Source, file: &str) -> Result<Self, FileError> {
        let stage = Self::new()?;
        stage.take(checks, CHECK_FILES)?;
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
        stage.take(&lesson.source, STARTER)?;
        for (path, bytes) in submitted {
            stage.files.write(path, bytes)?;
        }
        stage.take(checks, CHECK_FILES)?;
        Ok(stage)
    }
}
