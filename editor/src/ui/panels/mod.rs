//! The panels of the window.

pub mod actions;
pub mod console;
pub mod entities;
pub mod heat_map;
pub mod help;
pub mod log;
pub mod menu;
pub mod parameters;
pub mod passes;
pub mod pixel;
pub mod plots;
pub mod status;
pub mod targets;
pub mod toolbar;
pub mod viewport;
mod widgets;
