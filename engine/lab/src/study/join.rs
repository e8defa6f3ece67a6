//! From what the processes left on disk to one study.

use lightbench_assets::Digest;
use lightbench_assets::files::Files;

use super::model::{Plan, Point, Study};
use super::points::{PlanError, Planned};
use super::store::{Part, Store};
use crate::LabError;
use crate::report::{Comparison, PassResult, PipelineResult, SCHEMA};

/// Why parts can't be joined.
#[derive(Debug, thiserror::Error)]
pub enum JoinError {
    /// The plan makes no sense.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A file can't be read.
    #[error(transparent)]
    Lab(#[from] LabError),
    /// Processes of one point measured on different machines or drivers.
    #[error(
        "the processes of the point {key} ran on different machines or drivers ({first}; {other}): \
         no ratio may be formed across them; measure the point again on one"
    )]
    Machines {
        /// The point.
        key: String,
        /// Where the first ran.
        first: String,
        /// Where another ran.
        other: String,
    },
}

/// Joins what is there. A point appears when its first process, which takes the pictures, is done.
///
/// # Errors
/// Parts that can't be read, or whose processes ran on different machines.
pub fn join(store: &Store, plan: &Plan, points: &[Planned]) -> Result<Study, JoinError> {
    let mut study = Study {
        schema: SCHEMA,
        plan: plan.clone(),
        points: Vec::new(),
        missing: Vec::new(),
    };
    for planned in points {
        let mut parts = Vec::new();
        for process in 0..plan.processes {
            parts.extend(store.read(planned, process)?);
        }
        if parts.len() < plan.processes as usize {
            study.missing.push(planned.key.clone());
        }
        if let Some(first) = parts.first_mut().filter(|part| part.process == 0) {
            store.load_pictures(planned, first)?;
            let comparison = join_parts(parts)?;
            study.points.push(Point {
                key: planned.key.clone(),
                coordinates: planned.coordinates.clone(),
                comparison,
            });
        }
    }
    Ok(study)
}

fn join_parts(parts: Vec<Part>) -> Result<Comparison, JoinError> {
    let mut parts = parts.into_iter();
    let Some(first) = parts.next() else {
        return Err(PlanError("a study needs a process at least".to_owned()).into());
    };
    let key = first.key;
    let mut joined = first.comparison;
    for part in parts {
        let other = part.comparison;
        if (&other.machine, &other.adapter) != (&joined.machine, &joined.adapter) {
            let words = |c: &Comparison| format!("{} with {}", c.machine.cpu, c.adapter.name);
            return Err(JoinError::Machines {
                key,
                first: words(&joined),
                other: words(&other),
            });
        }
        joined.processes.extend(other.processes);
        joined.created = joined.created.max(other.created);
        for mut theirs in other.pipelines {
            let ours = joined.pipelines.iter_mut().find(|p| p.name == theirs.name);
            if let Some(ours) = ours {
                append(ours, &mut theirs);
            }
        }
    }
    Ok(joined)
}

/// Adds the frames of another process.
fn append(ours: &mut PipelineResult, theirs: &mut PipelineResult) {
    ours.frame_cpu_ms.append(&mut theirs.frame_cpu_ms);
    append_optional(&mut ours.frame_gpu_ms, &mut theirs.frame_gpu_ms);
    ours.process_frames.append(&mut theirs.process_frames);
    ours.settled_after.append(&mut theirs.settled_after);
    ours.process_seconds.append(&mut theirs.process_seconds);
    ours.frame_wall_ms.append(&mut theirs.frame_wall_ms);
    ours.unqueried_wall_ms.append(&mut theirs.unqueried_wall_ms);
    ours.cut |= theirs.cut;
    for theirs in &mut theirs.systems {
        if let Some(ours) = ours.systems.iter_mut().find(|s| s.name == theirs.name) {
            ours.thread_ms.append(&mut theirs.thread_ms);
        }
    }
    let pass = |ours: &mut PassResult, theirs: &mut PassResult| {
        ours.cpu_ms.append(&mut theirs.cpu_ms);
        append_optional(&mut ours.gpu_ms, &mut theirs.gpu_ms);
    };
    for theirs in &mut theirs.passes {
        if let Some(ours) = ours.passes.iter_mut().find(|p| p.name == theirs.name) {
            pass(ours, theirs);
        }
    }
    for note in theirs.notes.drain(..) {
        if !ours.notes.contains(&note) {
            ours.notes.push(note);
        }
    }
}

fn append_optional(ours: &mut Option<Vec<f64>>, theirs: &mut Option<Vec<f64>>) {
    match (ours.as_mut(), theirs) {
        (Some(ours), Some(theirs)) => ours.append(theirs),
        // Without the times of one process there are none of the point.
        _ => *ours = None,
    }
}

/// Removes what was measured with files that have changed since, and names these.
///
/// # Errors
/// Parts that can't be read or removed.
pub fn drop_stale(
    store: &Store,
    plan: &Plan,
    points: &[Planned],
    files: &Files,
) -> Result<Vec<String>, LabError> {
    let mut named: Vec<String> = Vec::new();
    for point in points {
        for process in 0..plan.processes {
            let Some(part) = store.read(point, process)? else {
                continue;
            };
            let changed = stale(&part, files);
            if changed.is_empty() {
                continue;
            }
            store.remove(point, process)?;
            for path in changed {
                if !named.contains(&path) {
                    named.push(path);
                }
            }
        }
    }
    Ok(named)
}

/// The files that have changed since a part was measured, as its report names them.
fn stale(part: &Part, files: &Files) -> Vec<String> {
    let inputs = part.comparison.inputs.iter();
    inputs
        .filter(|input| {
            let now = files.read(&input.path).ok();
            let now = now.or_else(|| std::fs::read(&input.path).ok());
            now.is_none_or(|bytes| Digest::of(&bytes).to_string() != input.hash)
        })
        .map(|input| input.path.clone())
        .collect()
}
