//! How code that knows a component only by type, or by a number, reaches its
//! columns. All of it is resolved when the program is compiled.

use crate::columns::{Columns, Component};
use crate::components::{ComponentKind, Row, Stores};
use crate::entity::Entity;
use crate::ticks::Tick;

/// A component that every world has columns for.
///
/// Implemented by the `components!` macro, never by hand.
pub trait Stored: Component + Into<Row> {
    /// The component's number.
    const KIND: ComponentKind;
    /// The bit of this component and that of the one that follows it.
    const BITS: u32;

    /// This component's columns.
    fn columns(stores: &Stores) -> &Columns<Self>;
    /// This component's columns, to write.
    fn columns_mut(stores: &mut Stores) -> &mut Columns<Self>;
    /// Adds the row of the computed component that follows this one.
    fn push_follower(_stores: &mut Stores, _entity: Entity, _now: Tick) {}
    /// Adds rows of the computed component that follows this one.
    fn extend_follower(_stores: &mut Stores, _entities: &[Entity], _now: Tick) {}
    /// Makes room in the columns of the computed component that follows this one.
    fn reserve_follower(_stores: &mut Stores, _additional: usize) {}
    /// Puts the rows of the computed component that follows this one into a new
    /// order.
    fn reorder_follower(_stores: &mut Stores, _order: &[u32], _now: Tick) {}
    /// Removes the row of the computed component that follows this one.
    fn remove_follower(_stores: &mut Stores, _entity: Entity, _now: Tick) {}
}

/// A function over the columns of any component.
pub(crate) trait Visitor {
    fn visit<C: Stored>(&mut self, columns: &Columns<C>);
}

/// A function that changes the columns of any component.
pub(crate) trait VisitorMut {
    fn visit<C: Stored>(&mut self, columns: &mut Columns<C>);
}
