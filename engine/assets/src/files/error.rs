//! What can go wrong with a file, and what to do about it.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a file can't be read or written. Each message names the file and, where
/// there is one, the way out.
#[derive(Debug, Error)]
pub enum FileError {
    /// A path that is no relative path with forward slashes.
    #[error("`{path}` is no path in a project: {reason}")]
    BadPath {
        /// As it was given.
        path: String,
        /// What is wrong, and what would be right.
        reason: &'static str,
    },
    /// A path that leads out of the project through a symbolic link.
    #[error(
        "`{path}` leads to {}, outside the project; copy the file into the project",
        leads_to.display()
    )]
    Escapes {
        /// As it was given.
        path: String,
        /// Where the link leads.
        leads_to: PathBuf,
    },
    /// In no layer.
    #[error("there is no file `{path}`, {places}")]
    NotFound {
        /// As it was given.
        path: String,
        /// Where was looked.
        places: String,
    },
    /// Writing without a project.
    #[error(
        "`{path}` can't be written without a project; make one with `lightbench new DIR` and work there"
    )]
    NoProject {
        /// As it was given.
        path: String,
    },
    /// A folder where a file should be.
    #[error("{} is a folder; name a file in it", path.display())]
    IsAFolder {
        /// On the disk.
        path: PathBuf,
    },
    /// A file where a folder should be.
    #[error("{} is no folder", path.display())]
    NotAFolder {
        /// On the disk.
        path: PathBuf,
    },
    /// A pipe, a socket or a device.
    #[error("{} is neither a file nor a folder", path.display())]
    NotAFile {
        /// On the disk.
        path: PathBuf,
    },
    /// A name that is not Unicode, which relative paths must be.
    #[error("the name of {} is not Unicode; rename it", path.display())]
    NotUnicode {
        /// On the disk.
        path: PathBuf,
    },
    /// Text in another encoding, or no text.
    #[error("{path}, line {line}: this is not UTF-8 text; save the file as UTF-8")]
    NotText {
        /// As it was given.
        path: String,
        /// The line of the first wrong byte, from 1.
        line: usize,
    },
    /// Over the size limit.
    #[error("{} is larger than {limit} MiB, the most that is read", path.display())]
    TooLarge {
        /// On the disk.
        path: PathBuf,
        /// In MiB.
        limit: u64,
    },
    /// A new file where there is one.
    #[error("{} exists already and was left as it is", path.display())]
    Exists {
        /// On the disk.
        path: PathBuf,
    },
    /// A new project in a folder with something in it.
    #[error(
        "{} is not empty (it has `{first}`); name a new or an empty folder for the project",
        path.display()
    )]
    NotEmpty {
        /// On the disk.
        path: PathBuf,
        /// A file that is in it.
        first: String,
    },
    /// What the operating system says.
    #[error("{}: {}", path.display(), in_plain_words(error))]
    Io {
        /// On the disk.
        path: PathBuf,
        /// The cause.
        #[source]
        error: io::Error,
    },
}

impl FileError {
    pub(super) fn io(path: &Path, error: io::Error) -> Self {
        Self::Io {
            path: path.to_owned(),
            error,
        }
    }

    pub(super) fn not_found(path: &str, folder: Option<&Path>) -> Self {
        Self::NotFound {
            path: path.to_owned(),
            places: match folder {
                Some(folder) => format!("neither in {} nor in the program", folder.display()),
                None => "in the program, and no project is open".to_owned(),
            },
        }
    }
}

fn in_plain_words(error: &io::Error) -> String {
    use io::ErrorKind as Kind;
    match error.kind() {
        Kind::NotFound => "there is no such file or folder".to_owned(),
        Kind::PermissionDenied => {
            "permission denied; change its permissions or choose another place".to_owned()
        }
        Kind::ReadOnlyFilesystem => "this place is read-only; choose another one".to_owned(),
        Kind::StorageFull | Kind::QuotaExceeded => {
            "the disk is full; make room or choose another place".to_owned()
        }
        Kind::IsADirectory => "this is a folder; name a file".to_owned(),
        Kind::NotADirectory => "a part of this path is a file, not a folder".to_owned(),
        _ => error.to_string(),
    }
}
