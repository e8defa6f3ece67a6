//! The two-way map between entities and the rows of one set of columns.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::bits::{BitSet, Scratch};
use crate::entity::Entity;

/// Names one order of rows. While a set of columns reports the same layout, the
/// entity of every row stays the same. No two sets of columns ever share one,
/// copies of a world included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowOrder {
    columns: u64,
    version: u64,
}

impl RowOrder {
    fn fresh() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self {
            columns: NEXT.fetch_add(1, Ordering::Relaxed),
            version: 0,
        }
    }
}

/// No row: the entity has no such component.
const NO_ROW: u32 = u32::MAX;

/// `dense → entity` and `entity → dense` (Briggs and Torczon 1993, "An efficient
/// representation for sparse sets").
#[derive(Debug)]
pub(crate) struct RowMap {
    /// The entity of each row.
    entities: Vec<Entity>,
    /// The row of each entity, by slot index.
    rows: Vec<u32>,
    /// Changes with the order, so that a cached join knows when it is old.
    layout: RowOrder,
}

impl Default for RowMap {
    fn default() -> Self {
        Self {
            entities: Vec::new(),
            rows: Vec::new(),
            layout: RowOrder::fresh(),
        }
    }
}

impl Clone for RowMap {
    fn clone(&self) -> Self {
        Self {
            entities: self.entities.clone(),
            rows: self.rows.clone(),
            layout: RowOrder::fresh(),
        }
    }
}

impl RowMap {
    pub fn entities(&self) -> &[Entity] {
        &self.entities
    }

    pub fn layout(&self) -> RowOrder {
        self.layout
    }

    /// The row of an entity. A stale handle has none: the row's owner is
    /// compared with the whole handle, generation included.
    #[inline]
    pub fn row_of(&self, entity: Entity) -> Option<usize> {
        let row = *self.rows.get(entity.index() as usize)? as usize;
        (self.entities.get(row) == Some(&entity)).then_some(row)
    }

    pub fn reserve(&mut self, additional: usize) {
        self.entities.reserve(additional);
        self.rows.reserve(additional);
    }

    /// Adds a row at the end. The entity must not have one.
    #[inline]
    pub fn push(&mut self, entity: Entity) {
        let slot = entity.index() as usize;
        if slot >= self.rows.len() {
            self.rows.resize(slot + 1, NO_ROW);
        }
        self.rows[slot] = self.entities.len() as u32;
        self.entities.push(entity);
        self.layout.version += 1;
    }

    /// Adds rows at the end. The entities must not have any.
    pub fn extend(&mut self, entities: &[Entity]) {
        let first = self.entities.len() as u32;
        let new_slots = self.rows.len() as u32..;
        if entities
            .iter()
            .map(|entity| entity.index())
            .eq(new_slots.take(entities.len()))
        {
            // All slots are new, one after the other, and so are the rows.
            self.rows.extend(first..first + entities.len() as u32);
        } else {
            for (entity, row) in entities.iter().zip(first..) {
                let slot = entity.index() as usize;
                if slot >= self.rows.len() {
                    self.rows.resize(slot + 1, NO_ROW);
                }
                self.rows[slot] = row;
            }
        }
        self.entities.extend_from_slice(entities);
        self.layout.version += 1;
    }

    /// Removes the rows of all entities of some slots: those that lie at the end
    /// move, in order, into the holes before them. Leaves the moves (hole and
    /// source) in `scratch`. False if there was no row to remove.
    pub fn swap_remove_slots(&mut self, slots: &BitSet, scratch: &mut Scratch) -> bool {
        let holes = &mut scratch.holes;
        holes.reset(self.entities.len());
        let mut count = 0;
        for slot in slots.iter() {
            let Some(row) = self.rows.get_mut(slot) else {
                break;
            };
            if *row != NO_ROW {
                holes.insert(*row as usize);
                *row = NO_ROW;
                count += 1;
            }
        }
        let len = self.entities.len() - count;
        let sources = (len..self.entities.len()).filter(|&row| !holes.contains(row));
        let moves = holes.iter().take_while(|&hole| hole < len).zip(sources);
        scratch.moves.clear();
        scratch
            .moves
            .extend(moves.map(|(hole, source)| (hole as u32, source as u32)));
        for &(hole, source) in &scratch.moves {
            let entity = self.entities[source as usize];
            self.entities[hole as usize] = entity;
            self.rows[entity.index() as usize] = hole;
        }
        self.entities.truncate(len);
        self.layout.version += 1;
        count > 0
    }

    /// Removes an entity's row by moving the last one into its place, and
    /// returns the row that was freed.
    #[inline]
    pub fn swap_remove(&mut self, entity: Entity) -> Option<usize> {
        let row = self.row_of(entity)?;
        self.rows[entity.index() as usize] = NO_ROW;
        self.entities.swap_remove(row);
        if let Some(moved) = self.entities.get(row) {
            self.rows[moved.index() as usize] = row as u32;
        }
        self.layout.version += 1;
        Some(row)
    }

    /// Changes the places of two rows.
    pub fn swap(&mut self, a: usize, b: usize) {
        self.entities.swap(a, b);
        for row in [a, b] {
            self.rows[self.entities[row].index() as usize] = row as u32;
        }
        self.layout.version += 1;
    }

    /// Row `i` becomes what row `order[i]` was.
    pub fn reorder(&mut self, order: &[u32]) {
        self.entities = order
            .iter()
            .map(|&row| self.entities[row as usize])
            .collect();
        for (row, entity) in self.entities.iter().enumerate() {
            self.rows[entity.index() as usize] = row as u32;
        }
        self.layout.version += 1;
    }

    pub fn shrink_to_fit(&mut self) {
        let used = self.rows.iter().rposition(|&row| row != NO_ROW);
        self.rows.truncate(used.map_or(0, |last| last + 1));
        self.rows.shrink_to_fit();
        self.entities.shrink_to_fit();
    }

    pub fn capacity_bytes(&self) -> usize {
        self.entities.capacity() * size_of::<Entity>() + self.rows.capacity() * size_of::<u32>()
    }
}
