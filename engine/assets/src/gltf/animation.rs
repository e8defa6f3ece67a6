//! Animations of glTF files, node by node.

use std::collections::HashMap;

use ::gltf::animation::{Interpolation, Property};
use glam::{Quat, Vec3};
use lightbench_world::RigidAnimation;
use lightbench_world::curve::{Curve, Interpolate, Interpolation as Mode};

use super::Document;
use super::nodes::Numbered;
use crate::obj::Problem;

/// The bytes that the curves of an animation hold at most.
pub(super) fn byte_count(animation: &RigidAnimation) -> usize {
    let times = [
        animation.translation.times(),
        animation.rotation.times(),
        animation.scale.times(),
    ];
    let keys: usize = times.iter().map(|times| times.len()).sum();
    // A time, and a value with two tangents.
    keys * (size_of::<f32>() + 3 * size_of::<Quat>())
}

/// Gives the nodes the curves of all animations of the file. All of an animation's nodes repeat
/// together, when its longest channel ends.
pub(super) fn load(document: &mut Document, nodes: &mut Numbered) -> Result<(), Problem> {
    let places: HashMap<usize, usize> = nodes
        .iter()
        .enumerate()
        .map(|(place, (number, _))| (*number, place))
        .collect();
    let gltf = document.gltf.clone();
    for animation in gltf.animations() {
        let mut channels = Vec::new();
        let mut end: f32 = 0.0;
        for channel in animation.channels() {
            let times = document.floats::<1>(&channel.sampler().input())?;
            let times: Vec<f32> = times.into_iter().flatten().collect();
            end = times
                .last()
                .copied()
                .filter(|time| time.is_finite())
                .map_or(end, |t| end.max(t));
            channels.push((channel, times));
        }
        for (channel, times) in channels {
            let target = channel.target();
            let Some(&place) = places.get(&target.node().index()) else {
                continue;
            };
            let node = &mut nodes[place].1;
            let moved = node.animation.get_or_insert_default();
            add(document, moved, &channel, times, end)?;
        }
    }
    Ok(())
}

fn add(
    document: &mut Document,
    moved: &mut RigidAnimation,
    channel: &::gltf::animation::Channel,
    times: Vec<f32>,
    end: f32,
) -> Result<(), Problem> {
    let sampler = channel.sampler();
    let output = sampler.output();
    let mode = sampler.interpolation();
    let wrong = |document: &Document, error: String| {
        let (animation, channel) = (channel.animation().index(), channel.index());
        document.problem(format!("animation {animation}, channel {channel}: {error}"))
    };
    let twice = match channel.target().property() {
        Property::Rotation => {
            let values = document.floats::<4>(&output)?;
            let values = values.into_iter().map(Quat::from_array).collect();
            let curve = curve(times, values, mode, end).map_err(|error| wrong(document, error))?;
            let finite = curve
                .values()
                .iter()
                .all(|q| q.is_finite() && q.length() > 1e-6);
            if !finite {
                return Err(wrong(document, "a value is no rotation".to_owned()));
            }
            put(&mut moved.rotation, curve)
        }
        Property::MorphTargetWeights => {
            document.warn("morph targets are not supported; the mesh keeps its first shape");
            false
        }
        property => {
            let values = document.floats::<3>(&output)?;
            let values = values.into_iter().map(Vec3::from).collect();
            let curve = curve(times, values, mode, end).map_err(|error| wrong(document, error))?;
            if !curve.values().iter().all(|value| value.is_finite()) {
                return Err(wrong(
                    document,
                    "a value is infinite or not a number".to_owned(),
                ));
            }
            match property {
                Property::Translation => put(&mut moved.translation, curve),
                _ => put(&mut moved.scale, curve),
            }
        }
    };
    if twice {
        document.warn("where several animations move a node, the first counts");
    }
    Ok(())
}

/// Sets a curve that is not set yet. True if it was.
fn put<T: Interpolate>(slot: &mut Curve<T>, curve: Curve<T>) -> bool {
    if slot.is_empty() {
        *slot = curve;
        return false;
    }
    true
}

/// A curve that holds its last value until the animation's end.
fn curve<T: Interpolate + Default>(
    mut times: Vec<f32>,
    values: Vec<T>,
    mode: Interpolation,
    end: f32,
) -> Result<Curve<T>, String> {
    let hold = times.last().is_some_and(|&last| last < end);
    if mode != Interpolation::CubicSpline {
        let mut values = values;
        if values.len() != times.len() {
            return Err(format!(
                "{} times have {} values",
                times.len(),
                values.len()
            ));
        }
        if hold && let Some(last) = values.last().cloned() {
            times.push(end);
            values.push(last);
        }
        let mode = match mode {
            Interpolation::Step => Mode::Step,
            _ => Mode::Linear,
        };
        return Curve::new(times, values, mode);
    }
    // In tangent, value and out tangent of each key (glTF 2.0, appendix C.5).
    if values.len() != 3 * times.len() {
        return Err(format!(
            "{} times of a cubic spline have {} values, and need three each",
            times.len(),
            values.len()
        ));
    }
    let every_third = |first: usize| values.iter().skip(first).step_by(3).cloned().collect();
    let [mut before, mut at, mut after]: [Vec<T>; 3] = [0, 1, 2].map(every_third);
    if hold && let (Some(last), Some(out)) = (at.last().cloned(), after.last_mut()) {
        let still = T::weighted_sum(&[(0.0, &last)]);
        *out = still.clone();
        times.push(end);
        at.push(last);
        before.push(still.clone());
        after.push(still);
    }
    Curve::cubic(times, at, before, after)
}
