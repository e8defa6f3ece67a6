//! How fast this machine's memory is, for one thread.

use std::hint::black_box;
use std::time::Instant;

/// Numbers in each array: 128 MiB, more than any common cache holds.
const LENGTH: usize = 32 << 20;

/// Measured speed of the memory for one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bandwidth {
    /// Bytes read in a second, when nothing is written.
    pub read: f64,
    /// Bytes read and written in a second, when one number is read and written
    /// for each one that is only read, as the integration job does.
    pub update: f64,
}

impl Bandwidth {
    /// Measures for about half a second.
    pub fn measure() -> Self {
        let input = vec![1.0_f32; LENGTH];
        let mut output = vec![1.0_f32; LENGTH];
        let bytes = (LENGTH * size_of::<f32>()) as f64;
        let read = best_of(5, || {
            // Sixteen sums, so that no addition waits for the one before.
            let mut sums = [0.0; 16];
            let (groups, _) = black_box(&input).as_chunks::<16>();
            for numbers in groups {
                for lane in 0..16 {
                    sums[lane] += numbers[lane];
                }
            }
            black_box(sums);
        });
        let update = best_of(5, || {
            for (output, input) in black_box(&mut output).iter_mut().zip(&input) {
                *output += input * 1e-3;
            }
        });
        Self {
            read: bytes / read,
            update: 3.0 * bytes / update,
        }
    }
}

/// Seconds of the fastest run.
fn best_of(runs: usize, mut work: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..runs {
        let start = Instant::now();
        work();
        best = best.min(start.elapsed().as_secs_f64());
    }
    best
}
