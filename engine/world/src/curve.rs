//! Keyframed curves.

use glam::{Quat, Vec3};

use crate::value::{FieldType, Value, ValueType, choice, mismatch};

choice! {
    /// How a curve runs between two keys.
    Interpolation {
        /// Keeps the value of the earlier key.
        Step = "step",
        /// Goes evenly from key to key; rotations turn at an even speed.
        Linear = "linear",
    }
}

/// A type that a curve can run through.
pub trait Interpolate: FieldType + PartialEq + std::fmt::Debug {
    /// The value at `t` from 0 to 1 on the way to `other`.
    fn interpolate(&self, other: &Self, t: f32) -> Self;
}

impl Interpolate for f32 {
    fn interpolate(&self, other: &Self, t: f32) -> Self {
        self + (other - self) * t
    }
}

impl Interpolate for Vec3 {
    fn interpolate(&self, other: &Self, t: f32) -> Self {
        self.lerp(*other, t)
    }
}

impl Interpolate for Quat {
    fn interpolate(&self, other: &Self, t: f32) -> Self {
        self.slerp(*other, t)
    }
}

/// Values at ascending times.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<T> {
    times: Vec<f32>,
    values: Vec<T>,
    interpolation: Interpolation,
}

impl<T> Default for Curve<T> {
    fn default() -> Self {
        Self {
            times: Vec::new(),
            values: Vec::new(),
            interpolation: Interpolation::Linear,
        }
    }
}

impl<T: Interpolate> Curve<T> {
    /// A curve through these values at these times in seconds.
    ///
    /// # Errors
    /// The lists differ in length, or the times are not ascending numbers.
    pub fn new(
        times: Vec<f32>,
        values: Vec<T>,
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
        Ok(Self {
            times,
            values,
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

    /// The value at a time. Before the first key and after the last one the curve
    /// is constant. `None` for a curve without keys.
    pub fn sample(&self, time: f32) -> Option<T> {
        let after = self.times.partition_point(|&key| key <= time);
        if after == 0 {
            return self.values.first().cloned();
        }
        let before = after - 1;
        let (Some(next), Interpolation::Linear) = (self.values.get(after), self.interpolation)
        else {
            return self.values.get(before).cloned();
        };
        let t = (time - self.times[before]) / (self.times[after] - self.times[before]);
        Some(self.values[before].interpolate(next, t))
    }
}

impl<T: Interpolate> FieldType for Curve<T> {
    const TYPE: ValueType = ValueType::Map;
    fn to_value(&self) -> Value {
        Value::Map(vec![
            ("interpolation".to_owned(), self.interpolation.to_value()),
            ("times".to_owned(), self.times.to_value()),
            ("values".to_owned(), self.values.to_value()),
        ])
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        let Value::Map(entries) = value else {
            return Err(mismatch("a curve", value));
        };
        let mut curve = (Interpolation::Linear, Vec::new(), Vec::new());
        for (name, value) in entries {
            match name.as_str() {
                "interpolation" => curve.0 = FieldType::from_value(value)?,
                "times" => curve.1 = FieldType::from_value(value)?,
                "values" => curve.2 = FieldType::from_value(value)?,
                other => {
                    return Err(format!(
                        "a curve has interpolation, times and values, but no `{other}`"
                    ));
                }
            }
        }
        Self::new(curve.1, curve.2, curve.0)
    }
    fn heap_bytes(&self) -> usize {
        self.times.heap_bytes() + self.values.heap_bytes()
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
    fn bad_curves_are_refused() {
        let new = |times: &[f32]| {
            Curve::new(times.to_vec(), vec![0.0; 2], Interpolation::Linear).unwrap_err()
        };
        assert!(new(&[0.0]).contains("1 times has 2 values"));
        assert!(new(&[1.0, 1.0]).contains("key 1 at 1 s follows one at 1 s"));
        assert!(new(&[0.0, f32::NAN]).contains("key 1 is not a finite"));
    }
}
