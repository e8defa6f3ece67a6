//! The panels of the window.

pub mod actions;
pub mod console;
pub mod entities;
pub mod handles;
pub mod heat_map;
pub mod help;
pub mod history;
pub mod log;
pub mod marks;
pub mod menu;
pub mod palette;
pub mod parameters;
pub mod passes;
pub mod pixel;
pub mod plots;
pub mod saving;
pub mod select;
pub mod status;
pub mod targets;
pub mod toolbar;
pub mod viewport;
mod widgets;
