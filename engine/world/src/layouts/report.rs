//! What was measured, and what it means.

use std::fmt;

use super::Bandwidth;
use crate::culling::InstructionSet;

/// Bytes that the memory delivers at once.
const LINE: usize = 64;

/// Where culling finds the sphere in an object, and how long that is.
const SPHERE: (usize, usize) = (136, 16);
/// Where integration finds the translation and the velocity in an object.
const TRANSLATION: (usize, usize) = (32, 12);
const VELOCITY: (usize, usize) = (164, 12);

/// A job that is done for every object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Job {
    /// Which spheres does a view show?
    Cull,
    /// Where is everything after a step?
    Integrate,
}

/// How the same data lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One array for each field, as in a world.
    Columns,
    /// One array of objects of 200 bytes.
    Structures,
    /// A list of pointers to such objects, whose type the job does not know.
    Boxes,
}

/// What holds a job back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The memory delivers as fast as it can.
    Bandwidth,
    /// The processor is busy: the job takes as long when everything is in the
    /// cache.
    Computation,
    /// The processor waits: the memory could deliver more, but it is not known
    /// early enough what will be needed.
    Latency,
}

/// One job on one layout.
#[derive(Clone, Debug, PartialEq)]
pub struct LayoutResult {
    /// The job.
    pub job: Job,
    /// The layout.
    pub layout: Layout,
    /// Time for one object among many.
    pub nanoseconds: f64,
    /// Time for one object among so few that they stay in the cache.
    pub nanoseconds_cached: f64,
    /// Bytes of an object that the job reads and writes.
    pub bytes_needed: f64,
    /// Bytes that the memory moves for that, in whole lines of 64.
    pub bytes_moved: f64,
    /// Moved bytes in a second as a share of the machine's bandwidth. Above 1
    /// where a large cache helps.
    pub share: f64,
    /// What holds the job back.
    pub limit: Limit,
}

impl LayoutResult {
    pub(super) fn new(
        job: Job,
        layout: Layout,
        count: usize,
        nanoseconds: f64,
        nanoseconds_cached: f64,
        bandwidth: &Bandwidth,
    ) -> Self {
        let bytes_needed = match job {
            Job::Cull => 16.0,
            Job::Integrate => 36.0,
        };
        let bytes_moved = match (job, layout) {
            (_, Layout::Columns) => bytes_needed,
            (Job::Cull, Layout::Structures) => lines(count, &[SPHERE]),
            // Lines that are written go back to the memory, too.
            (Job::Integrate, Layout::Structures) => {
                lines(count, &[TRANSLATION, VELOCITY]) + lines(count, &[TRANSLATION])
            }
            // The pointers and the number; the objects start anywhere.
            (Job::Cull, Layout::Boxes) => 24.0 + lines(count, &[SPHERE]),
            (Job::Integrate, Layout::Boxes) => {
                24.0 + lines(count, &[TRANSLATION, VELOCITY]) + lines(count, &[TRANSLATION])
            }
        };
        let most = match job {
            Job::Cull => bandwidth.read,
            Job::Integrate => bandwidth.update,
        };
        let share = bytes_moved / (nanoseconds * 1e-9) / most;
        let limit = if nanoseconds_cached >= 0.8 * nanoseconds {
            Limit::Computation
        } else if share >= 0.6 {
            Limit::Bandwidth
        } else {
            Limit::Latency
        };
        Self {
            job,
            layout,
            nanoseconds,
            nanoseconds_cached,
            bytes_needed,
            bytes_moved,
            share,
            limit,
        }
    }
}

/// Bytes for one object in whole lines, where objects of 200 bytes follow each
/// other and parts of them (offset, length) are touched. No line counts twice.
fn lines(count: usize, parts: &[(usize, usize)]) -> f64 {
    let mut touched = 0;
    let mut next_new = 0;
    for object in 0..count {
        for &(offset, length) in parts {
            let first = (object * 200 + offset) / LINE;
            let last = (object * 200 + offset + length - 1) / LINE;
            let from = first.max(next_new);
            if last >= from {
                touched += last - from + 1;
                next_new = last + 1;
            }
        }
    }
    (touched * LINE) as f64 / count.max(1) as f64
}

/// All jobs on all layouts.
#[derive(Clone, Debug, PartialEq)]
pub struct LayoutReport {
    /// Number of objects.
    pub objects: usize,
    /// Number of objects that the view of the culling job shows.
    pub visible: usize,
    /// The machine's memory.
    pub bandwidth: Bandwidth,
    /// The vector instructions that culling used.
    pub instructions: InstructionSet,
    /// The measurements, by job.
    pub results: Vec<LayoutResult>,
}

impl fmt::Display for Job {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Job::Cull => "culling",
            Job::Integrate => "integration",
        })
    }
}

impl fmt::Display for Layout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Layout::Columns => "columns",
            Layout::Structures => "array of structures",
            Layout::Boxes => "boxed objects",
        })
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Limit::Bandwidth => "memory bandwidth",
            Limit::Computation => "computation: as slow from the cache",
            Limit::Latency => "memory latency: waits for what it needs",
        })
    }
}

impl fmt::Display for LayoutReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} objects, {} of them visible; one thread; culling uses {} instructions",
            self.objects, self.visible, self.instructions
        )?;
        writeln!(
            f,
            "memory: {:.1} GB/s read only, {:.1} GB/s read and written",
            self.bandwidth.read / 1e9,
            self.bandwidth.update / 1e9
        )?;
        writeln!(
            f,
            "\n{:<12} {:<20} {:>9} {:>10} {:>10} {:>11} {:>11} {:>8}  limited by",
            "job", "layout", "ms", "ns/object", "in cache", "bytes used", "bytes moved", "of limit"
        )?;
        for result in &self.results {
            writeln!(
                f,
                "{:<12} {:<20} {:>9.3} {:>10.2} {:>10.2} {:>11.0} {:>11.1} {:>7.0}%  {}",
                result.job,
                result.layout,
                result.nanoseconds * self.objects as f64 * 1e-6,
                result.nanoseconds,
                result.nanoseconds_cached,
                result.bytes_needed,
                result.bytes_moved,
                100.0 * result.share,
                result.limit
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_counted_once() {
        // 200 bytes are 3.125 lines: all of them are touched in the end.
        assert_eq!(lines(8, &[(0, 200)]), 200.0);
        // Sixteen bytes at 136 lie in one line, and across two at every fourth.
        assert_eq!(lines(1, &[SPHERE]), 64.0);
        assert!(lines(1000, &[SPHERE]) < 84.0);
        // The velocity of one object and the translation of the next share none.
        assert_eq!(lines(1, &[TRANSLATION, VELOCITY]), 128.0);
    }
}
