//! Lightbench: one door to the whole workbench.
#![warn(missing_docs)]

pub use lightbench_assets as assets;
pub use lightbench_lab as lab;
pub use lightbench_render as render;
pub use lightbench_script as script;
pub use lightbench_world as world;
