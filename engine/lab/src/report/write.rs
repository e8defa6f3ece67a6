//! Writing and reading reports on disk.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::analysis::of_study;
use super::images::{self, Encoded};
use super::model::{Comparison, Parameter, SCHEMA};
use super::{csv, figures, html, tables};
use crate::LabError;
use crate::files::write_atomically;
use crate::study::{Choice, Plan, Point, Study};

/// The files of a written report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportFiles {
    /// `report.html`: everything in one file for people.
    pub html: PathBuf,
    /// `report.json`: everything but the pixels, for programs.
    pub json: PathBuf,
    /// `pipelines.csv`, `systems.csv`, `passes.csv`, `frames.csv`, `targets.csv` and `counters.csv`.
    pub csv: Vec<PathBuf>,
    /// `tables/*.md` and `tables/*.tex`: the tables of the page for other texts.
    pub tables: Vec<PathBuf>,
    /// `charts/*.svg` and `charts/*.png`: the charts of the page.
    pub charts: Vec<PathBuf>,
    /// `pictures/*.png`: each pipeline's pictures, heat maps and views.
    pub pictures: Vec<PathBuf>,
}

/// Writes the report of one comparison, as the study of a single point.
///
/// # Errors
/// As [`write_study`].
pub fn write_report(comparison: &mut Comparison, folder: &Path) -> Result<ReportFiles, LabError> {
    let mut study = of_one(std::mem::take(comparison));
    let written = write_study(&mut study, folder);
    if let Some(point) = study.points.pop() {
        *comparison = point.comparison;
    }
    written
}

/// Writes the report of a study into a folder, which is made if it is missing. Each file is complete
/// or not there. The names of the picture files are noted in `study`.
///
/// # Errors
/// [`LabError::Write`] if a file can't be written, [`LabError::Encode`] if a picture or a chart can't
/// be encoded.
pub fn write_study(study: &mut Study, folder: &Path) -> Result<ReportFiles, LabError> {
    let comparisons: Vec<&Comparison> = study.points.iter().map(|p| &p.comparison).collect();
    let images = images::encode(&comparisons)?;
    let pictures = write_pictures(study, &images, folder)?;
    let json = folder.join("report.json");
    write_atomically(&json, to_json(study)?.as_bytes())?;
    let write = |name: String, content: &[u8]| {
        let path = folder.join(name);
        write_atomically(&path, content).map(|()| path)
    };
    let csv = csv::TABLES
        .iter()
        .map(|(name, table)| write((*name).into(), csv::of_study(study, *table).as_bytes()))
        .collect::<Result<_, _>>()?;
    let analyses = of_study(study);
    let mut tables = Vec::new();
    for (name, table) in tables::all(study, &analyses) {
        tables.push(write(
            format!("tables/{name}.md"),
            table.markdown().as_bytes(),
        )?);
        tables.push(write(
            format!("tables/{name}.tex"),
            table.latex().as_bytes(),
        )?);
    }
    let mut charts = Vec::new();
    for (name, svg) in figures::all(study, &analyses) {
        charts.push(write(format!("charts/{name}.svg"), svg.as_bytes())?);
        charts.push(write(format!("charts/{name}.png"), &figures::png(&svg)?)?);
    }
    let html = folder.join("report.html");
    let page = html::study_page(study, &analyses, &images);
    write_atomically(&html, page.as_bytes())?;
    Ok(ReportFiles {
        html,
        json,
        csv,
        tables,
        charts,
        pictures,
    })
}

/// A study of one point that holds a comparison.
pub(super) fn of_one(comparison: Comparison) -> Study {
    let scene = Parameter {
        name: "scene".into(),
        value: comparison.scene.clone(),
    };
    let pipelines = comparison.pipelines.iter().map(|p| Choice {
        path: p.name.clone(),
        settings: p.parameters.clone(),
        ..Choice::default()
    });
    Study {
        schema: SCHEMA,
        plan: Plan {
            title: comparison.title.clone(),
            scenes: vec![Choice {
                path: comparison.scene.clone(),
                settings: comparison.parameters.clone(),
                ..Choice::default()
            }],
            pipelines: pipelines.collect(),
            size: comparison.size,
            reference: comparison.reference.clone(),
            warmup: comparison.warmup_frames,
            frames: comparison.frames,
            processes: comparison.processes.len().max(1) as u32,
            ..Plan::default()
        },
        points: vec![Point {
            key: format!("scene={}", comparison.scene),
            coordinates: vec![scene],
            comparison,
        }],
        missing: Vec::new(),
    }
}

fn write_pictures(
    study: &mut Study,
    images: &[Vec<Encoded>],
    folder: &Path,
) -> Result<Vec<PathBuf>, LabError> {
    let mut written = Vec::new();
    let mut taken = HashSet::new();
    let several = study.points.len() > 1;
    for (number, (point, images)) in study.points.iter_mut().zip(images).enumerate() {
        for (pipeline, image) in point.comparison.pipelines.iter_mut().zip(images) {
            let name = match several {
                true => format!("{}-{}", number + 1, pipeline.name),
                false => pipeline.name.clone(),
            };
            let stem = unique_stem(&name, &mut taken);
            let mut write = |png: &Option<Vec<u8>>, name: String| -> Result<_, LabError> {
                let Some(png) = png else { return Ok(None) };
                let path = folder.join(&name);
                write_atomically(&path, png)?;
                written.push(path);
                Ok(Some(name))
            };
            pipeline.picture_file = write(&image.picture, format!("pictures/{stem}.png"))?;
            pipeline.heat_map_file = write(&image.heat_map, format!("pictures/{stem}-flip.png"))?;
            for (view, png) in pipeline.views.iter_mut().zip(&image.views) {
                let stem = unique_stem(&format!("{stem}-{}", view.name), &mut taken);
                view.file = write(png, format!("pictures/{stem}.png"))?;
            }
        }
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

/// The study as JSON text.
///
/// # Errors
/// [`LabError::Encode`] if a value has no JSON form.
pub fn to_json(study: &Study) -> Result<String, LabError> {
    serde_json::to_string_pretty(study).map_err(|error| LabError::Encode {
        format: "JSON",
        reason: error.to_string(),
    })
}

/// Reads a study that [`write_study`] wrote.
///
/// # Errors
/// [`LabError::ReportData`] if the file can't be read, is no study, or has another schema.
pub fn read_json(path: &Path) -> Result<Study, LabError> {
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
            .chain(&files.tables)
            .chain(&files.charts)
            .chain(&files.pictures)
        {
            assert!(
                std::fs::metadata(path).unwrap().len() > 40,
                "{}",
                path.display()
            );
        }
        assert_eq!(files.pictures.len(), 3);
        let mut read = read_json(&files.json).unwrap().points.remove(0).comparison;
        for (p, original) in read.pipelines.iter_mut().zip(&c.pipelines) {
            assert!(place.join(p.picture_file.as_ref().unwrap()).is_file());
            p.picture = original.picture.clone();
            p.heat_map = original.heat_map.clone();
        }
        assert_eq!(read, c);
        // A second report replaces the first and leaves no temporary files.
        write_report(&mut c, &place).unwrap();
        assert_eq!(std::fs::read_dir(&place).unwrap().count(), 11);
    }

    #[test]
    fn wrong_data_is_explained() {
        let folder = tempfile::tempdir().unwrap();
        for (text, word) in [
            ("", "EOF"),
            ("{}", "no schema"),
            ("{\"schema\": 99}", "schema 99"),
            ("{\"schema\": 2}", "missing field"),
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
