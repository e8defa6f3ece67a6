//! Grading a folder of hand-ins without anybody there.
//!
//! Each hand-in is unpacked into a folder of its own and checked by a process of its own, which may hang,
//! crash or eat memory without harm to the others ([`crate::supervise`], [`crate::confine`]). What came of
//! it is written before the next one begins, so that a grading that was stopped goes on where it was.

mod identity;
mod queue;
mod record;

pub use identity::{Marked, Reason, mark};
pub use queue::{Assignment, GradeError, NOT_ENFORCED, Options, Told, grade, prepared};
pub use record::{Ending, RECORD_SCHEMA, Record};
