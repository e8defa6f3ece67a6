//! Systems: functions over columns.
//!
//! A system reads some columns and writes others. It runs over whole arrays and
//! touches only rows whose inputs have changed.

mod bounds;
mod frame;
mod motion;
mod world_matrices;

pub use bounds::{MeshBounds, update_bounds};
pub use frame::{FrameSystems, update_computed};
pub use motion::{animate, move_by_velocity};
pub use world_matrices::update_world_matrices;

/// What the systems remember from one run to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct SystemState {
    matrices: world_matrices::MatrixState,
    matrices_2d: world_matrices::MatrixState,
    bounds: bounds::BoundsState,
}
