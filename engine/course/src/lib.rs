//! Hand-ins of students, and their grading.
//!
//! - [`archive`] packs what is handed in, and unpacks what strangers send;
//! - [`hand_in`] makes the archive of a work;
//! - [`exports`] finds each student's newest hand-in in what Moodle or Canvas exports;
//! - [`supervise`] runs a process that may hang, crash or take all memory;
//! - [`confine`] takes from a process what it needs not have;
//! - [`grading`] has each hand-in checked by such a process, and keeps what came of it;
//! - [`book`] makes tables and pages of that.
#![warn(missing_docs)]

pub mod archive;
pub mod book;
pub mod confine;
pub mod exports;
pub mod grading;
pub mod hand_in;
pub mod supervise;
