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

/// Rows that share one summary, so that a search skips what did not change.
pub(crate) const BLOCK: usize = 256;

/// How far back the rows of a block reach after its base was moved.
const REACH: u32 = 1 << 15;

/// What the rows of one block have in common.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// The tick from which the rows of the block count.
    base: u32,
    /// The latest tick of any of its rows.
    last: Tick,
}

/// The ticks of one set of columns.
///
/// A row holds 16 bits: how long after its block's base it was written. When a
/// block outgrows them, its base moves to 2¹⁵ ticks before the present one, and
/// rows that are older count as written there. Only an observer that has not
/// looked for longer than that is told of more rows than have changed.
#[derive(Clone, Debug)]
pub(crate) struct ChangeTicks {
    /// What follows the rows is room, and zero.
    rows: Vec<u16>,
    /// Number of rows.
    len: usize,
    blocks: Vec<Block>,
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
        self.extend(1, now);
    }

    /// Adds rows that are written now.
    pub fn extend(&mut self, count: usize, now: Tick) {
        let end = self.len + count;
        if end > self.rows.len() {
            self.rows.resize(end, 0);
        }
        // The rows of a block that has begun count from its base. In new blocks
        // they count from now, and zero is what stands in the room.
        let begun = end.min(self.len.next_multiple_of(BLOCK));
        for row in self.len..begun {
            mark(&mut self.rows, &mut self.blocks, row, now);
        }
        let fresh = Block {
            base: now.0,
            last: now,
        };
        self.blocks.resize(end.div_ceil(BLOCK), fresh);
        self.len = end;
        self.last = now;
    }

    /// Drops the rows from `len` on.
    pub fn truncate(&mut self, len: usize, now: Tick) {
        self.rows[len..self.len].fill(0);
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

    #[inline]
    pub fn mark(&mut self, row: usize, now: Tick) {
        mark(&mut self.rows, &mut self.blocks, row, now);
        self.last = now;
    }

    pub fn mark_all(&mut self, now: Tick) {
        self.all = now;
        self.last = now;
    }

    /// Whether all rows were marked together after `since`.
    pub fn all_after(&self, since: Tick) -> bool {
        self.all.is_after(since)
    }

    pub fn last(&self) -> Tick {
        self.last
    }

    #[inline]
    pub fn is_after(&self, row: usize, since: Tick) -> bool {
        // The same for all rows, so that a loop asks once.
        self.all.is_after(since) || {
            let base = self.blocks[row / BLOCK].base;
            Tick(base.wrapping_add(u32::from(self.rows[row]))).is_after(since)
        }
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
            .filter(move |&block| everything || self.blocks[block].last.is_after(since))
            .flat_map(move |block| {
                let first = range.start.max(block * BLOCK);
                let end = range.end.min((block + 1) * BLOCK);
                let base = self.blocks[block].base;
                let tick = move |row: usize| base.wrapping_add(u32::from(self.rows[row]));
                (first..end).filter(move |&row| everything || Tick(tick(row)).is_after(since))
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
        self.rows.capacity() * size_of::<u16>() + self.blocks.capacity() * size_of::<Block>()
    }
}

#[inline]
fn mark(rows: &mut [u16], blocks: &mut [Block], row: usize, now: Tick) {
    let block = &mut blocks[row / BLOCK];
    if block.last != now {
        block.last = now;
        if now.0.wrapping_sub(block.base) > u32::from(u16::MAX) {
            let first = row / BLOCK * BLOCK;
            let end = rows.len().min(first + BLOCK);
            move_base(block, &mut rows[first..end], now);
        }
    }
    rows[row] = now.0.wrapping_sub(block.base) as u16;
}

/// Moves the base of a block towards the present.
#[cold]
fn move_base(block: &mut Block, rows: &mut [u16], now: Tick) {
    let base = now.0.wrapping_sub(REACH);
    let moved = base.wrapping_sub(block.base);
    let moved = u16::try_from(moved).unwrap_or(u16::MAX);
    for row in rows {
        *row = row.saturating_sub(moved);
    }
    block.base = base;
}

/// The ticks of a run of rows that starts and ends with whole blocks.
pub(crate) struct Marks<'a> {
    rows: &'a mut [u16],
    blocks: &'a mut [Block],
}

impl Marks<'_> {
    #[inline]
    pub fn mark(&mut self, row: usize, now: Tick) {
        mark(self.rows, self.blocks, row, now);
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

    /// Against full ticks, for observers that looked within the reach: exactly the same rows. For
    /// older ones: at least those.
    #[test]
    fn sixteen_bits_are_enough() {
        let start = u32::MAX - 100_000;
        let mut ticks = ChangeTicks::default();
        let mut full = vec![start; 700];
        ticks.extend(700, Tick(start));
        ticks.mark_all(Tick(start));
        let mut now = start;
        let mut random = 1_u64;
        for step in 0..4000 {
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            now = now.wrapping_add((random >> 60) as u32 * 25);
            let row = (random >> 33) as usize % full.len();
            match step % 40 {
                0 => {
                    ticks.swap_remove(row, Tick(now));
                    full.swap_remove(row);
                    if row < full.len() {
                        full[row] = now;
                    }
                }
                1 => {
                    ticks.extend(3, Tick(now));
                    full.extend([now; 3]);
                }
                _ => {
                    ticks.mark(row, Tick(now));
                    full[row] = now;
                }
            }
            for back in [0, 1, 100, REACH - 1, REACH * 3] {
                let since = Tick(now.wrapping_sub(back));
                let told: Vec<_> = ticks.changed_in(0..full.len(), since).collect();
                let changed = |row: &usize| Tick(full[*row]).is_after(since);
                let mut expected = (0..full.len()).filter(changed);
                if back < REACH {
                    assert!(told.iter().copied().eq(expected), "{back} at {step}");
                } else {
                    assert!(expected.all(|row| told.binary_search(&row).is_ok()));
                }
            }
        }
    }

    #[test]
    fn order_survives_the_wrap() {
        assert!(Tick(2).is_after(Tick(u32::MAX - 2)));
        assert!(!Tick(u32::MAX - 2).is_after(Tick(2)));
        assert_eq!(Tick(u32::MAX).next(), Tick(0));
    }
}
