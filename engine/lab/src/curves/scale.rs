//! Logarithmic axes.

/// An axis on which each factor of ten has the same length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogScale {
    low: f64,
    high: f64,
    /// Where `low` and `high` lie in the picture.
    from: f64,
    to: f64,
}

impl LogScale {
    /// An axis that holds all positive values with a little room at both ends; it reaches from `from`
    /// to `to` in the picture.
    pub fn holding(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let positive = values.filter(|value| value.is_finite() && *value > 0.0);
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        // Nothing to hold, or a single value: a decade around it.
        let (low, high) = match low.is_finite() {
            true if low < high => (low, high),
            true => (low / 3.0, high * 3.0),
            false => (1.0, 10.0),
        };
        let room = (high / low).powf(0.04);
        Self {
            low: low / room,
            high: high * room,
            from,
            to,
        }
    }

    /// Where a value lies; those beyond an end lie at the end.
    pub fn at(&self, value: f64) -> f64 {
        let share = (value.max(f64::MIN_POSITIVE) / self.low).ln() / (self.high / self.low).ln();
        self.from + (self.to - self.from) * share.clamp(0.0, 1.0)
    }

    /// Round values on the axis, each with whether it should be labelled: the powers of ten, where these
    /// are few 2 and 5 times them, within one factor of ten all whole multiples, and within a factor of
    /// two also what lies between those.
    pub fn ticks(&self) -> Vec<(f64, bool)> {
        let (first, last) = (
            self.low.log10().floor() as i32,
            self.high.log10().ceil() as i32,
        );
        let decades = (self.high / self.low).log10();
        let mut ticks = Vec::new();
        for power in first..=last {
            for tenths in 10..100 {
                let value = f64::from(tenths) * 10.0_f64.powi(power - 1);
                let whole = tenths % 10 == 0;
                if !(self.low..=self.high).contains(&value) || !whole && decades >= 0.3 {
                    continue;
                }
                let labelled = match tenths {
                    10 => true,
                    _ if decades < 0.1 => true,
                    _ if decades < 0.3 => tenths % 5 == 0,
                    20 | 50 => decades < 2.5,
                    _ => decades < 1.0,
                };
                ticks.push((value, labelled));
            }
        }
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_have_equal_lengths() {
        let scale = LogScale::holding([1.0, 1000.0].into_iter(), 0.0, 300.0);
        let step = scale.at(10.0) - scale.at(1.0);
        assert!((scale.at(100.0) - scale.at(10.0) - step).abs() < 1e-9);
        assert!((scale.at(8.0) - scale.at(4.0) - step * 2.0_f64.log10()).abs() < 1e-9);
        // A decade is a third of three decades and twice 4 % of them.
        assert!((step - 300.0 / (3.0 * 1.08)).abs() < 1e-9, "{step}");
    }

    #[test]
    fn it_holds_whatever_it_is_given() {
        for values in [
            vec![],
            vec![0.0, -1.0, f64::NAN],
            vec![7.0],
            vec![1e-9, 1e9],
        ] {
            let scale = LogScale::holding(values.iter().copied(), 10.0, 20.0);
            for value in values.into_iter().chain([0.0, 1.0]) {
                assert!((10.0..=20.0).contains(&scale.at(value)), "{value}");
            }
        }
    }

    #[test]
    fn ticks_are_powers_of_ten_and_what_lies_between() {
        let labels = |low: f64, high: f64| -> Vec<f64> {
            let scale = LogScale::holding([low, high].into_iter(), 0.0, 1.0);
            let ticks = scale.ticks().into_iter();
            ticks.filter(|tick| tick.1).map(|tick| tick.0).collect()
        };
        assert_eq!(labels(4.0, 120.0), [5.0, 10.0, 20.0, 50.0, 100.0]);
        assert_eq!(labels(1.0, 5000.0), [1.0, 10.0, 100.0, 1000.0]);
        // However narrow the range, an axis has more than one label.
        let near = |found: Vec<f64>, expected: &[f64]| {
            let pairs = found.iter().zip(expected);
            assert_eq!(found.len(), expected.len(), "{found:?}");
            assert!(
                pairs.clone().all(|(a, b)| (a - b).abs() < 1e-9),
                "{found:?}"
            );
        };
        near(labels(11.0, 42.0), &[20.0, 30.0, 40.0]);
        near(labels(2.1, 3.3), &[2.5, 3.0]);
        near(labels(0.21, 0.23), &[0.21, 0.22, 0.23]);
    }
}
