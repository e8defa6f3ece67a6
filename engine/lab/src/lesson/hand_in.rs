//! What a student hands in, as one file.
//!
//! The archive is a gzipped tar (POSIX.1-1988 ustar) with the submitted files by their paths, the
//! answers with their reports, and `hand-in.toml`, which says whose it is. What it says of points is for
//! the student's eyes: whoever grades checks again.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use lightbench_assets::files::{FileError, Files, check as check_path};
use serde::{Deserialize, Serialize};

use super::Lesson;
use super::answers::{ANSWERS, read_answers};
use super::outcome::Outcome;

/// The file that says whose work it is.
pub const HAND_IN: &str = "hand-in.toml";
/// The most files of an archive.
const MOST_FILES: usize = 200;
/// The most bytes that an archive may unpack to: a few bytes must not fill a disk.
const MOST_BYTES: u64 = 64 << 20;

/// Whose work an archive holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HandedIn {
    /// The name of the lesson.
    pub lesson: String,
    /// The student, if one was named.
    #[serde(default)]
    pub student: Option<String>,
    /// Version of the program that made it.
    pub program: String,
    /// Points that the student saw.
    pub points: u32,
    /// Points that there were.
    pub of: u32,
}

/// Why there is no archive, or none that can be used.
#[derive(Debug, thiserror::Error)]
pub enum HandInError {
    /// A file of the work can't be read, or one can't be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The archive holds something that is not a plain file in its folder.
    #[error(
        "the archive holds `{0}`, which is no plain file inside of it; make it with `lightbench hand-in`"
    )]
    Hostile(String),
    /// It has one file twice, of which only one would count.
    #[error("the archive holds `{0}` twice; make it with `lightbench hand-in`")]
    Twice(String),
    /// The archive unpacks to too much.
    #[error("the archive unpacks to more than {} files or {} MiB", MOST_FILES, MOST_BYTES >> 20)]
    TooLarge,
    /// It is no archive of a lesson.
    #[error("this is no archive that `lightbench hand-in` made: {0}")]
    NoHandIn(String),
}

/// Packs the submitted files of a work, its answers and their reports. The same work gives the same
/// bytes.
///
/// # Errors
/// A file that is there and can't be read, or more than an archive may hold.
pub fn hand_in(lesson: &Lesson, work: &Path, outcome: &Outcome) -> Result<Vec<u8>, HandInError> {
    let files = Files::with_project(work)?;
    let mut paths: BTreeSet<String> = lesson.about.submits.iter().cloned().collect();
    if !lesson.about.questions.is_empty() && work.join(ANSWERS).is_file() {
        paths.insert(ANSWERS.to_owned());
        // Answers that can't be read are handed in as they are.
        let answers = read_answers(&files).unwrap_or_default();
        paths.extend(answers.into_values().map(|answer| answer.report));
    }
    let about = HandedIn {
        lesson: lesson.name.clone(),
        student: outcome.student.clone(),
        program: env!("CARGO_PKG_VERSION").to_owned(),
        points: outcome.points,
        of: outcome.of,
    };
    let failed = |error: io::Error| FileError::Io {
        path: work.to_owned(),
        error,
    };
    let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::default()));
    add(&mut archive, HAND_IN, about.to_toml().as_bytes()).map_err(failed)?;
    let mut total = 0;
    for path in paths {
        // What is missing is told when it is checked.
        if !work.join(&path).is_file() {
            continue;
        }
        let bytes = files.read(&path)?;
        total += bytes.len() as u64;
        if total > MOST_BYTES {
            return Err(HandInError::TooLarge);
        }
        add(&mut archive, &path, &bytes).map_err(failed)?;
    }
    let bytes = archive.into_inner().and_then(GzEncoder::finish);
    Ok(bytes.map_err(failed)?)
}

fn add<W: io::Write>(archive: &mut tar::Builder<W>, path: &str, bytes: &[u8]) -> io::Result<()> {
    let mut header = tar::Header::new_gnu();
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    header.set_mtime(0);
    header.set_entry_type(tar::EntryType::Regular);
    archive.append_data(&mut header, path, bytes)
}

impl HandedIn {
    fn to_toml(&self) -> String {
        let quoted = super::folders::in_quotes;
        let student = self.student.as_deref().map_or_else(String::new, |student| {
            format!("student = {}\n", quoted(student))
        });
        format!(
            "lesson = {}\n{student}program = {}\npoints = {}\nof = {}\n",
            quoted(&self.lesson),
            quoted(&self.program),
            self.points,
            self.of
        )
    }
}

/// Unpacks an archive of a stranger into a folder, and says whose it is.
///
/// # Errors
/// What is no such archive, reaches out of its folder, has links, or is too large. Then a part of it may
/// be in the folder.
pub fn unpack_hand_in(archive: &[u8], folder: &Path) -> Result<HandedIn, HandInError> {
    let none = |error: io::Error| HandInError::NoHandIn(error.to_string());
    let failed = |error: io::Error| FileError::Io {
        path: folder.to_owned(),
        error,
    };
    // One byte more than may be, so that too much is seen.
    let limited = GzDecoder::new(archive).take(MOST_BYTES + (MOST_FILES as u64 + 2) * 1024);
    let mut archive = tar::Archive::new(limited);
    let (mut seen, mut bytes) = (BTreeSet::new(), 0_u64);
    for entry in archive.entries().map_err(none)? {
        let entry = entry.map_err(none)?;
        let path = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        if check_path(&path).is_err() || !entry.header().entry_type().is_file() {
            return Err(HandInError::Hostile(path));
        }
        // Systems differ in whether capitals make another file.
        if !seen.insert(path.to_lowercase()) {
            return Err(HandInError::Twice(path));
        }
        bytes += entry.size();
        if seen.len() > MOST_FILES || bytes > MOST_BYTES {
            return Err(HandInError::TooLarge);
        }
        let size = entry.size();
        let mut content = Vec::new();
        entry.take(size).read_to_end(&mut content).map_err(none)?;
        let to = folder.join(&path);
        if let Some(parent) = to.parent() {
            fs::create_dir_all(parent).map_err(failed)?;
        }
        fs::write(&to, &content).map_err(failed)?;
    }
    let text = fs::read_to_string(folder.join(HAND_IN));
    let text = text.map_err(|_| HandInError::NoHandIn(format!("it has no {HAND_IN}")))?;
    toml::from_str(&text).map_err(|error: toml::de::Error| {
        HandInError::NoHandIn(format!("{HAND_IN}: {}", error.message()))
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    type Archive = tar::Builder<GzEncoder<Vec<u8>>>;

    fn archive(build: impl FnOnce(&mut Archive)) -> Vec<u8> {
        let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::fast()));
        build(&mut archive);
        archive.into_inner().unwrap().finish().unwrap()
    }

    fn refused(bytes: &[u8]) -> HandInError {
        let folder = tempfile::tempdir().unwrap();
        let error = unpack_hand_in(bytes, &folder.path().join("in")).unwrap_err();
        let outside: Vec<_> = fs::read_dir(folder.path()).unwrap().flatten().collect();
        assert!(outside.iter().all(|entry| entry.file_name() == "in"));
        error
    }

    fn about() -> HandedIn {
        HandedIn {
            lesson: "01-first-light".to_owned(),
            student: Some("ana \"é\" \u{7f}".to_owned()),
            program: "1".to_owned(),
            points: 3,
            of: 20,
        }
    }

    #[test]
    fn what_was_handed_in_comes_out_again() {
        let bytes = archive(|archive| {
            add(archive, HAND_IN, about().to_toml().as_bytes()).unwrap();
            add(archive, "shaders/lib/é.wgsl", b"fn a() {}").unwrap();
        });
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(unpack_hand_in(&bytes, folder.path()).unwrap(), about());
        let text = fs::read_to_string(folder.path().join("shaders/lib/é.wgsl")).unwrap();
        assert_eq!(text, "fn a() {}");
    }

    #[test]
    fn links_ways_out_and_bombs_are_refused() {
        let entry = |kind: tar::EntryType, name: &[u8], size: u64| {
            let mut header = tar::Header::new_old();
            // The crate refuses to write such names, so the bytes are set by hand.
            header.as_old_mut().name[..name.len()].copy_from_slice(name);
            header.set_entry_type(kind);
            header.set_size(size);
            header.set_mode(0o644);
            header.set_cksum();
            header
        };
        for name in [
            &b"../evil"[..],
            b"/evil",
            b"a/../../evil",
            b"C:/evil",
            b"a\\b",
        ] {
            let header = entry(tar::EntryType::Regular, name, 0);
            let bytes = archive(|archive| archive.append(&header, &[][..]).unwrap());
            assert!(matches!(refused(&bytes), HandInError::Hostile(_)));
        }
        for kind in [
            tar::EntryType::Symlink,
            tar::EntryType::Link,
            tar::EntryType::Fifo,
        ] {
            let header = entry(kind, b"link", 0);
            let bytes = archive(|archive| archive.append(&header, &[][..]).unwrap());
            assert!(matches!(refused(&bytes), HandInError::Hostile(_)));
        }
        let zeros = vec![0; 8 << 20];
        let bomb = archive(|archive| {
            for number in 0..9 {
                add(archive, &format!("zeros{number}"), &zeros).unwrap();
            }
        });
        assert!(bomb.len() < 1 << 20, "{}", bomb.len());
        assert!(matches!(refused(&bomb), HandInError::TooLarge));
        let many = archive(|archive| {
            for number in 0..=MOST_FILES {
                add(archive, &format!("{number}"), b"").unwrap();
            }
        });
        assert!(matches!(refused(&many), HandInError::TooLarge));
        let twice = archive(|archive| {
            add(archive, "a", b"1").unwrap();
            add(archive, "A", b"2").unwrap();
        });
        assert!(matches!(refused(&twice), HandInError::Twice(_)));
        assert!(matches!(refused(b"no archive"), HandInError::NoHandIn(_)));
        assert!(matches!(
            refused(&archive(|_| {})),
            HandInError::NoHandIn(_)
        ));
    }
}
