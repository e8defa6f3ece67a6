//! All metrics of two pictures at once.

mod lines;

pub use lines::Line;
pub(crate) use lines::{ldr_lines, linear_lines, number, percent};

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::LabError;
use crate::metrics::{
    self, ErrorLocation, FlipOptions, LinearErrors, MapStatistics, Plane, SrgbErrors,
};
use crate::picture::{HdrImage, LdrImage, Picture};

/// What is asked of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffOptions {
    /// Viewing conditions of FLIP.
    pub flip: FlipOptions,
    /// FLIP above which a pixel counts as differing.
    pub bound: f64,
}

impl Default for DiffOptions {
    fn default() -> Self {
        Self {
            flip: FlipOptions::default(),
            bound: metrics::DEFAULT_BOUND,
        }
    }
}

/// The difference of two 8-bit sRGB pictures in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LdrDifference {
    /// Viewing distance in pixels per degree.
    pub pixels_per_degree: f64,
    /// FLIP, pooled.
    pub flip: MapStatistics,
    /// Pointwise errors.
    pub srgb: SrgbErrors,
    /// Structural similarity, 1 for equal pictures.
    pub ssim: f64,
    /// Where the FLIP error lies.
    pub location: ErrorLocation,
}

impl LdrDifference {
    /// Whether R, G and B of all pixels are equal.
    pub fn is_identical(&self) -> bool {
        self.srgb.max_steps == 0
    }
}

/// The difference of two linear pictures in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HdrDifference {
    /// Viewing distance in pixels per degree.
    pub pixels_per_degree: f64,
    /// HDR-FLIP, pooled.
    pub flip: MapStatistics,
    /// Darkest and brightest exposure of HDR-FLIP in stops.
    pub exposure_range: [f64; 2],
    /// Number of exposures of HDR-FLIP.
    pub exposures: u32,
    /// Pointwise errors.
    pub linear: LinearErrors,
}

/// Numbers and map of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Diff<T> {
    /// The numbers.
    pub difference: T,
    /// FLIP of each pixel, 0 to 1; [`crate::heatmap`] paints it.
    pub map: Plane,
}

/// Compares two 8-bit sRGB pictures.
///
/// # Errors
/// If the sizes differ or an option is out of range.
pub fn diff_ldr(
    reference: &LdrImage,
    test: &LdrImage,
    options: DiffOptions,
) -> Result<Diff<LdrDifference>, LabError> {
    check_bound(options.bound)?;
    let map = metrics::ldr_flip(reference, test, options.flip)?;
    let difference = LdrDifference {
        pixels_per_degree: options.flip.pixels_per_degree,
        flip: MapStatistics::of(&map, options.bound),
        srgb: metrics::srgb_errors(reference, test)?,
        ssim: metrics::ssim(reference, test)?,
        location: ErrorLocation::of(&map, reference),
    };
    Ok(Diff { difference, map })
}

/// Compares two linear pictures.
///
/// # Errors
/// If the sizes differ or an option is out of range.
pub fn diff_hdr(
    reference: &HdrImage,
    test: &HdrImage,
    options: DiffOptions,
) -> Result<Diff<HdrDifference>, LabError> {
    check_bound(options.bound)?;
    let flip = metrics::hdr_flip(reference, test, options.flip)?;
    let difference = HdrDifference {
        pixels_per_degree: options.flip.pixels_per_degree,
        flip: MapStatistics::of(&flip.map, options.bound),
        exposure_range: [flip.start_exposure, flip.stop_exposure],
        exposures: flip.exposures,
        linear: metrics::linear_errors(reference, test)?,
    };
    Ok(Diff {
        difference,
        map: flip.map,
    })
}

fn check_bound(bound: f64) -> Result<(), LabError> {
    if (0.0..=1.0).contains(&bound) {
        return Ok(());
    }
    Err(LabError::Parameter {
        name: "the bound of FLIP",
        value: bound,
        range: "from 0 to 1",
    })
}

/// The difference of two picture files.
#[derive(Clone, Debug, PartialEq)]
pub enum FileDiff {
    /// Both files hold 8-bit sRGB.
    Ldr(Diff<LdrDifference>),
    /// Both files hold linear values.
    Hdr(Diff<HdrDifference>),
}

/// Compares two picture files of one kind.
///
/// # Errors
/// If a file can't be read, one is 8-bit and the other linear, or the sizes differ.
pub fn diff_files(
    reference: &Path,
    test: &Path,
    options: DiffOptions,
) -> Result<FileDiff, LabError> {
    match (Picture::open(reference)?, Picture::open(test)?) {
        (Picture::Ldr(a), Picture::Ldr(b)) => diff_ldr(&a, &b, options).map(FileDiff::Ldr),
        (Picture::Hdr(a), Picture::Hdr(b)) => diff_hdr(&a, &b, options).map(FileDiff::Hdr),
        (a, b) => Err(LabError::RangeMismatch {
            reference: reference.to_path_buf(),
            reference_range: a.range(),
            test: test.to_path_buf(),
            test_range: b.range(),
        }),
    }
}

impl FileDiff {
    /// FLIP of each pixel.
    pub fn map(&self) -> &Plane {
        match self {
            Self::Ldr(diff) => &diff.map,
            Self::Hdr(diff) => &diff.map,
        }
    }

    /// The numbers as JSON.
    pub fn to_json(&self) -> serde_json::Value {
        let (space, numbers) = match self {
            Self::Ldr(diff) => ("8-bit sRGB", serde_json::to_value(&diff.difference)),
            Self::Hdr(diff) => ("linear HDR", serde_json::to_value(&diff.difference)),
        };
        serde_json::json!({ "space": space, "difference": numbers.unwrap_or_default() })
    }

    /// The numbers for people, in the order in which a report prints them.
    pub fn lines(&self) -> Vec<Line> {
        match self {
            Self::Ldr(diff) => lines::ldr_lines(&diff.difference),
            Self::Hdr(diff) => lines::hdr_lines(&diff.difference),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn files_of_two_kinds_are_refused_and_equal_ones_have_no_difference() {
        let folder = tempfile::tempdir().unwrap();
        let (png, exr) = (folder.path().join("a.png"), folder.path().join("a.exr"));
        let ldr = LdrImage::from_fn(20, 10, |x, y| [x as u8 * 9, y as u8 * 9, 40, 255]);
        std::fs::write(&png, ldr.to_png().unwrap()).unwrap();
        let values: Vec<f32> = (0..20 * 10 * 3).map(|i| i as f32 * 0.01).collect();
        image::Rgb32FImage::from_raw(20, 10, values)
            .unwrap()
            .save(&exr)
            .unwrap();
        let options = DiffOptions::default();
        let text = diff_files(&png, &exr, options).unwrap_err().to_string();
        assert!(
            text.contains("a.png") && text.contains("linear HDR"),
            "{text}"
        );
        for path in [&png, &exr] {
            let diff = diff_files(path, path, options).unwrap();
            assert!(diff.map().values.iter().all(|v| *v == 0.0));
            assert!(diff.lines().iter().any(|l| l.value == "∞ dB (equal)"));
        }
        let FileDiff::Ldr(diff) = diff_files(&png, &png, options).unwrap() else {
            panic!()
        };
        assert!(diff.difference.is_identical());
    }

    #[test]
    fn a_changed_pixel_shows_in_every_number() {
        let a = LdrImage::from_fn(32, 32, |_, _| [90, 90, 90, 255]);
        let mut b = a.clone();
        b.pixels[500] = [255, 0, 0, 255];
        let d = diff_ldr(&a, &b, DiffOptions::default()).unwrap().difference;
        assert!(!d.is_identical() && d.flip.max > 0.1 && d.ssim < 1.0);
        assert_eq!(d.srgb.share_different, 1.0 / 1024.0);
        let text = serde_json::to_string(&d).unwrap();
        assert_eq!(serde_json::from_str::<LdrDifference>(&text).unwrap(), d);
        assert!(
            diff_ldr(
                &a,
                &b,
                DiffOptions {
                    bound: 2.0,
                    ..Default::default()
                }
            )
            .is_err()
        );
    }
}
