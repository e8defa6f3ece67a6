//! Writing the files of a report.

use std::fs;
use std::io;
use std::path::Path;

use lightbench_assets::files::{FileError, write_atomic};

use crate::LabError;

/// Writes a file such that a reader finds the old content or all of the new, never half of it.
/// Missing folders are made.
///
/// # Errors
/// [`LabError::Write`] with the path and the system's reason; no temporary file stays behind.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), LabError> {
    let fail = |source| LabError::Write {
        path: path.to_path_buf(),
        source,
    };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(fail)?;
    }
    write_atomic(path, content).map_err(|error| match error {
        FileError::Io { error, .. } => fail(error),
        other => fail(io::Error::other(other)),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn replaces_whole_files_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("práctica 1 ñ").join("a.txt");
        write_atomically(&path, b"first, and longer").unwrap();
        write_atomically(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn an_unwritable_place_is_a_clear_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, b"").unwrap();
        // A file where a folder is needed, and a folder where a file is: neither depends on the
        // rights of the user who runs the test.
        let text = write_atomically(&file.join("report.html"), b"x")
            .unwrap_err()
            .to_string();
        assert!(
            text.contains("report.html") && text.contains("--out"),
            "{text}"
        );
        let place = folder.path().join("taken");
        fs::create_dir_all(place.join("inner")).unwrap();
        assert!(write_atomically(&place, b"x").is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
