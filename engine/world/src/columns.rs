//! The columns of one component type: one array a field, in the same order.

use std::ops::Range;

use crate::batches::{Batch, BatchMarker, SliceSet, run_batches};
use crate::bits::{BitSet, Scratch};
use crate::entity::Entity;
use crate::merge::EntityMap;
use crate::reflect::{ComponentInfo, FieldInfo};
use crate::row_map::{RowMap, RowOrder};
use crate::ticks::{ChangeTicks, Tick};
use crate::value::{FieldSlice, FieldSliceMut, Value};

/// A component: its row type is a plain struct, its storage a set of arrays.
///
/// Implemented by the `components!` macro, never by hand.
pub trait Component: Clone + Default + std::fmt::Debug + PartialEq + Send + Sync + 'static {
    /// The arrays, one a field.
    type Arrays: Arrays<Row = Self>;

    /// The component's own description.
    const INFO: &'static ComponentInfo;
}

/// One array for every field of a component. All have the same length.
pub trait Arrays: Clone + Default + std::fmt::Debug + Send + Sync {
    /// All fields of one row together.
    type Row;
    /// A slice for every field.
    type Slices<'a>
    where
        Self: 'a;
    /// A mutable slice for every field.
    type SlicesMut<'a>: SliceSet
    where
        Self: 'a;

    /// Makes room for more rows.
    fn reserve(&mut self, additional: usize);
    /// Gives back room that no row uses.
    fn shrink_to_fit(&mut self);
    /// Adds a row at the end.
    fn push(&mut self, row: Self::Row);
    /// Adds a row at the end whose handles come from another world.
    fn push_mapped(&mut self, row: Self::Row, map: &EntityMap);
    /// Adds copies of a row at the end.
    fn extend_with(&mut self, row: Self::Row, count: usize);
    /// Drops a row and moves the last one into its place.
    fn discard(&mut self, row: usize);
    /// Moves each source row to a hole, and drops all rows from `len` on.
    fn fill_holes(&mut self, moves: &[(u32, u32)], len: usize);
    /// Takes a row out and moves the last one into its place.
    fn swap_remove(&mut self, row: usize) -> Self::Row;
    /// A copy of a row.
    fn get(&self, row: usize) -> Self::Row;
    /// Overwrites a row.
    fn set(&mut self, row: usize, value: Self::Row);
    /// Puts the rows into a new order: row `i` becomes what row `order[i]` was.
    fn reorder(&mut self, order: &[u32]);
    /// All arrays.
    fn slices(&self) -> Self::Slices<'_>;
    /// All arrays, to write.
    fn slices_mut(&mut self) -> Self::SlicesMut<'_>;
    /// One field of one row.
    fn field(&self, row: usize, field: usize) -> Option<Value>;
    /// Writes one field of one row.
    ///
    /// # Errors
    /// The value is of the wrong kind or, if that is to be checked, outside the
    /// field's range.
    fn set_field(
        &mut self,
        row: usize,
        field: usize,
        value: &Value,
        check: bool,
    ) -> Result<(), String>;
    /// The array of one field, if its elements are numbers or vectors.
    fn lend(&self, field: usize) -> FieldSlice<'_>;
    /// Like [`Arrays::lend`], to write.
    fn lend_mut(&mut self, field: usize) -> FieldSliceMut<'_>;
    /// Bytes that the arrays occupy, spare room included.
    fn capacity_bytes(&self) -> usize;
}

/// All rows of one component type.
///
/// Rows are dense: `0..len()`, in no order that callers may rely on, because a
/// removal moves the last row into the hole.
#[derive(Clone, Debug)]
pub struct Columns<C: Component> {
    map: RowMap,
    ticks: ChangeTicks,
    arrays: C::Arrays,
    /// The tick that writes carry.
    now: Tick,
}

impl<C: Component> Default for Columns<C> {
    fn default() -> Self {
        Self {
            map: RowMap::default(),
            ticks: ChangeTicks::default(),
            arrays: C::Arrays::default(),
            now: Tick::START.next(),
        }
    }
}

impl<C: Component> Columns<C> {
    /// The entity of each row.
    pub fn entities(&self) -> &[Entity] {
        self.map.entities()
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.map.entities().len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The row of an entity, `None` if it has no such component or the handle is
    /// stale.
    #[inline]
    pub fn row_of(&self, entity: Entity) -> Option<usize> {
        self.map.row_of(entity)
    }

    /// An entity's row by value.
    #[inline]
    pub fn get(&self, entity: Entity) -> Option<C> {
        Some(self.arrays.get(self.row_of(entity)?))
    }

    /// The row at a position.
    ///
    /// # Panics
    /// If `row` is not below [`Columns::len`].
    #[inline]
    pub fn row(&self, row: usize) -> C {
        self.arrays.get(row)
    }

    /// Overwrites the row at a position and marks it as changed.
    ///
    /// # Panics
    /// If `row` is not below [`Columns::len`].
    #[inline]
    pub fn set_row(&mut self, row: usize, value: C) {
        self.arrays.set(row, value);
        self.ticks.mark(row, self.now);
    }

    /// All fields as slices.
    pub fn slices(&self) -> <C::Arrays as Arrays>::Slices<'_> {
        self.arrays.slices()
    }

    /// All fields as mutable slices. Every row counts as changed.
    pub fn slices_mut(&mut self) -> <C::Arrays as Arrays>::SlicesMut<'_> {
        self.ticks.mark_all(self.now);
        self.arrays.slices_mut()
    }

    /// All fields as mutable slices, and the marker with which the caller
    /// reports each row that it changed.
    pub fn slices_and_marker(&mut self) -> (<C::Arrays as Arrays>::SlicesMut<'_>, Marker<'_>) {
        let marker = Marker {
            ticks: &mut self.ticks,
            now: self.now,
        };
        (self.arrays.slices_mut(), marker)
    }

    /// Runs a function over all rows in batches, in parallel where there are
    /// several. Each batch gets its first row, its slices and a marker with which
    /// it reports the rows that it changed, counted from the batch's first.
    ///
    /// What a row becomes must depend on nothing that another batch writes; the
    /// borrow checker sees to that.
    pub fn par_batches<'a>(
        &'a mut self,
        work: impl Fn(usize, <C::Arrays as Arrays>::SlicesMut<'a>, &mut BatchMarker<'_>) + Sync,
    ) {
        let batch = Batch::new(self.map.entities().len(), self.ticks.marks(), self.now);
        if run_batches(batch, self.arrays.slices_mut(), &work) {
            self.ticks.set_last(self.now);
        }
    }

    /// Rows written after a tick, in ascending order. A row that a removal moved
    /// to another position counts as written there.
    pub fn changed_since(&self, since: Tick) -> impl Iterator<Item = usize> + '_ {
        self.ticks.changed_in(0..self.len(), since)
    }

    /// Like [`Columns::changed_since`], for the rows of a range.
    ///
    /// # Panics
    /// If the range reaches beyond [`Columns::len`].
    pub fn changed_in(&self, rows: Range<usize>, since: Tick) -> impl Iterator<Item = usize> + '_ {
        self.ticks.changed_in(rows, since)
    }

    /// Whether the row at a position was written after a tick.
    #[inline]
    pub fn row_changed_since(&self, row: usize, since: Tick) -> bool {
        self.ticks.is_after(row, since)
    }

    /// Whether all rows were written together after a tick.
    pub(crate) fn all_changed_since(&self, since: Tick) -> bool {
        self.ticks.all_after(since)
    }

    /// Whether any row was written, added or removed after a tick.
    pub fn any_changed_since(&self, since: Tick) -> bool {
        self.ticks.last().is_after(since)
    }

    /// Names the present order of rows. While it stays the same, so does the
    /// entity of every row.
    pub fn layout(&self) -> RowOrder {
        self.map.layout()
    }

    /// One field of an entity by its position in the description.
    pub fn field(&self, entity: Entity, field: usize) -> Option<Value> {
        self.arrays.field(self.row_of(entity)?, field)
    }

    /// Bytes that these columns occupy, spare room and bookkeeping included.
    pub fn capacity_bytes(&self) -> usize {
        self.arrays.capacity_bytes() + self.map.capacity_bytes() + self.ticks.capacity_bytes()
    }

    /// The array of one field by its position in the description.
    pub(crate) fn lend(&self, field: usize) -> FieldSlice<'_> {
        self.arrays.lend(field)
    }

    /// Like [`Columns::lend`], to write, with what it takes to find the rows and to mark them.
    pub(crate) fn lend_mut(&mut self, field: usize) -> (FieldSliceMut<'_>, &RowMap, Marker<'_>) {
        let marker = Marker {
            ticks: &mut self.ticks,
            now: self.now,
        };
        (self.arrays.lend_mut(field), &self.map, marker)
    }

    pub(crate) fn set_now(&mut self, now: Tick) {
        self.now = now;
    }

    pub(crate) fn reserve(&mut self, additional: usize) {
        self.map.reserve(additional);
        self.ticks.reserve(additional);
        self.arrays.reserve(additional);
    }

    pub(crate) fn shrink_to_fit(&mut self) {
        self.map.shrink_to_fit();
        self.ticks.shrink_to_fit();
        self.arrays.shrink_to_fit();
    }

    /// Adds or overwrites an entity's row. True if it was added.
    #[inline]
    pub(crate) fn insert(&mut self, entity: Entity, value: C) -> bool {
        if let Some(row) = self.row_of(entity) {
            self.set_row(row, value);
            return false;
        }
        self.push(entity, value);
        true
    }

    /// Adds the row of an entity that is known to have none.
    #[inline]
    pub(crate) fn push(&mut self, entity: Entity, value: C) {
        self.map.push(entity);
        self.ticks.push(self.now);
        self.arrays.push(value);
    }

    #[inline]
    pub(crate) fn remove(&mut self, entity: Entity) -> Option<C> {
        let row = self.map.swap_remove(entity)?;
        self.ticks.swap_remove(row, self.now);
        Some(self.arrays.swap_remove(row))
    }

    /// Adds copies of all rows of another world's columns.
    pub(crate) fn append(&mut self, other: &Self, map: &EntityMap) {
        self.reserve(other.len());
        for (row, &entity) in other.entities().iter().enumerate() {
            if let Some(entity) = map.get(entity) {
                self.map.push(entity);
                self.ticks.push(self.now);
                self.arrays.push_mapped(other.row(row), map);
            }
        }
    }

    pub(crate) fn mark_all(&mut self) {
        self.ticks.mark_all(self.now);
    }

    /// Puts the rows into a new order: row `i` becomes what row `order[i]` was.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        self.map.reorder(order);
        self.arrays.reorder(order);
        self.ticks.mark_all(self.now);
    }

    /// Adds a row whose entity [`Columns::assign`] will name.
    #[inline]
    pub(crate) fn push_fields(&mut self, value: C) {
        self.arrays.push(value);
    }

    /// Names the entities of the rows that were added last. They must have had
    /// none before.
    pub(crate) fn assign(&mut self, entities: &[Entity]) {
        self.map.extend(entities);
        self.ticks.extend(entities.len(), self.now);
    }

    /// Adds default rows for entities that are known to have none.
    pub(crate) fn extend_default(&mut self, entities: &[Entity]) {
        self.assign(entities);
        self.arrays.extend_with(C::default(), entities.len());
    }

    /// Drops an entity's row, if it has one.
    #[inline]
    pub(crate) fn discard(&mut self, entity: Entity) {
        if let Some(row) = self.map.swap_remove(entity) {
            self.ticks.swap_remove(row, self.now);
            self.arrays.discard(row);
        }
    }

    /// Drops the rows of many entities. Memory is walked in order, which makes it
    /// many times faster than one by one.
    pub(crate) fn discard_slots(&mut self, slots: &BitSet, scratch: &mut Scratch) {
        if self.map.swap_remove_slots(slots, scratch) {
            let len = self.map.entities().len();
            self.arrays.fill_holes(&scratch.moves, len);
            for &(hole, _) in &scratch.moves {
                self.ticks.mark(hole as usize, self.now);
            }
            self.ticks.truncate(len, self.now);
        }
    }

    /// Changes the place of an entity's row with that of the row at a position. Nothing happens where
    /// there is none.
    pub(crate) fn swap_to(&mut self, entity: Entity, place: usize) {
        let Some(row) = self.row_of(entity).filter(|_| place < self.len()) else {
            return;
        };
        if row == place {
            return;
        }
        self.map.swap(row, place);
        let (a, b) = (self.arrays.get(row), self.arrays.get(place));
        self.set_row(row, b);
        self.set_row(place, a);
    }

    pub(crate) fn mark(&mut self, entity: Entity) {
        if let Some(row) = self.row_of(entity) {
            self.ticks.mark(row, self.now);
        }
    }

    pub(crate) fn set_field(
        &mut self,
        row: usize,
        field: usize,
        value: &Value,
        check: bool,
    ) -> Result<(), String> {
        self.arrays.set_field(row, field, value, check)?;
        self.ticks.mark(row, self.now);
        Ok(())
    }
}

/// Reports rows as changed while their slices are borrowed.
pub struct Marker<'a> {
    ticks: &'a mut ChangeTicks,
    now: Tick,
}

impl Marker<'_> {
    /// Marks one row as changed.
    #[inline]
    pub fn mark(&mut self, row: usize) {
        self.ticks.mark(row, self.now);
    }

    /// Whether the row at a position was written after a tick.
    #[inline]
    pub fn row_changed_since(&self, row: usize, since: Tick) -> bool {
        self.ticks.is_after(row, since)
    }

    /// Marks every row as changed.
    pub fn mark_all(&mut self) {
        self.ticks.mark_all(self.now);
    }
}

/// Checks that the numbers of a field lie within its range.
pub(crate) fn check_range(
    info: &FieldInfo,
    (numbers, count): ([f32; 4], usize),
) -> Result<(), String> {
    let (least, greatest) = info.range;
    match numbers[..count]
        .iter()
        .find(|&&number| !(least..=greatest).contains(&number))
    {
        None => Ok(()),
        Some(number) if number.is_nan() => Err("the value is not a number".to_owned()),
        Some(number) => Err(format!(
            "{number} is outside {least} to {greatest} {}",
            info.unit
        )),
    }
}
