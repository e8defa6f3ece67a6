//! Creating, removing, looking up and walking a million entities: the world
//! against hecs, bevy_ecs and arrays written by hand.

use std::time::Duration;

use bevy_ecs::component::Component;
use glam::{Affine3A, Vec3};
use lightbench_world::{Entity, Join, Light, Transform, Velocity, World, WorldMatrix};
use lightbench_world_benches::{Contest, criterion, now};
use rand::SeedableRng;
use rand::seq::SliceRandom;

const COUNT: usize = 1_000_000;
const STEP: f32 = 1.0 / 60.0;

#[derive(Clone, Copy, Component)]
#[allow(dead_code)]
struct Place(Transform);
#[derive(Clone, Copy, Component)]
#[allow(dead_code)]
struct Matrix(WorldMatrix);
#[derive(Clone, Copy, Component)]
#[allow(dead_code)]
struct Speed(Velocity);
#[derive(Clone, Copy, Component)]
#[allow(dead_code)]
struct Lamp(Light);
#[derive(Clone, Copy, Component)]
#[allow(dead_code)]
struct Position(Vec3);
#[derive(Clone, Copy, Component)]
#[allow(dead_code)]
struct Direction(Vec3);

fn place(i: usize) -> Transform {
    Transform::from_translation(Vec3::splat(i as f32))
}

fn speed(i: usize) -> Velocity {
    Velocity {
        linear: Vec3::new(1.0, i as f32, 2.0),
        ..Velocity::default()
    }
}

fn row(i: usize) -> (Transform, Velocity, Light) {
    (place(i), speed(i), Light::default())
}

fn foreign_row(i: usize) -> (Place, Matrix, Speed, Lamp) {
    let matrix = WorldMatrix {
        matrix: Affine3A::IDENTITY,
    };
    (
        Place(place(i)),
        Matrix(matrix),
        Speed(speed(i)),
        Lamp(Light::default()),
    )
}

/// The same fields as arrays, with the maps that handles need.
#[derive(Clone, Default)]
struct Arrays {
    generations: Vec<u32>,
    rows: Vec<u32>,
    entities: Vec<(u32, u32)>,
    translation: Vec<Vec3>,
    rotation: Vec<glam::Quat>,
    scale: Vec<Vec3>,
    matrix: Vec<Affine3A>,
    linear: Vec<Vec3>,
    angular: Vec<Vec3>,
    kind: Vec<lightbench_world::LightKind>,
    color: Vec<Vec3>,
    intensity: Vec<f32>,
    range: Vec<f32>,
    inner: Vec<f32>,
    outer: Vec<f32>,
}

macro_rules! each {
    ($arrays:expr, $array:ident => $body:expr) => {{
        let arrays = $arrays;
        {
            let $array = &mut arrays.translation;
            $body;
        }
        {
            let $array = &mut arrays.rotation;
            $body;
        }
        {
            let $array = &mut arrays.scale;
            $body;
        }
        {
            let $array = &mut arrays.matrix;
            $body;
        }
        {
            let $array = &mut arrays.linear;
            $body;
        }
        {
            let $array = &mut arrays.angular;
            $body;
        }
        {
            let $array = &mut arrays.kind;
            $body;
        }
        {
            let $array = &mut arrays.color;
            $body;
        }
        {
            let $array = &mut arrays.intensity;
            $body;
        }
        {
            let $array = &mut arrays.range;
            $body;
        }
        {
            let $array = &mut arrays.inner;
            $body;
        }
        {
            let $array = &mut arrays.outer;
            $body;
        }
    }};
}

impl Arrays {
    fn with_rows(count: usize) -> Self {
        let mut arrays = Self::default();
        arrays.generations.reserve(count);
        arrays.rows.reserve(count);
        arrays.entities.reserve(count);
        each!(&mut arrays, array => array.reserve(count));
        for i in 0..count {
            let (place, speed, light) = row(i);
            arrays.generations.push(1);
            arrays.rows.push(i as u32);
            arrays.entities.push((i as u32, 1));
            arrays.translation.push(place.translation);
            arrays.rotation.push(place.rotation);
            arrays.scale.push(place.scale);
            arrays.matrix.push(Affine3A::IDENTITY);
            arrays.linear.push(speed.linear);
            arrays.angular.push(speed.angular);
            arrays.kind.push(light.kind);
            arrays.color.push(light.color);
            arrays.intensity.push(light.intensity);
            arrays.range.push(light.range);
            arrays.inner.push(light.inner_angle);
            arrays.outer.push(light.outer_angle);
        }
        arrays
    }

    fn row_of(&self, (slot, generation): (u32, u32)) -> Option<usize> {
        let row = *self.rows.get(slot as usize)? as usize;
        (self.entities.get(row) == Some(&(slot, generation))).then_some(row)
    }

    fn remove(&mut self, entity: (u32, u32)) {
        let Some(row) = self.row_of(entity) else {
            return;
        };
        self.generations[entity.0 as usize] += 1;
        self.entities.swap_remove(row);
        if let Some(moved) = self.entities.get(row) {
            self.rows[moved.0 as usize] = row as u32;
        }
        each!(self, array => array.swap_remove(row));
    }
}

fn timed<T, U>(prepare: impl Fn() -> T, mut work: impl FnMut(&mut T) -> U) -> Duration {
    let mut subject = prepare();
    let start = now();
    std::hint::black_box(work(&mut subject));
    let time = start.elapsed();
    drop(subject);
    time
}

fn integrate(criterion: &mut criterion::Criterion) {
    let mut contest = Contest::new(criterion, "integrate 1,000,000 positions");

    let mut places: Vec<Vec3> = (0..COUNT).map(|i| place(i).translation).collect();
    let speeds: Vec<Vec3> = (0..COUNT).map(|i| speed(i).linear).collect();
    contest.enter("by hand", || {
        for (place, speed) in places.iter_mut().zip(&speeds) {
            *place += *speed * STEP;
        }
    });

    let mut world = World::new();
    world.spawn_batch((0..COUNT).map(|i| (place(i), speed(i))));
    let mut join = Join::<(Transform, Velocity), 2>::default();
    contest.enter("world", || {
        join.update(&world);
        world.write::<(Transform,), _>(|world, (places,)| {
            let places = places.slices_mut().translation;
            let speeds = world.columns::<Velocity>().linear();
            for run in join.runs() {
                let places = &mut places[run.rows(0)];
                for (place, speed) in places.iter_mut().zip(&speeds[run.rows(1)]) {
                    *place += *speed * STEP;
                }
            }
        });
    });

    let mut hecs = hecs::World::new();
    hecs.spawn_batch(
        (0..COUNT).map(|i| (Position(place(i).translation), Direction(speed(i).linear))),
    );
    contest.enter("hecs", || {
        for (place, speed) in hecs.query_mut::<(&mut Position, &Direction)>() {
            place.0 += speed.0 * STEP;
        }
    });

    let mut bevy = bevy_ecs::world::World::new();
    bevy.spawn_batch(
        (0..COUNT).map(|i| (Position(place(i).translation), Direction(speed(i).linear))),
    );
    let mut query = bevy.query::<(&mut Position, &Direction)>();
    contest.enter("bevy_ecs", || {
        query.iter_mut(&mut bevy).for_each(|(mut place, speed)| {
            place.0 += speed.0 * STEP;
        });
    });

    contest.ratio("world", "by hand", 1.05);
    contest.ratio("world", "hecs", 1.0);
    contest.ratio("world", "bevy_ecs", 1.0);
}

fn spawn(criterion: &mut criterion::Criterion) {
    let mut contest = Contest::new(criterion, "spawn 1,000,000 entities with four components");
    contest.enter_timed("by hand", || timed(|| (), |()| Arrays::with_rows(COUNT)));
    contest.enter_timed("world", || {
        timed(World::new, |world| {
            world.spawn_batch((0..COUNT).map(row)).len()
        })
    });
    contest.enter_timed("hecs", || {
        timed(hecs::World::new, |world| {
            world.spawn_batch((0..COUNT).map(foreign_row)).count()
        })
    });
    contest.enter_timed("bevy_ecs", || {
        timed(bevy_ecs::world::World::new, |world| {
            world.spawn_batch((0..COUNT).map(foreign_row)).count()
        })
    });
    contest.ratio("world", "hecs", 1.0);
    contest.ratio("world", "bevy_ecs", 1.0);
    contest.ratio("world", "by hand", f64::INFINITY);
}

fn shuffled<T: Clone>(items: &[T]) -> Vec<T> {
    let mut items = items.to_vec();
    items.shuffle(&mut rand_pcg::Pcg64::seed_from_u64(1));
    items
}

fn remove(criterion: &mut criterion::Criterion) {
    let mut contest = Contest::new(criterion, "remove 500,000 of 1,000,000 at random");

    let handles: Vec<(u32, u32)> = (0..COUNT as u32).map(|i| (i, 1)).collect();
    let chosen = &shuffled(&handles)[..COUNT / 2];
    contest.enter_timed("by hand", || {
        timed(
            || Arrays::with_rows(COUNT),
            |arrays| chosen.iter().for_each(|&entity| arrays.remove(entity)),
        )
    });

    let fresh = || {
        let mut world = World::new();
        world.spawn_batch((0..COUNT).map(row));
        world
    };
    let handles: Vec<Entity> = fresh().entities().collect();
    let chosen = &shuffled(&handles)[..COUNT / 2];
    contest.enter_timed("world", || {
        timed(fresh, |world| {
            world.despawn_batch(chosen);
            // Rows go with the next look, which is part of the job.
            world.columns::<Transform>().len()
        })
    });
    contest.enter_timed("world, one by one", || {
        timed(fresh, |world| {
            for &entity in chosen {
                world.despawn(entity);
            }
            world.columns::<Transform>().len()
        })
    });

    let fresh = || {
        let mut world = hecs::World::new();
        world.spawn_batch((0..COUNT).map(foreign_row));
        world
    };
    let handles: Vec<hecs::Entity> = fresh().iter().map(|entity| entity.entity()).collect();
    let chosen = &shuffled(&handles)[..COUNT / 2];
    contest.enter_timed("hecs", || {
        timed(fresh, |world| {
            chosen
                .iter()
                .filter(|&&entity| world.despawn(entity).is_ok())
                .count()
        })
    });
    contest.ratio("world", "hecs", 0.6);
    contest.ratio("world, one by one", "hecs", 0.6);
    contest.ratio("world", "by hand", f64::INFINITY);
}

fn look_up(criterion: &mut criterion::Criterion) {
    let mut contest = Contest::new(criterion, "look up 1,000,000 handles at random");

    let arrays = Arrays::with_rows(COUNT);
    let handles = shuffled(&arrays.entities);
    contest.enter("by hand", || {
        let rows = handles.iter().filter_map(|&entity| arrays.row_of(entity));
        rows.map(|row| arrays.translation[row].x).sum::<f32>()
    });

    let mut world = World::new();
    let handles = shuffled(world.spawn_batch((0..COUNT).map(row)));
    contest.enter("world", || {
        let places = world.columns::<Transform>();
        let translations = places.translation();
        let rows = handles.iter().filter_map(|&entity| places.row_of(entity));
        rows.map(|row| translations[row].x).sum::<f32>()
    });

    let mut world = hecs::World::new();
    let handles: Vec<_> = world.spawn_batch((0..COUNT).map(foreign_row)).collect();
    let handles = shuffled(&handles);
    let mut query = world.query::<&Place>();
    contest.enter("hecs", || {
        let view = query.view();
        let places = handles.iter().filter_map(|&entity| view.get(entity));
        places.map(|place| place.0.translation.x).sum::<f32>()
    });
    contest.ratio("world", "hecs", 1.0);
    contest.ratio("world", "by hand", f64::INFINITY);
}

fn main() {
    let mut criterion = criterion();
    integrate(&mut criterion);
    look_up(&mut criterion);
    remove(&mut criterion);
    spawn(&mut criterion);
    criterion.final_summary();
}
