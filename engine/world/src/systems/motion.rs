//! What moves by itself: even motion and keyframed animation.

use glam::{Quat, Vec3};

use crate::columns::Columns;
use crate::components::{Repeat, RigidAnimation, Transform, Velocity};
use crate::query::Join;
use crate::schedule::Schedule;
use crate::world::World;

/// Entities that move evenly, as runs of rows.
type Moving = Join<(Velocity, Transform), 2>;

/// Adds the systems that move entities.
pub(super) fn add_motion(schedule: &mut Schedule) {
    let mut moving = Moving::default();
    schedule.add::<(Velocity,), (Transform,)>(
        "velocity",
        move |(velocities,), (places,), context| {
            // Also where no time passes: a product with zero would count as a change.
            if context.step != 0.0 {
                integrate(&mut moving, velocities, places, context.step);
            }
        },
    );
    schedule.add::<(RigidAnimation,), (Transform,)>(
        "animation",
        |(animations,), (places,), context| pose(animations, places, context.time),
    );
}

/// Moves every entity with a Velocity and a Transform by a step in seconds.
pub fn move_by_velocity(world: &mut World, step: f32) {
    world.write::<(Transform,), _>(|world, (places,)| {
        let velocities = world.columns::<Velocity>();
        integrate(&mut Moving::default(), velocities, places, step);
    });
}

/// Puts every entity with a RigidAnimation and a Transform where its curves say
/// that it is at a time in seconds.
pub fn animate(world: &mut World, time: f64) {
    world.write::<(Transform,), _>(|world, (places,)| {
        pose(world.columns::<RigidAnimation>(), places, time);
    });
}

fn integrate(
    moving: &mut Moving,
    velocities: &Columns<Velocity>,
    places: &mut Columns<Transform>,
    step: f32,
) {
    moving.update_columns((velocities, places));
    let input = velocities.slices();
    let (output, mut marker) = places.slices_and_marker();
    for run in moving.runs() {
        let velocities = input.linear[run.rows(0)]
            .iter()
            .zip(&input.angular[run.rows(0)]);
        for (place, (linear, angular)) in run.rows(1).zip(velocities) {
            if *linear != Vec3::ZERO {
                output.translation[place] += *linear * step;
                marker.mark(place);
            }
            if *angular != Vec3::ZERO {
                let turn = Quat::from_scaled_axis(*angular * step);
                output.rotation[place] = (turn * output.rotation[place]).normalize();
                marker.mark(place);
            }
        }
    }
}

fn pose(animations: &Columns<RigidAnimation>, places: &mut Columns<Transform>, time: f64) {
    let input = animations.slices();
    for (row, &entity) in animations.entities().iter().enumerate() {
        let Some(place) = places.row_of(entity) else {
            continue;
        };
        let (translation, rotation, scale) = (
            &input.translation[row],
            &input.rotation[row],
            &input.scale[row],
        );
        let ends = [translation.times(), rotation.times(), scale.times()];
        let length = ends
            .iter()
            .filter_map(|times| times.last())
            .fold(0.0, |longest: f32, &end| longest.max(end));
        let elapsed = f64::from(input.offset[row]) + time * f64::from(input.speed[row]);
        let time = fold_time(elapsed, f64::from(length), input.repeat[row]) as f32;
        let mut transform = places.row(place);
        if let Some(value) = translation.sample(time) {
            transform.translation = value;
        }
        if let Some(value) = rotation.sample(time) {
            transform.rotation = value;
        }
        if let Some(value) = scale.sample(time) {
            transform.scale = value;
        }
        if transform != places.row(place) {
            places.set_row(place, transform);
        }
    }
}

/// The time within curves of a length, from 0 to `length`.
fn fold_time(time: f64, length: f64, repeat: Repeat) -> f64 {
    if length <= 0.0 {
        return 0.0;
    }
    match repeat {
        Repeat::Once => time.clamp(0.0, length),
        Repeat::Loop => time.rem_euclid(length),
        Repeat::PingPong => {
            let time = time.rem_euclid(2.0 * length);
            time.min(2.0 * length - time)
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::curve::{Curve, Interpolation};
    use crate::systems::FrameSystems;
    use crate::{Entity, WorldMatrix};
    use std::f32::consts::PI;

    fn place(world: &World, entity: Entity) -> Transform {
        world.get(entity).unwrap()
    }

    #[test]
    fn even_motion_adds_up() {
        let mut world = World::new();
        let velocity = Velocity {
            linear: Vec3::new(1.0, 0.0, -2.0),
            angular: Vec3::new(0.0, PI, 0.0),
        };
        let still = world.spawn_batch([(Transform::default(), Velocity::default())])[0];
        let moving = world.spawn_batch([(velocity, Transform::default())])[0];
        let mut systems = FrameSystems::default();
        systems.run(&mut world, &[], 0.0, 0.0);
        let seen = world.observe();
        for step in 1..=64 {
            systems.run(&mut world, &[], f64::from(step) / 128.0, 1.0 / 128.0);
        }
        let found = place(&world, moving);
        assert!(found.translation.distance(Vec3::new(0.5, 0.0, -1.0)) < 1e-5);
        assert!((found.rotation * Vec3::X).distance(Vec3::NEG_Z) < 1e-4);
        assert_eq!(place(&world, still), Transform::default());
        let matrix = world.get::<WorldMatrix>(moving).unwrap().matrix;
        assert_eq!(matrix, found.matrix());
        // What stands still is not reported as changed.
        assert_eq!(world.columns::<Transform>().changed_since(seen).count(), 1);
    }

    #[test]
    fn animation_is_a_function_of_time() {
        let mut world = World::new();
        let slide = Curve::new(
            vec![0.0, 2.0],
            vec![Vec3::ZERO, Vec3::X],
            Interpolation::Linear,
        );
        let animation = RigidAnimation {
            translation: slide.unwrap(),
            repeat: Repeat::PingPong,
            ..RigidAnimation::default()
        };
        let start = Transform {
            scale: Vec3::splat(3.0),
            ..Transform::default()
        };
        let entity = world.spawn_batch([(start, animation)])[0];
        for (time, x) in [(0.5, 0.25), (3.0, 0.5), (-1.0, 0.5), (8.0, 0.0)] {
            animate(&mut world, time);
            assert_eq!(place(&world, entity).translation, Vec3::new(x, 0.0, 0.0));
            assert_eq!(place(&world, entity).scale, Vec3::splat(3.0));
        }
    }

    #[test]
    fn time_folds_as_the_repeat_says() {
        let fold = |repeat| [-1.0, 0.5, 2.5, 5.0].map(|time| fold_time(time, 2.0, repeat));
        assert_eq!(fold(Repeat::Once), [0.0, 0.5, 2.0, 2.0]);
        assert_eq!(fold(Repeat::Loop), [1.0, 0.5, 0.5, 1.0]);
        assert_eq!(fold(Repeat::PingPong), [1.0, 0.5, 1.5, 1.0]);
        assert_eq!(fold_time(3.0, 0.0, Repeat::Loop), 0.0);
    }
}
