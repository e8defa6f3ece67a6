//! Studies: comparisons at several points, that can be stopped, resumed, split and merged.

mod model;

pub use model::{Axis, Choice, Plan, Point, SIZE, START, Study, TRACED};
