//! Writing and reading reports on disk.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::images::{self, Encoded};
use super::model::{Comparison, SCHEMA};
use super::{csv, html};
use crate::LabError;
use crate::files::write_atomically;

/// The files of a written report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportFiles {
    /// `report.html`: everything in one file for people.
    pub html: PathBuf,
    /// `report.json`: everything but the pixels, for programs.
    pub json: PathBuf,
    /// `pipelines.csv`, `systems.csv`, `passes.csv`, `frames.csv` and `targets.csv`.
    pub csv: Vec<PathBuf>,
    /// `pictures/*.png`: each pipeline's picture and heat map.
    pub pictures: Vec<PathBuf>,
}

/// Writes a report into a folder, which is made if it is missing. Each file is complete or not
/// there. The names of the picture files are noted in `comparison`.
///
/// # Errors
/// [`LabError::Write`] if a file can't be written, [`LabError::Encode`] if a picture can't be
/// encoded.
pub fn write_report(comparison: &mut Comparison, folder: &Path) -> Result<ReportFiles, LabError> {
    let images = images::encode(comparison)?;
    let pictures = write_pictures(comparison, &images, folder)?;
    let json = folder.join("report.json");
    write_atomically(&json, to_json(comparison)?.as_bytes())?;
    let tables = [
        ("pipelines.csv", csv::pipelines(comparison)),
        ("systems.csv", csv::systems(comparison)),
        ("passes.csv", csv::passes(comparison)),
        ("frames.csv", csv::frames(comparison)),
        ("targets.csv", csv::targets(comparison)),
    ];
    let mut csv = Vec::new();
    for (name, text) in tables {
        let path = folder.join(name);
        write_atomically(&path, text.as_bytes())?;
        csv.push(path);
    }
    let html = folder.join("report.html");
    write_atomically(&html, html::page_with(comparison, &images).as_bytes())?;
    Ok(ReportFiles {
        html,
        json,
        csv,
        pictures,
    })
}

fn write_pictures(
    comparison: &mut Comparison,
    images: &[Encoded],
    folder: &Path,
) -> Result<Vec<PathBuf>, LabError> {
    let mut written = Vec::new();
    let mut taken = HashSet::new();
    for (pipeline, image) in comparison.pipelines.iter_mut().zip(images) {
        let stem = unique_stem(&pipeline.name, &mut taken);
        let mut write = |png: &Option<Vec<u8>>, name: String| -> Result<_, LabError> {
            let Some(png) = png else { return Ok(None) };
            let path = folder.join(&name);
            write_atomically(&path, png)?;
            written.push(path);
            Ok(Some(name))
        };
        pipeline.picture_file = write(&image.picture, format!("pictures/{stem}.png"))?;
        pipeline.heat_map_file = write(&image.heat_map, format!("pictures/{stem}-flip.png"))?;
    }
    Ok(written)
}

/// A file name from a pipeline's name: letters, digits, `-` and `_`, told apart from those taken
/// even where a file system ignores case.
fn unique_stem(name: &str, taken: &mut HashSet<String>) -> String {
    let plain = |c: char| {
        if c.is_alphanumeric() || c == '-' || c == '_' {
            c
        } else {
            '_'
        }
    };
    let stem: String = name.chars().take(80).map(plain).collect();
    let stem = if stem.is_empty() {
        "pipeline".to_owned()
    } else {
        stem
    };
    let mut candidate = stem.clone();
    let mut number = 2;
    while !taken.insert(candidate.to_lowercase()) {
        candidate = format!("{stem}-{number}");
        number += 1;
    }
    candidate
}

/// The comparison as JSON text.
///
/// # Errors
/// [`LabError::Encode`] if a value has no JSON form.
pub fn to_json(comparison: &Comparison) -> Result<String, LabError> {
    serde_json::to_string_pretty(comparison).map_err(|error| LabError::Encode {
        format: "JSON",
        reason: error.to_string(),
    })
}

/// Reads a comparison that [`write_report`] wrote.
///
/// # Errors
/// [`LabError::ReportData`] if the file can't be read, is no comparison, or has a newer schema.
pub fn read_json(path: &Path) -> Result<Comparison, LabError> {
    let fail = |reason: String| LabError::ReportData {
        path: path.to_path_buf(),
        reason,
    };
    let text = std::fs::read_to_string(path).map_err(|error| fail(error.to_string()))?;
    let value: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| fail(error.to_string()))?;
    let schema = value.get("schema").and_then(serde_json::Value::as_u64);
    if schema != Some(u64::from(SCHEMA)) {
        let found = schema.map_or_else(|| "no schema".into(), |s| format!("schema {s}"));
        return Err(fail(format!(
            "it has {found}, and schema {SCHEMA} is known"
        )));
    }
    // Read from the text, not from the value, so that the error has a line and a column.
    serde_json::from_str(&text).map_err(|error| fail(error.to_string()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_report_is_complete_and_its_json_reads_back() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("práctica 1 ñ");
        let mut c = sample::comparison();
        let files = write_report(&mut c, &place).unwrap();
        for path in [&files.html, &files.json]
            .into_iter()
            .chain(&files.csv)
            .chain(&files.pictures)
        {
            assert!(
                std::fs::metadata(path).unwrap().len() > 50,
                "{}",
                path.display()
            );
        }
        assert_eq!(files.pictures.len(), 3);
        let mut read = read_json(&files.json).unwrap();
        for (p, original) in read.pipelines.iter_mut().zip(&c.pipelines) {
            assert!(place.join(p.picture_file.as_ref().unwrap()).is_file());
            p.picture = original.picture.clone();
            p.heat_map = original.heat_map.clone();
        }
        assert_eq!(read, c);
        // A second report replaces the first and leaves no temporary files.
        write_report(&mut c, &place).unwrap();
        assert_eq!(std::fs::read_dir(&place).unwrap().count(), 8);
    }

    #[test]
    fn wrong_data_is_explained() {
        let folder = tempfile::tempdir().unwrap();
        for (text, word) in [
            ("", "EOF"),
            ("{}", "no schema"),
            ("{\"schema\": 99}", "schema 99"),
            ("{\"schema\": 1}", "missing field"),
        ] {
            let path = folder.path().join("report.json");
            std::fs::write(&path, text).unwrap();
            let error = read_json(&path).unwrap_err().to_string();
            assert!(
                error.contains(word) && error.contains("report.json"),
                "{error}"
            );
        }
    }

    #[test]
    fn picture_files_have_safe_and_different_names() {
        let mut taken = HashSet::new();
        let mut stem = |name: &str| unique_stem(name, &mut taken);
        assert_eq!(stem("../../etc/passwd"), "______etc_passwd");
        assert_eq!(
            (stem("a"), stem("A"), stem("")),
            ("a".into(), "A-2".into(), "pipeline".into())
        );
    }
}
