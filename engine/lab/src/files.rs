//! Writing files such that a reader never sees half of one.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use crate::LabError;

/// Writes a file under a temporary name beside its place and renames it, so that the place holds
/// either the old content or all of the new. Missing folders are made.
///
/// # Errors
/// [`LabError::Write`] with the path and the system's reason; no temporary file stays behind.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), LabError> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let fail = |source| LabError::Write {
        path: path.to_path_buf(),
        source,
    };
    let name = path
        .file_name()
        .ok_or_else(|| fail(std::io::Error::other("the path names no file")))?;
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    };
    fs::create_dir_all(&folder).map_err(fail)?;
    let number = COUNTER.fetch_add(1, Ordering::Relaxed);
    let mut temporary_name = std::ffi::OsString::from(".");
    temporary_name.push(name);
    temporary_name.push(format!(".{}-{number}.tmp", std::process::id()));
    let temporary = folder.join(temporary_name);
    let written = fs::File::create(&temporary)
        .and_then(|mut file| file.write_all(content).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&temporary, path));
    written.map_err(|error| {
        let _ = fs::remove_file(&temporary);
        fail(error)
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
