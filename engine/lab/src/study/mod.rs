//! Studies: comparisons at several points, that can be stopped, resumed, split and merged.
//!
//! A [`Plan`] says what to measure. [`Worker processes`](work) measure its points and leave what they
//! found in a [`Store`]; [`join`] makes one [`Study`] of it. [`Shard`] deals the points to machines.

pub mod bundle;
pub mod history;
mod join;
mod model;
mod points;
mod processes;
mod store;
pub mod tuning;
mod viewing;
mod views;
mod worker;

pub use join::{JoinError, drop_stale, join};
pub use model::{Axis, CAMERA, Choice, FixedView, Plan, Point, SIZE, START, Study, TRACED, Tuned};
pub use points::{MOST_POINTS, PlanError, Planned, Shard};
pub use processes::{Launch, Line, ProcessError, Told, in_words, run_processes};
pub use store::{Part, Store, StoreError};
pub use worker::{Process, Remark, StudyError, work};
