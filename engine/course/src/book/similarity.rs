//! Hand-ins laid out for JPlag, which compares them with each other.

use std::fs;
use std::path::{Path, PathBuf};

use crate::grading::{GradeError, Record, prepared};

/// Copies what each student handed in into a folder `jplag/STUDENT` below `out`, and the starter into
/// `jplag-base`, which JPlag leaves out of account. Only the files that are handed in, as text: JPlag
/// knows neither Rhai nor WGSL, and compares them as such
/// (`java -jar jplag.jar -l text -bc jplag-base jplag`).
///
/// # Errors
/// Files that can't be read or written.
pub fn for_jplag(
    records: &[Record],
    out: &Path,
    submits: &[String],
    starter: &[(String, Vec<u8>)],
) -> Result<PathBuf, GradeError> {
    let (all, base) = (out.join("jplag"), out.join("jplag-base"));
    for folder in [&all, &base] {
        match fs::remove_dir_all(folder) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(GradeError::disk(folder, error));
            }
            _ => fs::create_dir_all(folder).map_err(|error| GradeError::disk(folder, error))?,
        }
    }
    for (path, bytes) in starter.iter().filter(|(path, _)| submits.contains(path)) {
        write(&base.join(as_text(path)), bytes)?;
    }
    for record in records {
        let work = prepared(&out.join("students"), &record.student).join("work");
        let to = prepared(&all, &record.student);
        for path in submits {
            // Not everybody hands in everything.
            if let Ok(bytes) = fs::read(work.join(path)) {
                write(&to.join(as_text(path)), &bytes)?;
            }
        }
    }
    Ok(all)
}

/// JPlag takes files as text by their ending.
fn as_text(path: &str) -> String {
    format!("{}.txt", path.replace('/', "-"))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), GradeError> {
    let folder = path.parent().unwrap_or(path);
    fs::create_dir_all(folder).map_err(|error| GradeError::disk(folder, error))?;
    fs::write(path, bytes).map_err(|error| GradeError::disk(path, error))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::samples;
    use super::*;

    #[test]
    fn only_what_is_handed_in_is_laid_out() {
        let out = tempfile::tempdir().unwrap();
        let record = samples::checked();
        let work = out.path().join("students/17/work");
        fs::create_dir_all(work.join("shaders")).unwrap();
        fs::write(work.join("shaders/a.wgsl"), "mine").unwrap();
        fs::write(work.join("private.txt"), "x").unwrap();
        let submits = ["shaders/a.wgsl".to_owned(), "missing.rhai".to_owned()];
        let starter = [("shaders/a.wgsl".to_owned(), b"given".to_vec())];
        let folder = for_jplag(&[record], out.path(), &submits, &starter).unwrap();
        let names: Vec<_> = fs::read_dir(folder.join("17"))
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect();
        assert_eq!(names, ["shaders-a.wgsl.txt"]);
        let base = fs::read(out.path().join("jplag-base/shaders-a.wgsl.txt")).unwrap();
        assert_eq!(base, b"given");
    }
}
