//! Measuring lighting pipelines and saying what came out.
//!
//! The laboratory turns pictures and timings into statements that hold:
//!
//! - [`metrics`] say how far a picture is from a reference, each with its exact formula
//!   ([`metrics::Metric::definition`]). 8-bit pictures are compared as a display shows them, linear
//!   ones before the tone curve.
//! - [`diff`] takes two pictures, or two files, and gives all metrics and the map of the error.
//! - [`colormap`] and [`heatmap`] paint such maps.
//! - [`statistics`] summarise timings with medians and intervals that assume no distribution.
//! - [`report`] holds a comparison of pipelines as data and writes it as one HTML file, as JSON and
//!   as CSV, with a summary in words that claims nothing beyond the intervals.
//!
//! - [`mod@reference`] has the shaders' formulas on the CPU, and [`tracer`] a path tracer that uses them;
//!   [`mitsuba`] writes scenes for another one.
//!
//! - [`capture`] takes a picture of a scene, [`inspect`] looks into its frame pass by pass,
//!   [`experiment`] does both for scripts, [`measure`] times pipelines on it, [`curves`] does so for
//!   values of a parameter; [`lesson`] checks what students hand in. They need a GPU; the rest doesn't.
//!
//! ```
//! use lightbench_lab::{LdrImage, diff};
//!
//! let reference = LdrImage::from_fn(64, 36, |x, y| [x as u8 * 4, y as u8 * 7, 128, 255]);
//! let mut test = reference.clone();
//! test.pixels[100] = [255, 255, 255, 255];
//! let found = diff::diff_ldr(&reference, &test, diff::DiffOptions::default())?.difference;
//! assert!(found.flip.max > 0.1 && found.flip.mean < 0.01);
//! # Ok::<(), lightbench_lab::LabError>(())
//! ```

#![warn(missing_docs)]

pub mod capture;
pub mod colormap;
pub mod curves;
pub mod diff;
mod error;
pub mod experiment;
pub mod files;
pub mod heatmap;
pub mod inspect;
pub mod lesson;
pub mod measure;
pub mod metrics;
pub mod mitsuba;
mod picture;
pub mod reference;
pub mod report;
pub mod shown;
pub mod statistics;
pub mod study;
pub mod svg;
pub mod tracer;

pub use error::LabError;
pub use picture::{HdrImage, LdrImage, Picture};
