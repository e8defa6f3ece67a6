//! Files that are there whole or not at all.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::FileError;

/// Writes a file under a temporary name beside it, then renames it, so that no
/// reader sees half of it and a failure leaves the old one.
///
/// A symbolic link is followed. What is no plain file (a pipe, `/dev/null`) is
/// written directly.
///
/// # Errors
/// A folder that is not there or can't be written, a full disk.
pub fn write_atomic(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), FileError> {
    let path = path.as_ref();
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if target.is_dir() {
        return Err(FileError::IsAFolder { path: target });
    }
    if target.exists() && !target.is_file() {
        return fs::write(&target, bytes).map_err(|error| FileError::io(path, error));
    }
    let temporary = temporary_beside(&target, bytes)?;
    temporary
        .persist(&target)
        .map_err(|failed| FileError::io(path, failed.error))?;
    Ok(())
}

/// As [`write_atomic`], but never in the place of another file.
pub(super) fn write_new(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let temporary = temporary_beside(path, bytes)?;
    match temporary.persist_noclobber(path) {
        Ok(_) => Ok(()),
        Err(failed) if failed.error.kind() == std::io::ErrorKind::AlreadyExists => {
            Err(FileError::Exists {
                path: path.to_owned(),
            })
        }
        Err(failed) => Err(FileError::io(path, failed.error)),
    }
}

fn temporary_beside(path: &Path, bytes: &[u8]) -> Result<NamedTempFile, FileError> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lightbench-").suffix(".tmp");
    #[cfg(unix)]
    {
        // What the file would get without the temporary one: the permissions of
        // the file that it replaces, or those that the user's mask leaves.
        use std::os::unix::fs::PermissionsExt;
        let old = fs::metadata(path).map(|metadata| metadata.permissions());
        builder.permissions(old.unwrap_or_else(|_| fs::Permissions::from_mode(0o666)));
    }
    let mut temporary = builder
        .tempfile_in(&folder)
        .map_err(|error| FileError::io(&folder, error))?;
    temporary
        .write_all(bytes)
        .and_then(|()| temporary.as_file().sync_all())
        .map_err(|error| FileError::io(path, error))?;
    Ok(temporary)
}
