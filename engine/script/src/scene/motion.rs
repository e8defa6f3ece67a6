//! Entities that move by themselves: evenly, or along keyed curves.

use lightbench_world::components::Repeat;
use lightbench_world::curve::{Curve, Interpolate, Interpolation};
use lightbench_world::glam::{DQuat, DVec3, Quat, Vec3};
use lightbench_world::{Entity, RigidAnimation, Stored, Velocity};
use rhai::Dynamic;

use super::data::{Data, Stage};
use super::entities::method;
use crate::api::{Api, Arguments, Mistake, as_number};
use crate::math::from_degrees;

/// The keys that one curve may have.
const MAX_KEYS: usize = 100_000;

/// How a curve runs, in the words of scripts.
const MODES: [(&str, Mode); 3] = [
    ("step", Mode::Keys(Interpolation::Step)),
    ("linear", Mode::Keys(Interpolation::Linear)),
    ("smooth", Mode::Smooth),
];

#[derive(Clone, Copy)]
enum Mode {
    Keys(Interpolation),
    Smooth,
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for form in ["velocity(x, y, z)", "velocity(speed)"] {
        method(
            api,
            stage,
            form,
            "Moves the entity evenly from now on, in metres a second, in its parent's space.",
            |data, entity, a| {
                let linear = a.vector(0)?.as_vec3();
                change(data, entity, |velocity: &mut Velocity| {
                    velocity.linear = linear;
                })
            },
        );
    }
    for form in ["spin(x, y, z)", "spin(speed)"] {
        method(
            api,
            stage,
            form,
            "Turns the entity evenly from now on, in degrees a second about the axes of its \
             parent's space.",
            |data, entity, a| {
                let angular = a.vector(0)?.as_vec3();
                let angular = angular.map(f32::to_radians);
                data.aims.remove(&entity);
                change(data, entity, |velocity: &mut Velocity| {
                    velocity.angular = angular;
                })
            },
        );
    }
    curves(api, stage);
    play(api, stage);
}

fn curves(api: &mut Api, stage: &Stage) {
    for form in ["animate_position(keys)", "animate_position(keys, mode)"] {
        method(
            api,
            stage,
            form,
            "Moves the entity from point to point: `keys` are `[seconds, point]`. `mode` is \
             `linear` unless told, `step` or `smooth`.",
            |data, entity, a| {
                let curve = curve(a, point)?;
                change(data, entity, |animation: &mut RigidAnimation| {
                    animation.translation = curve;
                })
            },
        );
    }
    for form in ["animate_rotation(keys)", "animate_rotation(keys, mode)"] {
        method(
            api,
            stage,
            form,
            "Turns the entity from position to position: `keys` are `[seconds, rotation]`, each \
             rotation as `turn` takes it, or three angles as a vector. `mode` is `linear` unless \
             told, `step` or `smooth`.",
            |data, entity, a| {
                let curve = curve(a, rotation)?;
                data.aims.remove(&entity);
                change(data, entity, |animation: &mut RigidAnimation| {
                    animation.rotation = curve;
                })
            },
        );
    }
    for form in ["animate_scale(keys)", "animate_scale(keys, mode)"] {
        method(
            api,
            stage,
            form,
            "Scales the entity from size to size: `keys` are `[seconds, factor]` or `[seconds, \
             vector]`. `mode` is `linear` unless told, `step` or `smooth`.",
            |data, entity, a| {
                let curve = curve(a, |a, key| match as_number(key) {
                    Some(factor) => Ok(Vec3::splat(factor as f32)),
                    None => point(a, key),
                })?;
                change(data, entity, |animation: &mut RigidAnimation| {
                    animation.scale = curve;
                })
            },
        );
    }
}

fn play(api: &mut Api, stage: &Stage) {
    method(
        api,
        stage,
        "animation_repeat(mode)",
        "What happens at the end of the entity's animation: `loop` unless told, `once` or \
         `ping_pong`.",
        |data, entity, a| {
            let choices: Vec<_> = Repeat::ALL
                .iter()
                .map(|mode| (mode.name(), *mode))
                .collect();
            let repeat = a.choice(0, &choices)?;
            change(data, entity, |animation: &mut RigidAnimation| {
                animation.repeat = repeat;
            })
        },
    );
    method(
        api,
        stage,
        "animation_speed(factor)",
        "How fast the entity's animation runs: 1 as its keys say, negative backwards.",
        |data, entity, a| {
            let speed = a.float(0)?;
            change(data, entity, |animation: &mut RigidAnimation| {
                animation.speed = speed;
            })
        },
    );
    method(
        api,
        stage,
        "animation_start(seconds)",
        "Where in its keys the entity's animation stands when the scene begins.",
        |data, entity, a| {
            let offset = a.float(0)?;
            change(data, entity, |animation: &mut RigidAnimation| {
                animation.offset = offset;
            })
        },
    );
}

/// Changes a component of an entity, which gets it if it has none.
fn change<C: Stored>(
    data: &mut Data,
    entity: Entity,
    edit: impl FnOnce(&mut C),
) -> Result<(), Mistake> {
    data.check(entity)?;
    let mut row: C = data.world.get(entity).unwrap_or_default();
    edit(&mut row);
    data.insert(entity, row)
}

/// A curve from an array of keys and, behind it, the mode.
pub(super) fn curve<T: Interpolate>(
    a: &Arguments,
    value: impl Fn(&Arguments, &Dynamic) -> Result<T, Mistake>,
) -> Result<Curve<T>, Mistake> {
    let mode = match a.len() {
        1 => Mode::Keys(Interpolation::Linear),
        _ => a.choice(1, &MODES)?,
    };
    let keys = a.array(0)?;
    if keys.len() > MAX_KEYS {
        return Err(Mistake::new(format!(
            "an animation has at most {MAX_KEYS} keys, not {}",
            keys.len()
        )));
    }
    let mut times = Vec::with_capacity(keys.len());
    let mut values = Vec::with_capacity(keys.len());
    for (number, key) in keys.iter().enumerate() {
        let wrong = || {
            Mistake::new(format!("key {} of the animation is no pair", number + 1))
                .with_hint("a key is written `[seconds, value]`")
        };
        let pair = key.read_lock::<rhai::Array>().ok_or_else(wrong)?;
        let [time, at] = pair.as_slice() else {
            return Err(wrong());
        };
        times.push(as_number(time).ok_or_else(wrong)? as f32);
        let at = value(a, at)
            .map_err(|mistake| Mistake::new(format!("key {}: {}", number + 1, mistake.message)))?;
        values.push(at);
    }
    match mode {
        Mode::Keys(interpolation) => Curve::new(times, values, interpolation),
        Mode::Smooth => Curve::smooth(times, values),
    }
    .map_err(Mistake::new)
}

fn vector(key: &Dynamic) -> Result<DVec3, Mistake> {
    key.read_lock::<DVec3>()
        .map(|vector| *vector)
        .filter(|vector| vector.is_finite())
        .ok_or_else(|| {
            Mistake::new("the value is no point").with_hint("a point is written `vec3(x, y, z)`")
        })
}

pub(super) fn point(_: &Arguments, key: &Dynamic) -> Result<Vec3, Mistake> {
    vector(key).map(|vector| vector.as_vec3())
}

fn rotation(_: &Arguments, key: &Dynamic) -> Result<Quat, Mistake> {
    let rotation = match key.read_lock::<DQuat>() {
        Some(rotation) => *rotation,
        None => from_degrees(vector(key)?),
    };
    let rotation = rotation.as_quat();
    let length = rotation.length();
    if length.is_finite() && length > 1e-6 {
        Ok(rotation / length)
    } else {
        Err(Mistake::new("this is no rotation"))
    }
}
