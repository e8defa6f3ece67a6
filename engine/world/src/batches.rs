//! Work on columns in batches, one thread a batch.

use crate::ticks::{BLOCK, Marks, Tick};

/// Rows that one thread works on before it takes more. Large enough to hide what
/// handing out work costs (some microseconds), small enough to balance.
pub(crate) const BATCH: usize = 64 * BLOCK;

/// A slice for every field, of which the threads get disjoint parts.
pub trait SliceSet: Send + Sized {
    /// Splits all slices before a row.
    fn split(self, row: usize) -> (Self, Self);
}

/// Reports the rows of one batch as changed.
pub struct BatchMarker<'a> {
    marks: Marks<'a>,
    now: Tick,
    any: bool,
}

impl BatchMarker<'_> {
    /// Marks one row, counted from the first of the batch.
    #[inline]
    pub fn mark(&mut self, row: usize) {
        self.marks.mark(row, self.now);
        self.any = true;
    }
}

/// A run of rows on its way to a thread.
pub(crate) struct Batch<'a> {
    first: usize,
    len: usize,
    marks: Marks<'a>,
    now: Tick,
}

impl<'a> Batch<'a> {
    pub fn new(len: usize, marks: Marks<'a>, now: Tick) -> Self {
        Self {
            first: 0,
            len,
            marks,
            now,
        }
    }
}

/// Halves the rows until they fit a batch and runs the halves in parallel. True
/// if any row was marked.
pub(crate) fn run_batches<S: SliceSet>(
    batch: Batch<'_>,
    slices: S,
    work: &(impl Fn(usize, S, &mut BatchMarker<'_>) + Sync),
) -> bool {
    let Batch {
        first,
        len,
        marks,
        now,
    } = batch;
    if len <= BATCH {
        let mut marker = BatchMarker {
            marks,
            now,
            any: false,
        };
        work(first, slices, &mut marker);
        return marker.any;
    }
    let half = (len / 2).next_multiple_of(BATCH);
    let (slices, slices_after) = slices.split(half);
    let (marks, marks_after) = marks.split(half);
    let before = Batch {
        first,
        len: half,
        marks,
        now,
    };
    let after = Batch {
        first: first + half,
        len: len - half,
        marks: marks_after,
        now,
    };
    let (a, b) = rayon::join(
        || run_batches(before, slices, work),
        || run_batches(after, slices_after, work),
    );
    a | b
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use crate::{Transform, World};
    use glam::Vec3;

    #[test]
    fn batches_cover_every_row_once_and_mark_what_they_say() {
        for count in [0, 1, 255, super::BATCH, super::BATCH + 1, 100_000] {
            let mut world = World::new();
            for _ in 0..count {
                let entity = world.spawn();
                world.insert(entity, Transform::default()).unwrap();
            }
            let seen = world.observe();
            world
                .columns_mut::<Transform>()
                .par_batches(|first, slices, marker| {
                    for (i, translation) in slices.translation.iter_mut().enumerate() {
                        translation.x += (first + i) as f32;
                        if (first + i) % 1000 == 7 {
                            marker.mark(i);
                        }
                    }
                });
            let columns = world.columns::<Transform>();
            for (row, translation) in columns.translation().iter().enumerate() {
                assert_eq!(*translation, Vec3::new(row as f32, 0.0, 0.0));
            }
            let marked: Vec<_> = columns.changed_since(seen).collect();
            let expected: Vec<_> = (7..count).step_by(1000).collect();
            assert_eq!(marked, expected);
        }
    }
}
