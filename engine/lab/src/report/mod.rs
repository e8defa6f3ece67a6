//! Comparison reports: data, words, files.
//!
//! [`Comparison`] is what was measured. [`analysis`] decides what the numbers allow to be said,
//! [`summary`] says it, [`write_report`] writes it all: one HTML file that needs nothing else, and
//! JSON and CSV for programs.

pub mod analysis;
pub mod csv;
mod figures;
pub mod format;
pub mod html;
mod images;
pub mod lines;
mod model;
#[cfg(test)]
pub(crate) mod sample;
pub mod summary;
mod tables;
mod theory;
mod write;

pub use model::{
    AbilityResult, Adapter, Comparison, CounterResult, Input, Machine, Parameter, PassResult,
    PipelineResult, ProcessRecord, SCHEMA, Seed, SystemResult, TargetResult, ViewResult,
};
pub use write::{ReportFiles, read_json, to_json, write_report, write_study};
