//! Curves that a script asks for their value: numbers, points or colours between keys.

use std::sync::Arc;

use lightbench_world::curve::{Curve, Interpolate};
use lightbench_world::glam::Vec3;
use rhai::Dynamic;

use super::motion::{curve, point};
use crate::api::{Api, Arguments, Mistake, ScriptType, as_number};
use crate::color::Color;

/// A curve with values of one kind, as scripts hold it.
#[derive(Clone, Debug)]
pub(super) enum Keyed {
    Numbers(Arc<Curve<f32>>),
    Points(Arc<Curve<Vec3>>),
    Colors(Arc<Curve<Vec3>>),
}

impl ScriptType for Keyed {
    const NAME: &'static str = "curve";
}

/// What a curve's first key holds.
enum Held {
    Number,
    Point,
    Color,
}

pub(super) fn register(api: &mut Api) {
    api.object::<Keyed>();
    for form in ["curve(keys)", "curve(keys, mode)"] {
        api.function(
            form,
            "A curve through keys `[time, value]` with ascending times. All values are numbers, or points, or \
             colours. `mode` says how it runs between them: `linear` unless told, `step` or `smooth`.",
            |a| {
                Ok(match held(a)? {
                    Held::Number => Keyed::Numbers(Arc::new(curve(a, number)?)),
                    Held::Point => Keyed::Points(Arc::new(curve(a, point)?)),
                    Held::Color => Keyed::Colors(Arc::new(curve(a, color)?)),
                })
            },
        );
    }
    api.method(
        "at(time)",
        "The value at a time: before the first key that of the first, after the last that of the last.",
        |keyed: Keyed, a| {
            let time = a.float(0)?;
            Ok(match keyed {
                Keyed::Numbers(curve) => sample(&curve, time, |v| Dynamic::from(f64::from(v))),
                Keyed::Points(curve) => sample(&curve, time, |v| Dynamic::from(v.as_dvec3())),
                // A smooth curve may swing below what is no light at all.
                Keyed::Colors(curve) => sample(&curve, time, |v| {
                    Dynamic::from(Color(v.max(Vec3::ZERO).as_dvec3()))
                }),
            })
        },
    );
    api.getter("start", "The time of its first key.", |keyed: Keyed, _| {
        Ok(f64::from(keyed.times()[0]))
    });
    api.getter("end", "The time of its last key.", |keyed: Keyed, _| {
        let times = keyed.times();
        Ok(f64::from(times[times.len() - 1]))
    });
}

impl Keyed {
    /// The times of the keys, of which there is at least one.
    fn times(&self) -> &[f32] {
        match self {
            Self::Numbers(curve) => curve.times(),
            Self::Points(curve) | Self::Colors(curve) => curve.times(),
        }
    }
}

fn sample<T: Interpolate>(curve: &Curve<T>, time: f32, give: impl Fn(T) -> Dynamic) -> Dynamic {
    curve.sample(time).map_or(Dynamic::UNIT, give)
}

/// Which kind of values the keys have, from the first.
fn held(a: &Arguments) -> Result<Held, Mistake> {
    let keys = a.array(0)?;
    let Some(first) = keys.first() else {
        return Err(Mistake::new("a curve needs at least one key")
            .with_hint("a key is written `[time, value]`"));
    };
    // A key that is no pair is told of when all are read.
    let first = first.read_lock::<rhai::Array>();
    let value = first.as_ref().and_then(|pair| pair.get(1));
    Ok(match value {
        Some(value) if value.is::<Color>() => Held::Color,
        Some(value) if value.is::<lightbench_world::glam::DVec3>() => Held::Point,
        _ => Held::Number,
    })
}

fn number(a: &Arguments, key: &Dynamic) -> Result<f32, Mistake> {
    match as_number(key) {
        Some(number) if number.is_finite() => Ok(number as f32),
        _ => Err(Mistake::new(format!(
            "the value must be a number as that of the first key, or a point or a colour, not {}",
            a.describe(key)
        ))),
    }
}

fn color(a: &Arguments, key: &Dynamic) -> Result<Vec3, Mistake> {
    match key.read_lock::<Color>() {
        Some(color) => Ok(color.0.as_vec3()),
        None => Err(Mistake::new(format!(
            "the value must be a colour as that of the first key, not {}",
            a.describe(key)
        ))),
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::printed;

    #[test]
    fn curves_of_numbers_points_and_colours() {
        let script = "
            let height = curve([[0, 1], [2, 5]]);
            for t in [-1, 0, 0.5, 2, 9] { print(height.at(t)); }
            let steps = curve([[0, 1], [2, 5]], \"step\");
            print(steps.at(1.9));
            let way = curve([[0, vec3(0, 0, 0)], [1, vec3(2, 0, 0)], [2, vec3(2, 2, 0)]]);
            print(way.at(1.5).y);
            let dusk = curve([[6, rgb(1, 0, 0)], [8, rgb(0, 0, 1)]]);
            print(dusk.at(7).r);
            print(dusk.start + dusk.end);";
        let expected = [1.0, 1.0, 2.0, 5.0, 5.0, 1.0, 1.0, 0.5, 14.0];
        assert_eq!(printed(script), expected);
    }
}
