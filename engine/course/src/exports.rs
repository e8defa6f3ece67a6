//! A folder of hand-ins, as systems for courses export it.
//!
//! - Moodle, "download all submissions": a folder `Ada Lovelace_1234567_assignsubmission_file_` for each
//!   student, or, without folders, a file of that beginning.
//! - Canvas, "download submissions": a file `lovelaceada_LATE_12345_67890_name-2.zip` for each, with the
//!   student's number, that of the file, and how often it was sent again.
//! - Anything else that ends in `.zip`: the name is the student's.
//!
//! An export that is itself an archive is unpacked by a person first.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// One student's newest hand-in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// What names the student in the system: a number, or the name where there is none.
    pub student: String,
    /// The name for people, as the export spells it.
    pub name: String,
    /// Whether the system marked it as late.
    pub late: bool,
    /// The archive.
    pub archive: Result<PathBuf, NoArchive>,
    /// Older hand-ins of the same student, which are not graded.
    pub replaced: Vec<PathBuf>,
}

/// Why there is nothing to grade.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoArchive {
    /// Something else was handed in.
    #[error("there is no .zip archive among: {}", .0.join(", "))]
    Others(Vec<String>),
    /// Nothing was.
    #[error("nothing was handed in")]
    Nothing,
}

/// What lies in a folder of an export.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Export {
    /// By student, sorted.
    pub submissions: Vec<Submission>,
    /// Files that are nobody's.
    pub strays: Vec<PathBuf>,
}

/// A hand-in before it is known whether it is the newest.
struct Candidate {
    name: String,
    late: bool,
    /// Newer ones compare as greater.
    order: (u64, u64),
    /// What lies there.
    files: Vec<PathBuf>,
}

/// Reads the folder of an export. Nothing is unpacked.
///
/// # Errors
/// A folder that can't be read.
pub fn read(folder: &Path) -> io::Result<Export> {
    let mut export = Export::default();
    let mut students: BTreeMap<String, Vec<Candidate>> = BTreeMap::new();
    for path in sorted(folder)? {
        let name = path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|name| !name.starts_with('.')) else {
            continue;
        };
        let is_folder = path.is_dir();
        if let Some((student, candidate)) = moodle(name).or_else(|| canvas(name)) {
            let files = match is_folder {
                true => sorted(&path)?,
                false => vec![path],
            };
            let known = students.entry(student).or_default();
            known.push(Candidate { files, ..candidate });
        } else if is_zip(&path) {
            let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
            let candidate = Candidate {
                name: name.to_owned(),
                late: false,
                order: (0, 0),
                files: vec![path.clone()],
            };
            students.entry(name.to_owned()).or_default().push(candidate);
        } else {
            export.strays.push(path);
        }
    }
    export.submissions = students
        .into_iter()
        .map(|(student, candidates)| newest(student, candidates))
        .collect();
    Ok(export)
}

fn sorted(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries: io::Result<Vec<_>> = fs::read_dir(folder)?.collect();
    let mut paths: Vec<PathBuf> = entries?.into_iter().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}

fn is_zip(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| ending.eq_ignore_ascii_case("zip"))
}

/// `Ada Lovelace_1234567_assignsubmission_file_…`, with the number as the student's.
fn moodle(name: &str) -> Option<(String, Candidate)> {
    let (student, _) = name.split_once("_assignsubmission_file")?;
    let (name, number) = student.rsplit_once('_')?;
    is_number(number).then(|| {
        let candidate = Candidate {
            name: name.to_owned(),
            late: false,
            order: (0, 0),
            files: Vec::new(),
        };
        (number.to_owned(), candidate)
    })
}

/// `lovelaceada_LATE_12345_67890_name-2.zip`.
fn canvas(file: &str) -> Option<(String, Candidate)> {
    let (name, rest) = file.split_once('_')?;
    let (late, rest) = match rest.strip_prefix("LATE_") {
        Some(rest) => (true, rest),
        None => (false, rest),
    };
    let (student, rest) = rest.split_once('_')?;
    let (number, original) = rest.split_once('_')?;
    if !is_number(student) || !is_number(number) {
        return None;
    }
    let stem = original.rsplit_once('.').map_or(original, |(stem, _)| stem);
    let again = stem.rsplit_once('-').map(|(_, again)| again);
    let again = again.filter(|again| again.len() < 4);
    let candidate = Candidate {
        name: name.to_owned(),
        late,
        order: (
            again.and_then(|again| again.parse().ok()).unwrap_or(0),
            number.parse().unwrap_or(0),
        ),
        files: Vec::new(),
    };
    Some((student.to_owned(), candidate))
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

fn newest(student: String, mut candidates: Vec<Candidate>) -> Submission {
    candidates.sort_by_key(|candidate| candidate.order);
    let (mut archives, mut others) = (Vec::new(), Vec::new());
    for candidate in &candidates {
        for file in &candidate.files {
            let late = candidate.late;
            match is_zip(file) {
                true => archives.push((late, file.clone())),
                false => others.push(file.clone()),
            }
        }
    }
    let newest = archives.pop();
    let late = match (&newest, candidates.last()) {
        (Some((late, _)), _) => *late,
        (None, last) => last.is_some_and(|last| last.late),
    };
    let named = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    };
    Submission {
        student,
        name: candidates.pop().map(|last| last.name).unwrap_or_default(),
        late,
        archive: match newest {
            Some((_, path)) => Ok(path),
            None if others.is_empty() => Err(NoArchive::Nothing),
            None => Err(NoArchive::Others(others.iter().map(named).collect())),
        },
        replaced: archives.into_iter().map(|(_, path)| path).collect(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn export(paths: &[&str]) -> (tempfile::TempDir, Export) {
        let folder = tempfile::tempdir().unwrap();
        for path in paths {
            let path = folder.path().join(path);
            if path.to_string_lossy().ends_with('/') {
                fs::create_dir_all(path).unwrap();
            } else {
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(path, "").unwrap();
            }
        }
        let export = read(folder.path()).unwrap();
        (folder, export)
    }

    fn file(submission: &Submission) -> String {
        let path = submission.archive.as_ref().unwrap();
        path.file_name().unwrap().to_string_lossy().into_owned()
    }

    #[test]
    fn moodle_with_folders_and_without() {
        let (_folder, found) = export(&[
            "Ada Lovelace_1234567_assignsubmission_file_/hand-in.zip",
            "Grace_Hopper_76_assignsubmission_file_/essay.pdf",
            "Grace_Hopper_76_assignsubmission_file_/photo.jpg",
            "Nobody_5_assignsubmission_file_/",
            "José Ñandú_8_assignsubmission_file_lesson 6.zip",
        ]);
        let students: Vec<_> = found.submissions.iter().map(|s| &s.student[..]).collect();
        assert_eq!(students, ["1234567", "5", "76", "8"]);
        let [ada, nobody, grace, jose] = &found.submissions[..] else {
            panic!()
        };
        assert_eq!(
            (&ada.name[..], &file(ada)[..]),
            ("Ada Lovelace", "hand-in.zip")
        );
        assert_eq!(nobody.archive, Err(NoArchive::Nothing));
        assert_eq!(grace.name, "Grace_Hopper");
        let error = grace.archive.as_ref().unwrap_err().to_string();
        assert_eq!(
            error,
            "there is no .zip archive among: essay.pdf, photo.jpg"
        );
        assert_eq!(jose.name, "José Ñandú");
        assert!(found.submissions.iter().all(|s| !s.late) && found.strays.is_empty());
    }

    #[test]
    fn canvas_late_and_sent_again() {
        let (_folder, found) = export(&[
            "lovelaceada_123_456_hand-in_06.zip",
            "lovelaceada_LATE_123_512_hand-in_06-1.zip",
            "lovelaceada_LATE_123_498_hand-in_06-2.zip",
            "hoppergrace_9_10_hand-in.ZIP",
        ]);
        let [ada, grace] = &found.submissions[..] else {
            panic!()
        };
        assert_eq!(file(ada), "lovelaceada_LATE_123_498_hand-in_06-2.zip");
        assert!(ada.late && !grace.late);
        assert_eq!(ada.replaced.len(), 2);
        assert_eq!(grace.student, "9");
    }

    #[test]
    fn a_new_file_that_is_no_archive_does_not_replace_one() {
        let (_folder, found) = export(&["a_1_2_hand-in.zip", "a_LATE_1_3_apology-1.txt"]);
        let [a] = &found.submissions[..] else {
            panic!()
        };
        assert_eq!(file(a), "a_1_2_hand-in.zip");
        assert!(!a.late);
    }

    #[test]
    fn plain_archives_have_the_name_of_the_student() {
        let (_folder, found) = export(&["ada.zip", "grace.zip", "notes.txt", ".hidden"]);
        let students: Vec<_> = found.submissions.iter().map(|s| &s.student[..]).collect();
        assert_eq!(students, ["ada", "grace"]);
        assert_eq!(found.strays.len(), 1);
        assert!(found.strays[0].ends_with("notes.txt"));
    }
}
