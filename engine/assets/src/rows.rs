//! Work over the rows of a picture.

use rayon::prelude::*;

/// Below this many elements waking the other threads costs more than it saves.
const MIN_PARALLEL: usize = 1 << 14;

/// Calls `work` with the number and the content of each row, in parallel where
/// it pays.
pub(crate) fn for_each_row<T: Send>(
    buffer: &mut [T],
    row_length: usize,
    work: impl Fn(usize, &mut [T]) + Sync,
) {
    if buffer.len() < MIN_PARALLEL {
        for (y, row) in buffer.chunks_mut(row_length).enumerate() {
            work(y, row);
        }
    } else {
        let rows = buffer.par_chunks_mut(row_length).enumerate();
        rows.for_each(|(y, row)| work(y, row));
    }
}
