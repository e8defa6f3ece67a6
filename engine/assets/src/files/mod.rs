//! The one door to the disk.
//!
//! A [`Files`] store has two layers. Shaders, scripts and lessons are shipped
//! inside the program; a student's project folder lies over them, and a file
//! there hides the shipped one of the same path. Everything is addressed by a
//! path relative to the project, with forward slashes, such as
//! `shaders/lib/surface.wgsl`. No path leads out of the project, not by `..`
//! and not by a symbolic link, because scripts name files too and scripts are
//! not trusted.
//!
//! A file outside the project that the user named, on the command line say, is
//! let in by [`Files::grant`].

mod atomic;
mod error;
mod list;
mod observer;
mod path;
mod project;
mod read;
mod text;
mod shipped {
    include!(concat!(env!("OUT_DIR"), "/shipped.rs"));
}

use std::fs;
use std::path::{Path, PathBuf};

pub use atomic::write_atomic;
pub use error::FileError;
pub use list::Listed;
pub use observer::Access;
use observer::Observers;
pub use path::{check, join};
pub use project::{PROJECT_MARKER, create_project, find_project};
pub use read::{MAX_FILE_BYTES, read_path};
pub use text::decode_text;

use read::{inside, read_limited};
pub(crate) use text::with_plain_line_ends;

/// What the path of a granted file begins with; see [`Files::grant`].
const GRANT_PREFIX: char = '@';

/// Where a file comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A file on the disk, in the project or granted.
    Project(PathBuf),
    /// Inside the program.
    Shipped,
}

/// The layered file store. Clones are cheap, and share nothing that changes.
#[derive(Clone, Debug)]
pub struct Files {
    /// Canonical, so that what it holds can be told from what it links to.
    project: Option<PathBuf>,
    shipped: &'static [(&'static str, &'static [u8])],
    /// Canonical folders.
    grants: Vec<PathBuf>,
    observers: Observers,
}

impl Files {
    /// Only what the program carries.
    #[must_use]
    pub fn shipped() -> Self {
        Self {
            project: None,
            shipped: shipped::SHIPPED,
            grants: Vec::new(),
            observers: Observers::default(),
        }
    }

    /// A project folder over what the program carries. The folder needs no
    /// marker file.
    ///
    /// # Errors
    /// A folder that is not there or can't be read.
    pub fn with_project(folder: impl AsRef<Path>) -> Result<Self, FileError> {
        let folder = folder.as_ref();
        let canonical = fs::canonicalize(folder).map_err(|error| FileError::io(folder, error))?;
        if !canonical.is_dir() {
            return Err(FileError::NotAFolder {
                path: folder.to_owned(),
            });
        }
        Ok(Self {
            project: Some(canonical),
            ..Self::shipped()
        })
    }

    /// The same store, whose reads are told to `observe` with the path and the
    /// bytes, as they are on the disk, beside those who are told already. A
    /// report hashes its inputs so.
    #[must_use]
    pub fn observed(&self, observe: impl Fn(&str, &[u8]) + Send + Sync + 'static) -> Self {
        Self {
            observers: self.observers.and(move |path, access| {
                if let Access::Read(bytes) = access {
                    observe(path, bytes);
                }
            }),
            ..self.clone()
        }
    }

    /// As [`Files::observed`], and told of files that are asked for and are in
    /// no layer too: when one of them appears, what was made without it is to
    /// be made again.
    #[must_use]
    pub fn observed_with_missing(
        &self,
        observe: impl Fn(&str, Access) + Send + Sync + 'static,
    ) -> Self {
        Self {
            observers: self.observers.and(observe),
            ..self.clone()
        }
    }

    /// The project's folder, if there is one.
    #[must_use]
    pub fn project(&self) -> Option<&Path> {
        self.project.as_deref()
    }

    /// The folders that were let in, in the order of the numbers in their paths.
    #[must_use]
    pub fn grants(&self) -> &[PathBuf] {
        &self.grants
    }

    /// Lets in the folders that other files had let in, under the same numbers.
    pub fn grant_again(&mut self, folders: &[PathBuf]) {
        self.grants = folders.to_vec();
    }

    /// Lets in a file that the user named, and what lies beside and below it
    /// (an OBJ needs its materials and pictures). Returns the path for
    /// [`Files::read`]: the usual one for a file of the project, one that
    /// begins with `@` and a number for others.
    ///
    /// # Errors
    /// A file that is not there.
    pub fn grant(&mut self, file: impl AsRef<Path>) -> Result<String, FileError> {
        let file = file.as_ref();
        let canonical = fs::canonicalize(file).map_err(|error| FileError::io(file, error))?;
        let not_unicode = || FileError::NotUnicode {
            path: file.to_owned(),
        };
        if let Some(project) = &self.project
            && let Ok(below) = canonical.strip_prefix(project)
        {
            let parts: Option<Vec<&str>> = below.iter().map(|part| part.to_str()).collect();
            return Ok(parts.ok_or_else(not_unicode)?.join("/"));
        }
        let (Some(folder), Some(name)) = (canonical.parent(), canonical.file_name()) else {
            return Err(FileError::IsAFolder { path: canonical });
        };
        let name = name.to_str().ok_or_else(not_unicode)?;
        let index = match self.grants.iter().position(|granted| *granted == folder) {
            Some(index) => index,
            None => {
                self.grants.push(folder.to_owned());
                self.grants.len() - 1
            }
        };
        Ok(format!("{GRANT_PREFIX}{index}/{name}"))
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// A path that is not allowed, a file that is in no layer, can't be read
    /// or is larger than [`MAX_FILE_BYTES`].
    pub fn read(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let bytes = match self.origin(path)? {
            Origin::Project(on_disk) => read_limited(&on_disk),
            Origin::Shipped => self
                .shipped_bytes(path)
                .map(<[u8]>::to_vec)
                .ok_or_else(|| FileError::not_found(path, self.project())),
        }?;
        self.observers.tell(path, Access::Read(&bytes));
        Ok(bytes)
    }

    /// The text of a file, which must be UTF-8. A byte-order mark is taken off
    /// and every line end (CR LF or a lone CR) becomes LF, so that line numbers
    /// are the same for every reader of the text.
    ///
    /// # Errors
    /// As [`Files::read`], and text that is not UTF-8, with its line.
    pub fn read_text(&self, path: &str) -> Result<String, FileError> {
        decode_text(path, self.read(path)?)
    }

    /// Which layer a file is read from.
    ///
    /// # Errors
    /// A path that is not allowed, or a file that is in no layer.
    pub fn origin(&self, path: &str) -> Result<Origin, FileError> {
        let origin = self.look_up(path);
        if let Err(FileError::NotFound { .. }) = &origin {
            self.observers.tell(path, Access::Missing);
        }
        origin
    }

    fn look_up(&self, path: &str) -> Result<Origin, FileError> {
        if let Some((root, below)) = self.granted(path)? {
            return match inside(root, below, path)? {
                Some(on_disk) => Ok(Origin::Project(on_disk)),
                None => Err(FileError::NotFound {
                    path: below.to_owned(),
                    places: format!("in {}", root.display()),
                }),
            };
        }
        check(path)?;
        if let Some(project) = &self.project
            && let Some(on_disk) = inside(project, path, path)?
        {
            return Ok(Origin::Project(on_disk));
        }
        match self.shipped_bytes(path) {
            Some(_) => Ok(Origin::Shipped),
            None => Err(FileError::not_found(path, self.project())),
        }
    }

    /// Whether a file is in some layer, and its path allowed.
    #[must_use]
    pub fn exists(&self, path: &str) -> bool {
        self.origin(path).is_ok()
    }

    /// A file on the disk whose name differs only in small and capital letters,
    /// as for models that come from a system where those are the same.
    #[must_use]
    pub fn find_ignoring_case(&self, path: &str) -> Option<String> {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        let on_disk = match self.granted(path).ok()? {
            Some((root, below)) => root.join(below),
            None => self.project.as_ref()?.join(path),
        };
        let wanted = name.to_lowercase();
        let entries = fs::read_dir(on_disk.parent()?).ok()?;
        let names = entries
            .flatten()
            .filter_map(|entry| entry.file_name().into_string().ok());
        // The first in order, so that the choice is always the same.
        let found = names.filter(|name| name.to_lowercase() == wanted).min()?;
        let found = if folder.is_empty() {
            found
        } else {
            format!("{folder}/{found}")
        };
        self.exists(&found).then_some(found)
    }

    /// A path as the user knows it, for messages: that on the disk for granted
    /// files, the relative one for all others.
    #[must_use]
    pub fn display(&self, path: &str) -> String {
        match self.granted(path) {
            Ok(Some((root, below))) => root.join(below).display().to_string(),
            _ => path.to_owned(),
        }
    }

    /// Copies a shipped file into the project, so that it can be edited, and
    /// returns where it is. A file that the project has already stays as it is.
    ///
    /// # Errors
    /// No project, a path that is not allowed, a file that is in no layer, a
    /// folder that can't be written.
    pub fn copy_to_project(&self, path: &str) -> Result<PathBuf, FileError> {
        if let Origin::Project(on_disk) = self.origin(path)? {
            return Ok(on_disk);
        }
        let target = self.place_in_project(path)?;
        match atomic::write_new(&target, &self.read(path)?) {
            Err(FileError::Exists { .. }) => Ok(target),
            other => other.map(|()| target),
        }
    }

    /// Writes a file of the project, whole or not at all, with the folders
    /// that it needs. Returns where it is.
    ///
    /// # Errors
    /// No project, a path that is not allowed, a folder that can't be written,
    /// a full disk.
    pub fn write(&self, path: &str, bytes: &[u8]) -> Result<PathBuf, FileError> {
        let target = self.place_in_project(path)?;
        write_atomic(&target, bytes)?;
        Ok(target)
    }

    /// Writes a new file of the project, whole or not at all, with the folders
    /// that it needs. Returns where it is.
    ///
    /// # Errors
    /// As [`Files::write`], and a file that is there already, which stays as
    /// it is.
    pub fn create(&self, path: &str, bytes: &[u8]) -> Result<PathBuf, FileError> {
        let target = self.place_in_project(path)?;
        atomic::write_new(&target, bytes)?;
        Ok(target)
    }

    /// The folders of granted files, each with what its paths begin with.
    pub(crate) fn granted_folders(&self) -> impl Iterator<Item = (String, &Path)> {
        let grants = self.grants.iter().enumerate();
        grants.map(|(index, folder)| (format!("{GRANT_PREFIX}{index}/"), folder.as_path()))
    }

    fn shipped_bytes(&self, path: &str) -> Option<&'static [u8]> {
        let found = self.shipped.binary_search_by(|(name, _)| (*name).cmp(path));
        found.ok().map(|index| self.shipped[index].1)
    }

    /// Splits a granted path into its folder and the rest.
    fn granted<'a>(&self, path: &'a str) -> Result<Option<(&Path, &'a str)>, FileError> {
        let Some(rest) = path.strip_prefix(GRANT_PREFIX) else {
            return Ok(None);
        };
        let Some((index, below)) = rest.split_once('/') else {
            return Ok(None);
        };
        let Some(root) = index
            .parse()
            .ok()
            .and_then(|index: usize| self.grants.get(index))
        else {
            return Ok(None);
        };
        check(below)?;
        Ok(Some((root, below)))
    }

    /// Where a file of the project is or would be, with its folder made.
    fn place_in_project(&self, path: &str) -> Result<PathBuf, FileError> {
        check(path)?;
        if self.granted(path)?.is_some() {
            return Err(FileError::BadPath {
                path: path.to_owned(),
                reason: "files outside the project are only read",
            });
        }
        let project = self.project.as_ref().ok_or_else(|| FileError::NoProject {
            path: path.to_owned(),
        })?;
        let target = project.join(path);
        // The deepest folder that exists decides whether a link leads out.
        let existing = target
            .ancestors()
            .find(|ancestor| ancestor.symlink_metadata().is_ok())
            .unwrap_or(project);
        let real = fs::canonicalize(existing).map_err(|error| FileError::io(existing, error))?;
        if !real.starts_with(project) {
            return Err(FileError::Escapes {
                path: path.to_owned(),
                leads_to: real,
            });
        }
        if let Some(folder) = target.parent() {
            fs::create_dir_all(folder).map_err(|error| FileError::io(folder, error))?;
        }
        Ok(target)
    }
}

#[cfg(test)]
mod tests;
