//! Interim.

use std::path::Path;

use super::model::SCHEMA;
use crate::LabError;
use crate::files::write_atomically;
use crate::study::Study;

/// Writes a study.
///
/// # Errors
/// A disk that can't be written.
pub fn write_study(study: &mut Study, folder: &Path) -> Result<(), LabError> {
    for (index, point) in study.points.iter_mut().enumerate().rev() {
        let place = match index {
            0 => folder.to_owned(),
            index => folder.join(format!("point-{index}")),
        };
        super::write_report(&mut point.comparison, &place)?;
        for pipeline in &mut point.comparison.pipelines {
            if let (Some(file), true) = (&mut pipeline.picture_file, index > 0) {
                *file = format!("point-{index}/{file}");
            }
        }
    }
    let text = serde_json::to_string(study).map_err(|error| LabError::Encode {
        format: "JSON",
        reason: error.to_string(),
    })?;
    write_atomically(&folder.join("report.json"), text.as_bytes())
}

/// Reads a study.
///
/// # Errors
/// A file that holds none.
pub fn read_study(path: &Path) -> Result<Study, LabError> {
    let fail = |reason: String| LabError::ReportData {
        path: path.to_path_buf(),
        reason,
    };
    let text = std::fs::read_to_string(path).map_err(|error| fail(error.to_string()))?;
    let study: Study = serde_json::from_str(&text).map_err(|error| fail(error.to_string()))?;
    if study.schema != SCHEMA {
        return Err(fail(format!(
            "it has schema {}, and schema {SCHEMA} is known",
            study.schema
        )));
    }
    Ok(study)
}
