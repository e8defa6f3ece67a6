//! Everything that can go wrong in the laboratory.

use std::path::PathBuf;

/// An error of a metric, of a picture file or of a report.
#[derive(Debug, thiserror::Error)]
pub enum LabError {
    /// Two pictures of different size can't be compared.
    #[error(
        "the pictures differ in size: the reference has {reference_width} × {reference_height} \
         pixels, the test has {test_width} × {test_height}; render both at one size"
    )]
    SizeMismatch {
        /// Width of the reference in pixels.
        reference_width: u32,
        /// Height of the reference in pixels.
        reference_height: u32,
        /// Width of the picture under test in pixels.
        test_width: u32,
        /// Height of the picture under test in pixels.
        test_height: u32,
    },

    /// The pixel array does not fill the stated size, or the size is zero.
    #[error(
        "a picture of {width} × {height} pixels needs {expected} pixels, but {found} were given"
    )]
    PixelCount {
        /// Stated width in pixels.
        width: u32,
        /// Stated height in pixels.
        height: u32,
        /// Pixels that the size needs; zero for an empty picture, which is refused.
        expected: u64,
        /// Pixels that were given.
        found: u64,
    },

    /// A picture with display values and one with linear values were put side by side.
    #[error(
        "{reference} holds {reference_range} values and {test} holds {test_range} values; \
         compare two files of one kind (two PNG files, or two EXR files)"
    )]
    RangeMismatch {
        /// Path of the reference.
        reference: PathBuf,
        /// "8-bit sRGB" or "linear HDR".
        reference_range: &'static str,
        /// Path of the picture under test.
        test: PathBuf,
        /// "8-bit sRGB" or "linear HDR".
        test_range: &'static str,
    },

    /// A parameter of a metric or of a statistic is outside its range.
    #[error("{name} is {value}, but must be {range}")]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// The refused value.
        value: f64,
        /// The allowed range in words.
        range: &'static str,
    },

    /// A picture file could not be read.
    #[error("can't read the picture {path}: {reason}")]
    PictureFile {
        /// The file.
        path: PathBuf,
        /// What the decoder or the system said.
        reason: String,
    },

    /// A picture could not be encoded.
    #[error("can't encode a picture as {format}: {reason}")]
    Encode {
        /// Name of the file format.
        format: &'static str,
        /// What the encoder said.
        reason: String,
    },

    /// A file or folder could not be written.
    #[error("can't write {path}: {source}; choose a folder that you may write to with --out")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },

    /// The data of a report could not be read.
    #[error("{path} holds no comparison that this version can read: {reason}")]
    ReportData {
        /// The file, or a name for the text.
        path: PathBuf,
        /// What is wrong, with line and column where known.
        reason: String,
    },
}
