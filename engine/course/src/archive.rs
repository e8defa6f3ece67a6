//! Archives of hand-ins: written alike from the same files, and read as what a stranger sent.
//!
//! An archive may name files outside of its folder, hold links, or a few kilobytes that unpack to as many
//! gigabytes. Each of these is refused before the first byte of the entry is written, or as soon as
//! the bytes that come out are too many: sizes that an archive states are not believed.

use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use zip::read::ZipFile;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// The longest path of an entry, in bytes.
const LONGEST_PATH: usize = 240;
/// What systems put into archives unasked.
const CLUTTER: [&str; 3] = ["__MACOSX", ".DS_Store", "Thumbs.db"];

/// What an archive may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Files and folders.
    pub entries: usize,
    /// Bytes of all files, unpacked.
    pub bytes: u64,
    /// Folders inside of each other.
    pub depth: usize,
}

impl Default for Bounds {
    /// More than any hand-in needs: scripts, shaders, some pictures and reports.
    fn default() -> Self {
        Self {
            entries: 2000,
            bytes: 128 << 20,
            depth: 12,
        }
    }
}

/// Why an entry is not unpacked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// Its path leads out of the folder, or is none that every system has.
    #[error("its path leads out of the folder, or is no path on every system")]
    Path,
    /// It is a link.
    #[error("it is a link")]
    Link,
    /// It is a device, a pipe or a socket.
    #[error("it is neither a file nor a folder")]
    Special,
    /// It is encrypted.
    #[error("it is encrypted")]
    Encrypted,
    /// Another entry has the same path, on systems where case does not matter.
    #[error("another entry has the same path")]
    Twice,
    /// It lies too deep.
    #[error("it lies more than {0} folders deep")]
    Deep(usize),
    /// There are too many entries.
    #[error("there are more than {0} entries")]
    Many(usize),
    /// There are too many bytes.
    #[error("the archive unpacks to more than {} MiB", .0 >> 20)]
    Large(u64),
}

/// Why an archive was not read or written.
#[derive(Debug, thiserror::Error)]
pub enum ArchiveError {
    /// It is no archive, or it is damaged.
    #[error("{}: not a readable zip archive: {reason}", path.display())]
    Damaged {
        /// The archive.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// An entry is refused, and with it the archive.
    #[error("{}: `{entry}` is refused: {refusal}", path.display())]
    Refused {
        /// The archive.
        path: PathBuf,
        /// The entry, as the archive names it.
        entry: String,
        /// Why.
        refusal: Refusal,
    },
    /// The disk failed.
    #[error("{}: {source}", path.display())]
    Disk {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl ArchiveError {
    /// What is wrong, for whoever sent the archive: without the place where it lies here.
    #[must_use]
    pub fn reason(&self) -> String {
        match self {
            Self::Damaged { reason, .. } => format!("it is not a readable zip archive: {reason}"),
            Self::Refused { entry, refusal, .. } => format!("`{entry}` is refused: {refusal}"),
            Self::Disk { source, .. } => source.to_string(),
        }
    }
}

fn disk(path: &Path) -> impl FnOnce(io::Error) -> ArchiveError + use<> {
    let path = path.to_owned();
    move |source| ArchiveError::Disk { path, source }
}

/// Writes files into an archive. The same files give the same bytes: entries are sorted and have no
/// times.
///
/// `files` has the paths in the archive, with `/`, and the bytes.
///
/// # Errors
/// A disk that can't be written. No half archive stays there.
pub fn pack(archive: &Path, files: &[(String, Vec<u8>)]) -> Result<(), ArchiveError> {
    let mut sorted: Vec<&(String, Vec<u8>)> = files.iter().collect();
    sorted.sort();
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::default())
        .unix_permissions(0o644);
    let mut bytes = Vec::new();
    let mut writer = ZipWriter::new(io::Cursor::new(&mut bytes));
    let failed = |error: zip::result::ZipError| ArchiveError::Damaged {
        path: archive.to_owned(),
        reason: error.to_string(),
    };
    for (path, content) in sorted {
        writer.start_file(path.as_str(), options).map_err(failed)?;
        writer.write_all(content).map_err(disk(archive))?;
    }
    writer.finish().map_err(failed)?;
    let partial = archive.with_extension("zip-part");
    fs::write(&partial, &bytes)
        .and_then(|()| fs::rename(&partial, archive))
        .map_err(|source| {
            // What could not be written whole is not left lying about.
            let _ = fs::remove_file(&partial);
            disk(archive)(source)
        })
}

/// Unpacks an archive into a folder that is new or empty, and gives the paths of the files, sorted.
///
/// A folder that holds everything is left out, since many people pack the folder and not what is in it.
///
/// # Errors
/// The first entry that is refused, a damaged archive, a disk that can't be written. Then the folder
/// is removed: nothing of a refused archive stays.
pub fn unpack(archive: &Path, into: &Path, bounds: &Bounds) -> Result<Vec<String>, ArchiveError> {
    let unpacked = unpack_all(archive, into, bounds);
    if unpacked.is_err() {
        // The reason is what counts.
        let _ = fs::remove_dir_all(into);
    }
    unpacked
}

fn unpack_all(archive: &Path, into: &Path, bounds: &Bounds) -> Result<Vec<String>, ArchiveError> {
    let damaged = |error: zip::result::ZipError| ArchiveError::Damaged {
        path: archive.to_owned(),
        reason: error.to_string(),
    };
    let file = File::open(archive).map_err(disk(archive))?;
    let mut entries = ZipArchive::new(file).map_err(damaged)?;
    let refuse = |entry: &str, refusal| ArchiveError::Refused {
        path: archive.to_owned(),
        entry: entry.to_owned(),
        refusal,
    };
    // All paths are looked at before anything is written.
    let mut wanted = Vec::new();
    let mut seen = HashSet::new();
    for index in 0..entries.len() {
        let entry = entries.by_index(index).map_err(damaged)?;
        let name = entry.name().map_err(damaged)?.into_owned();
        if index >= bounds.entries {
            return Err(refuse(&name, Refusal::Many(bounds.entries)));
        }
        let path = looked_at(&entry, &name, bounds).map_err(|refusal| refuse(&name, refusal))?;
        let Some(path) = path else { continue };
        if !seen.insert(path.to_lowercase()) {
            return Err(refuse(&name, Refusal::Twice));
        }
        wanted.push((index, path));
    }
    let outer = common_folder(&wanted);
    let mut left = bounds.bytes;
    let mut paths = Vec::new();
    fs::create_dir_all(into).map_err(disk(into))?;
    for (index, path) in wanted {
        let path = &path[outer..];
        let to = into.join(path);
        let folder = to.parent().unwrap_or(into);
        fs::create_dir_all(folder).map_err(disk(folder))?;
        let entry = entries.by_index(index).map_err(damaged)?;
        // Whatever size it says, no more than this is read.
        let mut limited = entry.take(left + 1);
        let mut file = File::create_new(&to).map_err(disk(&to))?;
        let written = copy(&mut limited, &mut file).map_err(|failed| match failed {
            Failed::Reading(error) => damaged(error.into()),
            Failed::Writing(error) => disk(&to)(error),
        })?;
        left = left
            .checked_sub(written)
            .ok_or_else(|| refuse(path, Refusal::Large(bounds.bytes)))?;
        paths.push(path.to_owned());
    }
    paths.sort();
    Ok(paths)
}

enum Failed {
    Reading(io::Error),
    Writing(io::Error),
}

/// `io::copy` that says which side failed.
fn copy(from: &mut impl Read, to: &mut impl Write) -> Result<u64, Failed> {
    let mut buffer = [0; 1 << 16];
    let mut written = 0;
    loop {
        let count = from.read(&mut buffer).map_err(Failed::Reading)?;
        if count == 0 {
            return Ok(written);
        }
        to.write_all(&buffer[..count]).map_err(Failed::Writing)?;
        written += count as u64;
    }
}

/// The path of a file; `None` for folders and for what systems add.
fn looked_at<R: Read + io::Seek>(
    entry: &ZipFile<'_, R>,
    name: &str,
    bounds: &Bounds,
) -> Result<Option<String>, Refusal> {
    if entry.is_symlink() {
        return Err(Refusal::Link);
    }
    // The kind of file of Unix; archives of other systems have none.
    let kind = entry.unix_mode().map_or(0, |mode| mode & 0o170_000);
    if !matches!(kind, 0 | 0o100_000 | 0o040_000) {
        return Err(Refusal::Special);
    }
    if entry.encrypted() {
        return Err(Refusal::Encrypted);
    }
    let path = safe_path(name, bounds.depth)?;
    let clutter = path.split('/').any(|part| CLUTTER.contains(&part));
    Ok((!entry.is_dir() && !clutter).then_some(path))
}

/// A relative path that means the same everywhere, without its last `/`.
fn safe_path(name: &str, depth: usize) -> Result<String, Refusal> {
    let path = name.strip_suffix('/').unwrap_or(name);
    let bad =
        |c: char| c.is_control() || matches!(c, '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|');
    let parts: Vec<&str> = path.split('/').collect();
    let fits = |part: &&str| !part.is_empty() && *part != "." && *part != "..";
    if path.len() > LONGEST_PATH || path.contains(bad) || !parts.iter().all(fits) {
        return Err(Refusal::Path);
    }
    if parts.len() > depth {
        return Err(Refusal::Deep(depth));
    }
    Ok(path.to_owned())
}

/// Bytes of the path of a folder, with its `/`, that holds all files.
fn common_folder(files: &[(usize, String)]) -> usize {
    let Some((_, first)) = files.first() else {
        return 0;
    };
    let Some(end) = first.find('/') else { return 0 };
    let folder = &first[..=end];
    let in_it = files.iter().all(|(_, path)| path.starts_with(folder));
    // A project's own folders are no wrapping.
    let own = ["scripts/", "shaders/", "models/", "textures/", "reports/"].contains(&folder);
    if in_it && !own { end + 1 } else { 0 }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const BOUNDS: Bounds = Bounds {
        entries: 10,
        bytes: 1000,
        depth: 4,
    };

    struct Sent {
        folder: tempfile::TempDir,
        writer: ZipWriter<File>,
    }

    impl Sent {
        fn new() -> Self {
            let folder = tempfile::tempdir().unwrap();
            let writer = ZipWriter::new(File::create(folder.path().join("a.zip")).unwrap());
            Self { folder, writer }
        }

        fn file(mut self, path: &str, content: &[u8]) -> Self {
            let options = SimpleFileOptions::default();
            self.writer.start_file(path, options).unwrap();
            self.writer.write_all(content).unwrap();
            self
        }

        fn unpack(self) -> (tempfile::TempDir, Result<Vec<String>, ArchiveError>) {
            self.writer.finish().unwrap();
            let archive = self.folder.path().join("a.zip");
            let found = unpack(&archive, &self.folder.path().join("out"), &BOUNDS);
            (self.folder, found)
        }

        fn refusal(self) -> (String, Refusal) {
            let (folder, found) = self.unpack();
            assert!(!folder.path().join("out").exists(), "something was left");
            match found.unwrap_err() {
                ArchiveError::Refused { entry, refusal, .. } => (entry, refusal),
                other => panic!("{other}"),
            }
        }
    }

    #[test]
    fn what_was_packed_unpacks_and_packs_to_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let files = [
            ("shaders/b.wgsl".to_owned(), b"// two\n".to_vec()),
            ("a.rhai".to_owned(), vec![b'x'; 500]),
        ];
        let reversed = [files[1].clone(), files[0].clone()];
        let [one, two] = ["1.zip", "2.zip"].map(|name| folder.path().join(name));
        pack(&one, &files).unwrap();
        pack(&two, &reversed).unwrap();
        assert_eq!(fs::read(&one).unwrap(), fs::read(&two).unwrap());
        let out = folder.path().join("out");
        let paths = unpack(&one, &out, &BOUNDS).unwrap();
        assert_eq!(paths, ["a.rhai", "shaders/b.wgsl"]);
        for (path, content) in files {
            assert_eq!(fs::read(out.join(path)).unwrap(), content);
        }
    }

    #[test]
    fn a_folder_around_everything_is_left_out_and_so_is_clutter() {
        let sent = Sent::new()
            .file("my work/a.rhai", b"1")
            .file("my work/shaders/b.wgsl", b"2")
            .file("__MACOSX/my work/._a.rhai", b"3")
            .file("my work/.DS_Store", b"4");
        let (_folder, found) = sent.unpack();
        assert_eq!(found.unwrap(), ["a.rhai", "shaders/b.wgsl"]);
        let (_folder, found) = Sent::new().file("shaders/b.wgsl", b"2").unpack();
        assert_eq!(found.unwrap(), ["shaders/b.wgsl"]);
    }

    #[test]
    fn paths_that_lead_out_are_refused() {
        for path in [
            "../a",
            "a/../../b",
            "/etc/passwd",
            "a//b",
            "C:/x",
            "a\\..\\b",
            "./a",
            "a\nb",
            "..",
        ] {
            let sent = Sent::new().file("first", b"1").file(path, b"2");
            assert_eq!(sent.refusal(), (path.to_owned(), Refusal::Path), "{path:?}");
        }
        let long = "x".repeat(LONGEST_PATH + 1);
        assert_eq!(Sent::new().file(&long, b"").refusal().1, Refusal::Path);
    }

    #[test]
    fn links_and_devices_are_refused() {
        let mut sent = Sent::new();
        let options = SimpleFileOptions::default();
        sent.writer.add_symlink("link", "/etc", options).unwrap();
        assert_eq!(sent.refusal(), ("link".to_owned(), Refusal::Link));
    }

    #[test]
    fn bombs_are_refused_by_what_comes_out() {
        // One that states its size, and many that are small each.
        let sent = Sent::new().file("zeros", &[0; 100_000]);
        assert_eq!(sent.refusal().1, Refusal::Large(1000));
        let mut sent = Sent::new();
        for index in 0..5 {
            sent = sent.file(&format!("{index}"), &[0; 300]);
        }
        assert_eq!(sent.refusal(), ("3".to_owned(), Refusal::Large(1000)));
        // All that is allowed.
        assert!(Sent::new().file("all", &[0; 1000]).unpack().1.is_ok());
    }

    #[test]
    fn a_size_that_is_a_lie_does_not_help() {
        let folder = tempfile::tempdir().unwrap();
        let archive = folder.path().join("a.zip");
        let mut writer = ZipWriter::new(File::create(&archive).unwrap());
        let options = SimpleFileOptions::default();
        writer.start_file("zeros", options).unwrap();
        writer.write_all(&[0; 100_000]).unwrap();
        writer.finish().unwrap();
        let mut bytes = fs::read(&archive).unwrap();
        let size = 100_000u32.to_le_bytes();
        for at in 0..bytes.len() - 4 {
            if bytes[at..at + 4] == size {
                bytes[at..at + 4].copy_from_slice(&10u32.to_le_bytes());
            }
        }
        fs::write(&archive, bytes).unwrap();
        let out = folder.path().join("out");
        assert!(unpack(&archive, &out, &BOUNDS).is_err());
        assert!(!out.exists());
    }

    #[test]
    fn entries_are_counted_and_must_differ() {
        let mut sent = Sent::new();
        for index in 0..=BOUNDS.entries {
            sent = sent.file(&format!("{index}"), b"");
        }
        assert_eq!(sent.refusal(), ("10".to_owned(), Refusal::Many(10)));
        let sent = Sent::new().file("a.rhai", b"1").file("A.rhai", b"2");
        assert_eq!(sent.refusal(), ("A.rhai".to_owned(), Refusal::Twice));
        let sent = Sent::new().file("a/b/c/d/e", b"");
        assert_eq!(sent.refusal().1, Refusal::Deep(4));
    }

    #[test]
    fn what_is_no_archive_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let archive = folder.path().join("essay.zip");
        fs::write(&archive, "I could not finish it in time.").unwrap();
        let error = unpack(&archive, &folder.path().join("out"), &BOUNDS).unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains("essay.zip: not a readable zip archive"),
            "{text}"
        );
    }
}
