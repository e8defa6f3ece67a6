//! Keyframed curves.

use glam::{Quat, Vec3, Vec4};

use crate::value::{FieldType, Value, ValueType, choice, mismatch};

choice! {
    /// How a curve runs between two keys.
    Interpolation {
        /// Keeps the value of the earlier key.
        Step = "step",
        /// Goes evenly from key to key; rotations turn at an even speed.
        Linear = "linear",
        /// Follows a cubic through both keys with the tangents given there.
        Cubic = "cubic",
    }
}

/// A type that a curve can run through.
pub trait Interpolate: FieldType + PartialEq + std::fmt::Debug {
    /// The value at `t` from 0 to 1 on the way to `other`.
    fn interpolate(&self, other: &Self, t: f32) -> Self;
    /// The sum of values, each times its weight: no rotation any more, for a quaternion, until
    /// [`Interpolate::settled`] makes it one.
    fn weighted_sum(terms: &[(f32, &Self)]) -> Self;
    /// The nearest value that means something.
    #[must_use]
    fn settled(self) -> Self {
        self
    }
    /// The same value in the form that lies nearer to another one: a quaternion and its negative
    /// are one rotation.
    #[must_use]
    fn near(&self, _other: &Self) -> Self {
        self.clone()
    }
}

impl Interpolate for f32 {
    fn interpolate(&self, other: &Self, t: f32) -> Self {
        self + (other - self) * t
    }
    fn weighted_sum(terms: &[(f32, &Self)]) -> Self {
        terms.iter().map(|(weight, value)| weight * **value).sum()
    }
}

impl Interpolate for Vec3 {
    fn interpolate(&self, other: &Self, t: f32) -> Self {
        self.lerp(*other, t)
    }
    fn weighted_sum(terms: &[(f32, &Self)]) -> Self {
        terms.iter().map(|(weight, value)| **value * *weight).sum()
    }
}

impl Interpolate for Quat {
    fn interpolate(&self, other: &Self, t: f32) -> Self {
        self.slerp(*other, t)
    }
    fn weighted_sum(terms: &[(f32, &Self)]) -> Self {
        let terms = terms.iter();
        Self::from_vec4(terms.map(|(weight, q)| Vec4::from(**q) * *weight).sum())
    }
    fn settled(self) -> Self {
        let length = self.length();
        if length > 1e-12 {
            self / length
        } else {
            Self::IDENTITY
        }
    }
    fn near(&self, other: &Self) -> Self {
        if self.dot(*other) < 0.0 {
            -*self
        } else {
            *self
        }
    }
}

/// Values at ascending times.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<T> {
    times: Vec<f32>,
    values: Vec<T>,
    /// Absent unless the curve is cubic, and elsewhere, because few curves are.
    tangents: Option<Box<Tangents<T>>>,
    interpolation: Interpolation,
}

/// Change of the value for each second, just before and just after each key.
#[derive(Clone, Debug, PartialEq)]
struct Tangents<T> {
    before: Vec<T>,
    after: Vec<T>,
}

impl<T> Default for Curve<T> {
    fn default() -> Self {
        Self {
            times: Vec::new(),
            values: Vec::new(),
            tangents: None,
            interpolation: Interpolation::Linear,
        }
    }
}

impl<T: Interpolate> Curve<T> {
    /// A curve through these values at these times in seconds, with steps or evenly.
    ///
    /// # Errors
    /// The lists differ in length, the times are not ascending numbers, or the curve is to be
    /// cubic, which needs tangents: [`Curve::cubic`] or [`Curve::smooth`].
    pub fn new(
        times: Vec<f32>,
        values: Vec<T>,
        interpolation: Interpolation,
    ) -> Result<Self, String> {
        let tangents = [Vec::new(), Vec::new()];
        Self::checked(times, values, tangents, interpolation)
    }

    /// A cubic Hermite curve: through these values, with these changes for each second just
    /// before (`in`) and just after (`out`) each key.
    ///
    /// # Errors
    /// The lists differ in length, or the times are not ascending numbers.
    pub fn cubic(
        times: Vec<f32>,
        values: Vec<T>,
        in_tangents: Vec<T>,
        out_tangents: Vec<T>,
    ) -> Result<Self, String> {
        let tangents = [in_tangents, out_tangents];
        Self::checked(times, values, tangents, Interpolation::Cubic)
    }

    /// A smooth curve through these values: cubic, where the tangent at each key is the slope
    /// between its neighbours, and zero at both ends (Catmull and Rom 1974, with uneven times).
    ///
    /// # Errors
    /// As [`Curve::new`].
    pub fn smooth(times: Vec<f32>, mut values: Vec<T>) -> Result<Self, String> {
        for key in 1..values.len() {
            values[key] = values[key].near(&values[key - 1]);
        }
        // Checks the times before they are divided by.
        let curve = Self::new(times, values, Interpolation::Linear)?;
        let Self { times, values, .. } = curve;
        let last = values.len().saturating_sub(1);
        let tangents: Vec<T> = (0..values.len())
            .map(|key| {
                let (before, after) = (key.saturating_sub(1), (key + 1).min(last));
                let inside = key > 0 && key < last;
                let weight = if inside {
                    1.0 / (times[after] - times[before])
                } else {
                    0.0
                };
                T::weighted_sum(&[(weight, &values[after]), (-weight, &values[before])])
            })
            .collect();
        Self::cubic(times, values, tangents.clone(), tangents)
    }

    fn checked(
        times: Vec<f32>,
        values: Vec<T>,
        [before, after]: [Vec<T>; 2],
        interpolation: Interpolation,
    ) -> Result<Self, String> {
        if times.len() != values.len() {
            return Err(format!(
                "a curve of {} times has {} values",
                times.len(),
                values.len()
            ));
        }
        if let Some(key) = times.iter().position(|time| !time.is_finite()) {
            return Err(format!("the time of key {key} is not a finite number"));
        }
        if let Some(key) = times.windows(2).position(|pair| pair[0] >= pair[1]) {
            return Err(format!(
                "the times of a curve must ascend, but key {} at {} s follows one at {} s",
                key + 1,
                times[key + 1],
                times[key]
            ));
        }
        let wanted = if interpolation == Interpolation::Cubic {
            times.len()
        } else {
            0
        };
        for (name, tangents) in [("in", &before), ("out", &after)] {
            if tangents.len() != wanted {
                return Err(format!(
                    "a {} curve of {} times needs {wanted} {name} tangents and has {}",
                    interpolation.name(),
                    times.len(),
                    tangents.len()
                ));
            }
        }
        let cubic = interpolation == Interpolation::Cubic;
        Ok(Self {
            times,
            values,
            tangents: cubic.then(|| Box::new(Tangents { before, after })),
            interpolation,
        })
    }

    /// Whether the curve has no key.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Times of the keys in seconds, ascending.
    pub fn times(&self) -> &[f32] {
        &self.times
    }

    /// Values of the keys.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// How the curve runs between its keys.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The value at a time. Before the first key and after the last one the curve
    /// is constant. `None` for a curve without keys.
    pub fn sample(&self, time: f32) -> Option<T> {
        let after = self.times.partition_point(|&key| key <= time);
        if after == 0 {
            return self.values.first().cloned();
        }
        let before = after - 1;
        let value = &self.values[before];
        let Some(next) = self.values.get(after) else {
            return Some(value.clone());
        };
        let length = self.times[after] - self.times[before];
        let t = (time - self.times[before]) / length;
        Some(match (&self.tangents, self.interpolation) {
            (Some(tangents), _) => {
                let [a, b, c, d] = hermite(t);
                T::weighted_sum(&[
                    (a, value),
                    (b * length, &tangents.after[before]),
                    (c, next),
                    (d * length, &tangents.before[after]),
                ])
                .settled()
            }
            (None, Interpolation::Step) => value.clone(),
            (None, _) => value.interpolate(next, t),
        })
    }
}

/// The cubic Hermite basis: weights of the first value, the slope there, the second value and the
/// slope there, at `t` from 0 to 1 (glTF 2.0 specification, appendix C.5).
fn hermite(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        2.0 * t3 - 3.0 * t2 + 1.0,
        t3 - 2.0 * t2 + t,
        3.0 * t2 - 2.0 * t3,
        t3 - t2,
    ]
}

impl<T: Interpolate> FieldType for Curve<T> {
    const TYPE: ValueType = ValueType::Map;
    fn to_value(&self) -> Value {
        let mut entries = vec![
            ("interpolation".to_owned(), self.interpolation.to_value()),
            ("times".to_owned(), self.times.to_value()),
            ("values".to_owned(), self.values.to_value()),
        ];
        if let Some(tangents) = &self.tangents {
            entries.push(("in_tangents".to_owned(), tangents.before.to_value()));
            entries.push(("out_tangents".to_owned(), tangents.after.to_value()));
        }
        Value::Map(entries)
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        let Value::Map(entries) = value else {
            return Err(mismatch("a curve", value));
        };
        let mut curve = Self::default();
        let mut tangents = [Vec::new(), Vec::new()];
        for (name, value) in entries {
            match name.as_str() {
                "interpolation" => curve.interpolation = FieldType::from_value(value)?,
                "times" => curve.times = FieldType::from_value(value)?,
                "values" => curve.values = FieldType::from_value(value)?,
                "in_tangents" => tangents[0] = FieldType::from_value(value)?,
                "out_tangents" => tangents[1] = FieldType::from_value(value)?,
                other => {
                    return Err(format!(
                        "a curve has interpolation, times, values, in_tangents and out_tangents, \
                         but no `{other}`"
                    ));
                }
            }
        }
        Self::checked(curve.times, curve.values, tangents, curve.interpolation)
    }
    fn heap_bytes(&self) -> usize {
        let tangents = self.tangents.as_ref().map_or(0, |tangents| {
            size_of::<Tangents<T>>() + tangents.before.heap_bytes() + tangents.after.heap_bytes()
        });
        self.times.heap_bytes() + self.values.heap_bytes() + tangents
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn curves_pass_through_their_keys() {
        let times = vec![1.0, 2.0, 4.0];
        let values = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 4.0, 0.0)];
        let curve = Curve::new(times.clone(), values.clone(), Interpolation::Linear).unwrap();
        for (time, value) in times.iter().zip(&values) {
            assert_eq!(curve.sample(*time), Some(*value));
        }
        assert_eq!(curve.sample(-1.0), Some(Vec3::ZERO));
        assert_eq!(curve.sample(9.0), Some(values[2]));
        assert_eq!(curve.sample(2.5), Some(Vec3::new(1.0, 1.0, 0.0)));
        let steps = Curve::new(times, values, Interpolation::Step).unwrap();
        assert_eq!(steps.sample(3.9), Some(Vec3::X));
        assert_eq!(Curve::<Vec3>::default().sample(0.0), None);
        assert_eq!(Curve::from_value(&steps.to_value()).unwrap(), steps);
    }

    #[test]
    fn rotations_turn_evenly() {
        let values = vec![Quat::IDENTITY, Quat::from_rotation_y(1.0)];
        let curve = Curve::new(vec![0.0, 1.0], values, Interpolation::Linear).unwrap();
        let quarter = curve.sample(0.25).unwrap();
        assert!(quarter.angle_between(Quat::from_rotation_y(0.25)) < 1e-3);
    }

    #[test]
    fn a_cubic_curve_is_the_cubic() {
        // p(t) = t³ − 2t + 1, with its own slopes, is given back exactly.
        let p = |t: f32| t * t * t - 2.0 * t + 1.0;
        let slope = |t: f32| 3.0 * t * t - 2.0;
        let times = vec![0.0, 0.5, 2.0];
        let at = |f: &dyn Fn(f32) -> f32| times.iter().map(|&t| f(t)).collect::<Vec<_>>();
        let curve = Curve::cubic(times.clone(), at(&p), at(&slope), at(&slope)).unwrap();
        for i in 0..=40 {
            let t = i as f32 * 0.05;
            assert!((curve.sample(t).unwrap() - p(t)).abs() < 1e-5, "at {t}");
        }
        assert_eq!(Curve::from_value(&curve.to_value()).unwrap(), curve);
    }

    #[test]
    fn cubic_rotations_stay_rotations() {
        let turns = [0.0, 1.0, 2.5, -1.0].map(Quat::from_rotation_y);
        // The negative is the same rotation, and must not send the curve the long way round.
        let values = vec![turns[0], -turns[1], turns[2], -turns[3]];
        let curve = Curve::smooth(vec![0.0, 1.0, 2.0, 4.0], values).unwrap();
        for i in 0..=40 {
            let found = curve.sample(i as f32 * 0.1).unwrap();
            assert!((found.length() - 1.0).abs() < 1e-5);
            assert!(found.x.abs() < 1e-6 && found.z.abs() < 1e-6);
        }
        assert!(curve.sample(1.0).unwrap().angle_between(turns[1]) < 1e-3);
        let halfway = curve.sample(0.5).unwrap();
        assert!(halfway.angle_between(Quat::from_rotation_y(0.4)) < 0.15);
    }

    #[test]
    fn a_smooth_curve_has_no_kinks() {
        let points = [0.0, 3.0, 1.0, 1.0, 4.0].map(|y| Vec3::new(0.0, y, 1.0));
        let times = vec![0.0, 0.5, 2.0, 2.5, 4.0];
        let curve = Curve::smooth(times.clone(), points.to_vec()).unwrap();
        let slope = |t: f32| (curve.sample(t + 1e-2).unwrap() - curve.sample(t).unwrap()) / 1e-2;
        for &key in &times[1..4] {
            let (before, after) = (slope(key - 1e-2), slope(key));
            assert!((before - after).length() < 0.5, "{before} {after} at {key}");
        }
        assert!(slope(0.0).length() < 0.5);
    }

    #[test]
    fn bad_curves_are_refused() {
        let error = Curve::cubic(vec![0.0], vec![0.0], vec![], vec![0.0]).unwrap_err();
        assert!(error.contains("needs 1 in tangents and has 0"), "{error}");
        let error = Curve::new(vec![0.0], vec![0.0], Interpolation::Cubic).unwrap_err();
        assert!(error.contains("tangents"), "{error}");
        let new = |times: &[f32]| {
            Curve::new(times.to_vec(), vec![0.0; 2], Interpolation::Linear).unwrap_err()
        };
        assert!(new(&[0.0]).contains("1 times has 2 values"));
        assert!(new(&[1.0, 1.0]).contains("key 1 at 1 s follows one at 1 s"));
        assert!(new(&[0.0, f32::NAN]).contains("key 1 is not a finite"));
    }
}
