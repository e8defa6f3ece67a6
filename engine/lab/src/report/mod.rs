//! Comparison reports: data, words, files.
//!
//! [`Comparison`] is what was measured. [`analysis`] decides what the numbers allow to be said,
//! [`summary`] says it, [`write_report`] writes it all: one HTML file that needs nothing else, and
//! JSON and CSV for programs.

pub mod analysis;
pub mod csv;
pub mod format;
pub mod html;
mod images;
mod model;
#[cfg(test)]
pub(crate) mod sample;
mod study_files;
pub mod summary;
mod write;

pub use model::{
    AbilityResult, Adapter, Comparison, CounterResult, Input, Machine, Parameter, PassResult,
    PipelineResult, ProcessRecord, SCHEMA, Seed, SystemResult, TargetResult, ViewResult,
};
pub use study_files::{read_study, write_study};
pub use write::{ReportFiles, read_json, to_json, write_report};
