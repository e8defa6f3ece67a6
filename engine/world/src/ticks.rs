//! Change ticks: when each row was last written.
//!
//! An observer (the renderer, for one) asks the world for a tick, does its work,
//! and later asks which rows were written after that tick. Asking for a tick
//! closes it: whatever is written afterwards carries a later one.

use std::ops::Range;

/// A moment in the history of a world.
///
/// Ticks are compared by their distance, so that the counter may wrap. Rows that
/// nobody wrote for 2³¹ ticks (a month at 60 frames a second with ten observers)
/// are reported as changed again, which costs uploads and is never an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Tick(pub(crate) u32);

impl Tick {
    /// Before the first write of any world: everything has changed since then.
    pub const START: Self = Self(0);

    /// Whether this moment lies after `other`.
    pub fn is_after(self, other: Self) -> bool {
        self.0.wrapping_sub(other.0) as i32 > 0
    }

    pub(crate) fn next(self) -> Self {
        Self(self.0.wrapping_add(1))
    }
}

/// Rows that share one summary tick, so that a search skips what did not change.
pub(crate) const BLOCK: usize = 256;

/// The ticks of one set of columns.
#[derive(Clone, Debug)]
pub(crate) struct ChangeTicks {
    /// Numbers instead of ticks, so that room for more rows can be zeroed memory.
    rows: Vec<u32>,
    /// Number of rows; what follows in `rows` is room.
    len: usize,
    /// The latest tick of every run of `BLOCK` rows.
    blocks: Vec<Tick>,
    /// All rows changed at this tick: marks a whole column without a loop.
    all: Tick,
    /// The latest change of any row, or of the number of rows.
    last: Tick,
}

impl Default for ChangeTicks {
    fn default() -> Self {
        Self {
            rows: Vec::new(),
            len: 0,
            blocks: Vec::new(),
            all: Tick::START,
            last: Tick::START,
        }
    }
}

impl ChangeTicks {
    /// Makes room. The first room is zeroed memory, which the allocator gives for
    /// nothing until it is written.
    pub fn reserve(&mut self, additional: usize) {
        if self.rows.is_empty() {
            self.rows = vec![0; additional];
        } else {
            self.rows
                .reserve((self.len + additional).saturating_sub(self.rows.len()));
        }
    }

    pub fn push(&mut self, now: Tick) {
        match self.rows.get_mut(self.len) {
            Some(row) => *row = now.0,
            None => self.rows.push(now.0),
        }
        let block = self.len / BLOCK;
        self.len += 1;
        if block == self.blocks.len() {
            self.blocks.push(now);
        } else {
            self.blocks[block] = now;
        }
        self.last = now;
    }

    /// Adds rows that are written now. Where the tick of all rows says so, the
    /// rows' own ticks are left alone.
    pub fn extend(&mut self, count: usize, now: Tick) {
        if self.len == 0 {
            self.all = now;
        }
        let end = self.len + count;
        if end > self.rows.len() {
            self.rows.resize(end, now.0);
        }
        if self.all != now {
            self.rows[self.len..end].fill(now.0);
        }
        let first = self.len / BLOCK;
        self.len = end;
        self.blocks.resize(end.div_ceil(BLOCK), now);
        self.blocks[first..].fill(now);
        self.last = now;
    }

    /// Drops the rows from `len` on.
    pub fn truncate(&mut self, len: usize, now: Tick) {
        self.len = len;
        self.blocks.truncate(len.div_ceil(BLOCK));
        self.last = now;
    }

    /// Follows a swap-remove: the row that took the place has changed there.
    pub fn swap_remove(&mut self, row: usize, now: Tick) {
        self.truncate(self.len - 1, now);
        if row < self.len {
            self.mark(row, now);
        }
    }

    pub fn mark(&mut self, row: usize, now: Tick) {
        self.rows[row] = now.0;
        self.blocks[row / BLOCK] = now;
        self.last = now;
    }

    pub fn mark_all(&mut self, now: Tick) {
        self.all = now;
        self.last = now;
    }

    pub fn last(&self) -> Tick {
        self.last
    }

    pub fn is_after(&self, row: usize, since: Tick) -> bool {
        Tick(self.rows[row]).is_after(since) || self.all.is_after(since)
    }

    /// Rows of a range that were written after `since`, in ascending order.
    pub fn changed_in(&self, range: Range<usize>, since: Tick) -> impl Iterator<Item = usize> + '_ {
        let everything = self.all.is_after(since);
        let blocks = if self.last.is_after(since) {
            range.start / BLOCK..range.end.div_ceil(BLOCK)
        } else {
            0..0
        };
        blocks
            .filter(move |&block| everything || self.blocks[block].is_after(since))
            .flat_map(move |block| {
                let first = range.start.max(block * BLOCK);
                let end = range.end.min((block + 1) * BLOCK);
                (first..end).filter(move |&row| everything || Tick(self.rows[row]).is_after(since))
            })
    }

    /// The ticks of all rows, to be split among threads at whole blocks.
    pub fn marks(&mut self) -> Marks<'_> {
        Marks {
            rows: &mut self.rows[..self.len],
            blocks: &mut self.blocks,
        }
    }

    pub fn set_last(&mut self, now: Tick) {
        self.last = now;
    }

    pub fn shrink_to_fit(&mut self) {
        self.rows.truncate(self.len);
        self.rows.shrink_to_fit();
        self.blocks.shrink_to_fit();
    }

    pub fn capacity_bytes(&self) -> usize {
        (self.rows.capacity() + self.blocks.capacity()) * size_of::<Tick>()
    }
}

/// The ticks of a run of rows that starts and ends with whole blocks.
pub(crate) struct Marks<'a> {
    rows: &'a mut [u32],
    blocks: &'a mut [Tick],
}

impl Marks<'_> {
    #[inline]
    pub fn mark(&mut self, row: usize, now: Tick) {
        self.rows[row] = now.0;
        self.blocks[row / BLOCK] = now;
    }

    /// Splits at a row that is a multiple of `BLOCK`.
    pub fn split(self, row: usize) -> (Self, Self) {
        let (rows, rows_after) = self.rows.split_at_mut(row);
        let (blocks, blocks_after) = self.blocks.split_at_mut(row / BLOCK);
        let after = Marks {
            rows: rows_after,
            blocks: blocks_after,
        };
        (Marks { rows, blocks }, after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_exactly_the_marked_rows() {
        let mut ticks = ChangeTicks::default();
        for _ in 0..1000 {
            ticks.push(Tick(1));
        }
        ticks.mark(3, Tick(2));
        ticks.mark(999, Tick(3));
        let since = |tick| {
            ticks
                .changed_in(0..ticks.rows.len(), Tick(tick))
                .collect::<Vec<_>>()
        };
        assert_eq!(since(0).len(), 1000);
        assert_eq!(since(1), [3, 999]);
        assert_eq!(since(2), [999]);
        assert!(since(3).is_empty());
    }

    #[test]
    fn a_removal_marks_the_row_that_moved() {
        let mut ticks = ChangeTicks::default();
        for _ in 0..600 {
            ticks.push(Tick(1));
        }
        ticks.swap_remove(10, Tick(5));
        assert_eq!(ticks.changed_in(0..599, Tick(4)).collect::<Vec<_>>(), [10]);
        ticks.swap_remove(598, Tick(6));
        assert_eq!(ticks.changed_in(0..598, Tick(5)).count(), 0);
        assert_eq!(ticks.last(), Tick(6));
    }

    #[test]
    fn order_survives_the_wrap() {
        assert!(Tick(2).is_after(Tick(u32::MAX - 2)));
        assert!(!Tick(u32::MAX - 2).is_after(Tick(2)));
        assert_eq!(Tick(u32::MAX).next(), Tick(0));
    }
}
