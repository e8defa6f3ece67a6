//! The program `lightbench` as a library: the editor's window and the command line.

pub mod cli;
pub mod ui;
pub mod viewpoint;
