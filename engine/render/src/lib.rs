//! Frames, shader composition and the pass pipeline.
//!
//! The way of a picture: [`description`] says what a pipeline is, [`validate`] checks it,
//! [`compile`] builds it, [`frame`] extracts what is visible from a world, [`scene`] holds it on
//! the GPU, [`record`] runs the passes. [`Renderer`] joins them.
#![warn(missing_docs)]

mod attachments;
pub mod binding;
pub mod compile;
pub mod compiled_pass;
pub mod description;
pub mod engine_buffers;
pub mod fallback;
pub mod format;
mod fragment_counts;
pub mod frame;
pub mod gpu;
pub mod gpu_data;
pub mod gpu_pipelines;
pub mod guard;
pub mod heap;
pub mod heat_map;
pub mod inspect;
pub mod layout;
pub mod life;
mod needs;
pub mod overlay;
mod parameters;
pub mod pipeline;
pub mod problem;
pub mod queries;
pub mod readback;
pub mod record;
pub mod reflection;
mod renderer;
mod room;
pub mod scene;
pub mod series;
pub mod shader;
pub mod statistics;
pub mod targets;
pub mod traffic;
pub mod validate;
pub mod variant;
pub mod view;
pub mod volumes;
mod way_back;

pub use compile::Compiler;
pub use description::PipelineDesc;
pub use format::Format;
pub use gpu::{Gpu, GpuError, GpuOptions};
pub use inspect::Inspection;
pub use pipeline::Pipeline;
pub use problem::{Place, Problem, Problems};
pub use readback::TargetImage;
pub use renderer::{RenderError, Renderer};
pub use statistics::{FrameStatistics, PassStatistics};
pub use variant::Variants;
pub use view::View;
