//! A schedule: systems that say what they read and write, run in parallel where
//! that allows it.
//!
//! A system's declaration is its type: it gets shared references to the columns
//! that it reads and exclusive ones to those that it writes, and nothing else, so
//! it cannot touch what it did not declare. Systems that do not conflict share a
//! stage and run at the same time. Systems that conflict run in the order in which
//! they were added. The result is the same as that of running all of them one
//! after the other, whatever the number of threads.

use std::time::Duration;

use cpu_time::ThreadTime;
use rayon::prelude::*;

use crate::access::{ReadSet, WriteSet};
use crate::commands::Commands;
use crate::ticks::Tick;
use crate::world::World;

/// What a system gets beside its columns.
pub struct Context<'a> {
    /// Seconds since the scene started, at the end of this step.
    pub time: f64,
    /// Length of this step in seconds.
    pub step: f32,
    /// Rows written after this tick were written after the system's last run
    /// began; its own writes are among them.
    pub since: Tick,
    /// Changes that are carried out when the stage is over, in the order of the
    /// systems.
    pub commands: &'a mut Commands,
}

/// How long a system took when it last ran.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SystemTime {
    /// The system's name.
    pub name: &'static str,
    /// The stage in which it runs; systems of one stage run at the same time.
    pub stage: usize,
    /// CPU time of the thread that ran it. Work that it handed to other threads is not in it.
    pub thread: Duration,
}

impl SystemTime {
    /// The thread's time in milliseconds.
    pub fn thread_ms(&self) -> f64 {
        self.thread.as_secs_f64() * 1e3
    }

    /// Runs a function as a system of one's own, and says how long it took.
    pub fn of<T>(name: &'static str, function: impl FnOnce() -> T) -> (Self, T) {
        let start = ThreadTime::now();
        let result = function();
        let time = Self {
            name,
            stage: 0,
            thread: start.elapsed(),
        };
        (time, result)
    }
}

/// A system whose columns have been taken out of the world, or that has the whole
/// world for itself.
trait Runnable: Send {
    /// Takes the columns to write out of the world.
    fn take(&mut self, world: &mut World);
    /// Runs with the other columns shared.
    fn run(&mut self, world: &World, context: Context<'_>);
    /// Puts the columns back.
    fn put(&mut self, world: &mut World);
}

struct System<R, W: WriteSet, F> {
    columns: Option<W::Columns>,
    function: F,
    reads: std::marker::PhantomData<fn(R)>,
}

impl<R, W, F> Runnable for System<R, W, F>
where
    R: ReadSet,
    W: WriteSet,
    F: FnMut(R::Columns<'_>, &mut W::Columns, Context<'_>) + Send,
{
    fn take(&mut self, world: &mut World) {
        self.columns = Some(W::take(world));
    }
    fn run(&mut self, world: &World, context: Context<'_>) {
        if let Some(columns) = &mut self.columns {
            (self.function)(R::columns(world), columns, context);
        }
    }
    fn put(&mut self, world: &mut World) {
        if let Some(columns) = self.columns.take() {
            W::put(columns, world);
        }
    }
}

enum Body {
    Shared(Box<dyn Runnable>),
    Exclusive(Box<dyn FnMut(&mut World) + Send>),
}

struct Entry {
    name: &'static str,
    reads: u32,
    writes: u32,
    stage: usize,
    since: Tick,
    commands: Commands,
    thread: Duration,
    body: Body,
}

/// Systems in the order in which they were added.
///
/// ```
/// # use lightbench_world::{Schedule, Transform, Velocity, World};
/// # let mut world = World::new();
/// # world.spawn_batch([(Transform::default(), Velocity::default())]);
/// let mut schedule = Schedule::default();
/// schedule.add::<(Velocity,), (Transform,)>("fall", |(_speeds,), (places,), context| {
///     for place in places.slices_mut().translation {
///         place.y -= context.step;
///     }
/// });
/// schedule.run(&mut world, 1.0 / 60.0);
/// for system in schedule.times() {
///     println!("{}: {:?}", system.name, system.thread);
/// }
/// ```
#[derive(Default)]
pub struct Schedule {
    systems: Vec<Entry>,
    stages: usize,
    time: f64,
}

impl Schedule {
    /// Adds a system that reads the components of `R` and writes those of `W`,
    /// both tuples. A component that is written may also be read there; it must
    /// not stand in `R`.
    pub fn add<R, W>(
        &mut self,
        name: &'static str,
        function: impl FnMut(R::Columns<'_>, &mut W::Columns, Context<'_>) + Send + 'static,
    ) where
        R: ReadSet,
        W: WriteSet,
    {
        const {
            assert!(
                R::BITS & W::BITS == 0,
                "a component is both read and written"
            );
        }
        let body = Body::Shared(Box::new(System::<R, W, _> {
            columns: None,
            function,
            reads: std::marker::PhantomData,
        }));
        self.push(name, R::BITS, W::BITS, body);
    }

    /// Adds a system that needs the whole world. It runs alone.
    pub fn add_exclusive(
        &mut self,
        name: &'static str,
        function: impl FnMut(&mut World) + Send + 'static,
    ) {
        self.push(
            name,
            u32::MAX,
            u32::MAX,
            Body::Exclusive(Box::new(function)),
        );
    }

    fn push(&mut self, name: &'static str, reads: u32, writes: u32, body: Body) {
        // The first stage after those of all systems that conflict.
        let conflicts = self.systems.iter().filter(|earlier| {
            earlier.writes & (reads | writes) != 0 || earlier.reads & writes != 0
        });
        let stage = conflicts
            .map(|earlier| earlier.stage + 1)
            .max()
            .unwrap_or(0);
        self.stages = self.stages.max(stage + 1);
        self.systems.push(Entry {
            name,
            reads,
            writes,
            stage,
            since: Tick::START,
            commands: Commands::default(),
            thread: Duration::ZERO,
            body,
        });
    }

    /// Runs every system once. `step` is the time that passes, in seconds.
    pub fn run(&mut self, world: &mut World, step: f32) {
        self.run_at(world, self.time + f64::from(step), step);
    }

    /// Like [`Schedule::run`], for a step that ends at a time in seconds.
    pub fn run_at(&mut self, world: &mut World, time: f64, step: f32) {
        self.time = time;
        for stage in 0..self.stages {
            self.run_stage(world, stage, step);
        }
    }

    fn run_stage(&mut self, world: &mut World, stage: usize, step: f32) {
        let time = self.time;
        let in_stage = |entry: &Entry| entry.stage == stage;
        let closed = world.observe();
        for entry in self.systems.iter_mut().filter(|entry| in_stage(entry)) {
            match &mut entry.body {
                Body::Shared(system) => system.take(world),
                Body::Exclusive(function) => {
                    let start = ThreadTime::now();
                    function(world);
                    entry.thread = start.elapsed();
                }
            }
        }
        let shared: &World = world;
        let run = |entry: &mut Entry| {
            if entry.stage == stage
                && let Body::Shared(system) = &mut entry.body
            {
                let start = ThreadTime::now();
                let context = Context {
                    time,
                    step,
                    since: entry.since,
                    commands: &mut entry.commands,
                };
                system.run(shared, context);
                entry.thread = start.elapsed();
                entry.since = closed;
            }
        };
        // One system alone has nothing to gain from being handed to another thread.
        if self.systems.iter().filter(|entry| in_stage(entry)).count() > 1 {
            self.systems.par_iter_mut().for_each(run);
        } else {
            self.systems.iter_mut().for_each(run);
        }
        for entry in self.systems.iter_mut().filter(|entry| in_stage(entry)) {
            if let Body::Shared(system) = &mut entry.body {
                system.put(world);
            }
        }
        for entry in self.systems.iter_mut().filter(|entry| in_stage(entry)) {
            entry.commands.apply(world);
        }
    }

    /// How long each system took when it last ran, in the order of addition.
    pub fn times(&self) -> impl Iterator<Item = SystemTime> + '_ {
        self.systems.iter().map(|entry| SystemTime {
            name: entry.name,
            stage: entry.stage,
            thread: entry.thread,
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Camera, Light, Transform, Velocity};
    use glam::Vec3;

    fn sample() -> World {
        let mut world = World::new();
        world.spawn_batch((0..5000).map(|i| {
            let place = Transform::from_translation(Vec3::splat(i as f32));
            let speed = Velocity {
                linear: Vec3::new(1.0, i as f32 * 0.01, 0.0),
                ..Velocity::default()
            };
            (place, speed, Light::default())
        }));
        world
    }

    /// Chained on purpose: each system's result depends on the ones before.
    fn chain() -> Schedule {
        let mut schedule = Schedule::default();
        schedule.add::<(Velocity,), (Transform,)>("move", |(speeds,), (places,), context| {
            let places = places.slices_mut().translation.iter_mut();
            for (place, speed) in places.zip(speeds.linear()) {
                *place += *speed * context.step;
            }
        });
        schedule.add::<(Velocity,), (Light,)>("flicker", |(speeds,), (lights,), context| {
            let lights = lights.slices_mut().intensity.iter_mut();
            for (light, speed) in lights.zip(speeds.linear()) {
                *light = *light * 0.9 + speed.y + context.time as f32;
            }
        });
        schedule.add::<(Light, Transform), (Velocity,)>(
            "steer",
            |(lights, places), (speeds,), context| {
                let speeds = speeds.slices_mut().linear.iter_mut();
                let inputs = lights.intensity().iter().zip(places.translation());
                for (speed, (light, place)) in speeds.zip(inputs) {
                    *speed += Vec3::new(light.sin(), place.x.cos(), 0.0);
                }
                for &entity in lights.entities().iter().take(3) {
                    context.commands.despawn(entity);
                    let new = context.commands.spawn();
                    context.commands.insert(new, Camera::default());
                }
            },
        );
        schedule
    }

    fn run(threads: usize) -> World {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let (mut world, mut schedule) = (sample(), chain());
        pool.install(|| (0..10).for_each(|_| schedule.run(&mut world, 0.1)));
        world
    }

    #[test]
    fn the_result_does_not_depend_on_threads() {
        let expected = run(1);
        assert_eq!(expected.columns::<Camera>().len(), 30);
        assert_eq!(expected.columns::<Light>().len(), 4970);
        for threads in [2, 5] {
            let world = run(threads);
            assert!(world.entities().eq(expected.entities()));
            for entity in expected.entities() {
                assert_eq!(
                    world.get::<Transform>(entity),
                    expected.get::<Transform>(entity)
                );
                assert_eq!(
                    world.get::<Velocity>(entity),
                    expected.get::<Velocity>(entity)
                );
                assert_eq!(world.get::<Light>(entity), expected.get::<Light>(entity));
            }
        }
    }

    #[test]
    fn stages_follow_from_the_declarations() {
        let mut schedule = chain();
        schedule.add::<(), (Camera,)>("look", |(), _, _| {});
        schedule.add_exclusive("all", |_| {});
        schedule.add::<(Camera,), ()>("watch", |_, (), _| {});
        let stages: Vec<_> = schedule.times().map(|s| (s.name, s.stage)).collect();
        assert_eq!(
            stages,
            [
                ("move", 0),
                ("flicker", 0),
                ("steer", 1),
                ("look", 0),
                ("all", 2),
                ("watch", 3)
            ]
        );
    }

    #[test]
    fn a_system_sees_what_changed_since_its_last_run() {
        let mut world = World::new();
        let entities = world
            .spawn_batch((0..100).map(|_| (Light::default(),)))
            .to_vec();
        let (sender, counts) = std::sync::mpsc::channel();
        let mut schedule = Schedule::default();
        schedule.add::<(Light,), ()>("watch", move |(lights,), (), context| {
            sender
                .send(lights.changed_since(context.since).count())
                .unwrap();
        });
        schedule.run(&mut world, 0.1);
        schedule.run(&mut world, 0.1);
        world.set(entities[7], Light::default()).unwrap();
        schedule.run(&mut world, 0.1);
        drop(schedule);
        assert_eq!(counts.iter().collect::<Vec<_>>(), [100, 0, 1]);
    }
}
