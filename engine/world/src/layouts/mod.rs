//! The lesson inside: two jobs on three layouts of the same data.
//!
//! The jobs are culling (which spheres does a view show?) and integration (where is
//! everything after a step?). The layouts are the columns of a [`World`], an array
//! of structures, and boxed objects behind a trait, each written as one usually
//! writes it. All three give the same answers. They differ in what they make the
//! memory do: an object of 200 bytes brings 200 bytes near the processor, of which
//! culling needs 16.
//!
//! [`measure`] runs them and says, for each, how long it took, how much memory it
//! moved, which share of the machine's bandwidth that is, and what held it back.

mod bandwidth;
mod objects;
mod report;

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::culling::{Frustum, cull_spheres};
use crate::query::Join;
use crate::{Transform, Velocity, World, WorldBounds};

pub use bandwidth::Bandwidth;
pub use objects::{Object, SceneObject, boxed, cull_boxed, cull_objects, objects, world};
pub use report::{Job, Layout, LayoutReport, LayoutResult, Limit};

/// Length of a step in the integration job, in seconds.
pub const STEP: f32 = 1.0 / 60.0;

/// Objects of which all layouts fit into a cache.
const FEW: usize = 1_000;

/// Moves everything in a world whose entities have a Transform and a Velocity.
pub fn integrate_world(world: &mut World, moving: &mut Join<(Transform, Velocity), 2>) {
    moving.update(world);
    world.write::<(Transform,), _>(|world, (places,)| {
        let places = places.slices_mut().translation;
        let speeds = world.columns::<Velocity>().linear();
        for run in moving.runs() {
            for (place, speed) in places[run.rows(0)].iter_mut().zip(&speeds[run.rows(1)]) {
                *place += *speed * STEP;
            }
        }
    });
}

/// Measures both jobs on all layouts, with so many objects. Takes some seconds
/// with a million.
pub fn measure(count: usize) -> LayoutReport {
    let bandwidth = Bandwidth::measure();
    let many = times(count);
    let few = times(FEW.min(count));
    let results = many.into_iter().zip(few).map(|(many, few)| {
        let (job, layout, time) = many;
        LayoutResult::new(job, layout, count, time, few.2, &bandwidth)
    });
    LayoutReport {
        objects: count,
        visible: visible(count),
        bandwidth,
        instructions: crate::culling::instruction_set(),
        results: results.collect(),
    }
}

fn visible(count: usize) -> usize {
    let mut visible = Vec::new();
    cull_objects(&objects::view(), &objects(count), &mut visible);
    visible.len()
}

/// The best time for one object of each job and layout, in nanoseconds.
fn times(count: usize) -> Vec<(Job, Layout, f64)> {
    let frustum = objects::view();
    let mut visible = Vec::with_capacity(count);
    let mut times = Vec::new();
    let mut enter = |job, layout, work: &mut dyn FnMut()| {
        times.push((job, layout, best(count, work)));
    };

    let mut columns = world(count);
    let mut moving = Join::default();
    enter(Job::Cull, Layout::Columns, &mut || {
        cull(&frustum, &columns, &mut visible);
    });
    enter(Job::Integrate, Layout::Columns, &mut || {
        integrate_world(&mut columns, &mut moving);
    });
    drop(columns);

    let mut structures = objects(count);
    enter(Job::Cull, Layout::Structures, &mut || {
        cull_objects(&frustum, &structures, &mut visible);
    });
    enter(Job::Integrate, Layout::Structures, &mut || {
        structures.iter_mut().for_each(|object| object.step(STEP));
    });

    let mut boxes = boxed(&structures);
    drop(structures);
    enter(Job::Cull, Layout::Boxes, &mut || {
        cull_boxed(&frustum, &boxes, &mut visible);
    });
    enter(Job::Integrate, Layout::Boxes, &mut || {
        boxes.iter_mut().for_each(|(_, object)| object.step(STEP));
    });
    times.sort_by_key(|&(job, ..)| job);
    times
}

/// Fills `visible` with the rows of a world's bounds that a view shows.
pub fn cull(frustum: &Frustum, world: &World, visible: &mut Vec<u32>) {
    cull_spheres(frustum, world.columns::<WorldBounds>().spheres(), visible);
}

/// The best time of some runs for one of `count` objects, in nanoseconds.
fn best(count: usize, work: &mut dyn FnMut()) -> f64 {
    let started = Instant::now();
    let mut best = Duration::MAX;
    let mut runs = 0;
    while runs < 3 || started.elapsed() < Duration::from_millis(200) {
        let start = Instant::now();
        work();
        black_box(());
        best = best.min(start.elapsed());
        runs += 1;
    }
    best.as_secs_f64() * 1e9 / count.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of objects in the thesis and in Frostbite, and odd ones.
    #[test]
    fn all_layouts_give_the_same_answers() {
        for count in [0, 1, 6_708, 15_000] {
            let frustum = objects::view();
            let mut structures = objects(count);
            let mut boxes = boxed(&structures);
            let mut columns = world(count);
            let [mut a, mut b, mut c] = [Vec::new(), Vec::new(), Vec::new()];
            cull_objects(&frustum, &structures, &mut a);
            cull_boxed(&frustum, &boxes, &mut b);
            cull(&frustum, &columns, &mut c);
            b.sort();
            assert_eq!(a, b);
            assert_eq!(a, c);
            assert!(count < 10 || (count / 50..count / 2).contains(&a.len()));

            structures.iter_mut().for_each(|object| object.step(STEP));
            boxes.iter_mut().for_each(|(_, object)| object.step(STEP));
            integrate_world(&mut columns, &mut Join::default());
            let places = columns.columns::<Transform>().translation();
            for (row, object) in boxes {
                assert_eq!(object.translation(), structures[row as usize].translation());
                assert_eq!(object.translation(), places[row as usize]);
            }
        }
    }

    #[test]
    fn the_report_holds_every_job_and_layout() {
        let report = measure(5_000);
        assert_eq!(report.results.len(), 6);
        let text = report.to_string();
        for words in ["culling", "integration", "columns", "boxed objects", "GB/s"] {
            assert!(text.contains(words), "{text}");
        }
        for result in &report.results {
            assert!(result.nanoseconds > 0.0 && result.share > 0.0);
            assert!(result.bytes_moved >= result.bytes_needed);
        }
    }
}
