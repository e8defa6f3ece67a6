//! Reading from the disk, with care for what is no plain file.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::FileError;

/// The largest file that is read, in bytes.
pub const MAX_FILE_BYTES: u64 = 512 << 20;

/// The real place of a file below `root`, or `None` if there is none.
pub(super) fn inside(root: &Path, below: &str, asked: &str) -> Result<Option<PathBuf>, FileError> {
    let on_disk = root.join(below);
    match fs::canonicalize(&on_disk) {
        Ok(real) if !real.starts_with(root) => Err(FileError::Escapes {
            path: asked.to_owned(),
            leads_to: real,
        }),
        Ok(real) if real.is_dir() => Err(FileError::IsAFolder { path: on_disk }),
        // A pipe or a device would block the reader for ever.
        Ok(real) if !real.is_file() => Err(FileError::NotAFile { path: on_disk }),
        Ok(_) => Ok(Some(on_disk)),
        Err(error) if is_absent(&error) => Ok(None),
        Err(error) => Err(FileError::io(&on_disk, error)),
    }
}

/// Nothing of that name, which includes "a part of the path is no folder".
fn is_absent(error: &std::io::Error) -> bool {
    matches!(
        error.kind(),
        std::io::ErrorKind::NotFound | std::io::ErrorKind::NotADirectory
    )
}

/// The bytes of a file anywhere on the disk that the user named, such as a
/// picture to compare with.
///
/// # Errors
/// A file that can't be read, is a folder, or is larger than
/// [`MAX_FILE_BYTES`].
pub fn read_path(path: impl AsRef<Path>) -> Result<Vec<u8>, FileError> {
    let path = path.as_ref();
    let path_owned = || path.to_owned();
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(FileError::IsAFolder { path: path_owned() }),
        // A pipe or a device would block the reader for ever.
        Ok(found) if !found.is_file() => Err(FileError::NotAFile { path: path_owned() }),
        Ok(_) => read_limited(path),
        Err(error) => Err(FileError::io(path, error)),
    }
}

pub(super) fn read_limited(path: &Path) -> Result<Vec<u8>, FileError> {
    let file = fs::File::open(path).map_err(|error| FileError::io(path, error))?;
    let size = file.metadata().map_or(0, |metadata| metadata.len());
    let mut bytes = Vec::new();
    if size <= MAX_FILE_BYTES {
        bytes.reserve_exact(size as usize);
        file.take(MAX_FILE_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| FileError::io(path, error))?;
    }
    if size > MAX_FILE_BYTES || bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(FileError::TooLarge {
            path: path.to_owned(),
            limit: MAX_FILE_BYTES >> 20,
        });
    }
    Ok(bytes)
}
