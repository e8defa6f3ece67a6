//! Frames, shader composition and the pass pipeline.
#![warn(missing_docs)]

pub mod description;
pub mod format;
pub mod problem;

pub use description::PipelineDesc;
pub use format::Format;
pub use problem::{Place, Problem, Problems};
