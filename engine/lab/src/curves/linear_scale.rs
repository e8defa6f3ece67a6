//! Even axes.

/// An axis on which equal differences have the same length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearScale {
    low: f64,
    high: f64,
    /// Where `low` and `high` lie in the picture.
    from: f64,
    to: f64,
}

/// Ticks that an axis has at most.
const MOST_TICKS: f64 = 9.0;

impl LinearScale {
    /// An axis that holds all values with a little room at both ends, and 0 where that is near; it
    /// reaches from `from` to `to` in the picture.
    pub fn holding(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let values = values.filter(|value| value.is_finite());
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        // Nothing to hold, or a single value: one unit around it.
        let (low, high) = match low.is_finite() {
            true if low < high => (low, high),
            true => (low - 0.5, high + 0.5),
            false => (0.0, 1.0),
        };
        let room = 0.04 * (high - low);
        let near_zero = low >= 0.0 && low < 0.5 * high;
        Self {
            low: if near_zero { 0.0 } else { low - room },
            high: high + room,
            from,
            to,
        }
    }

    /// Where a value lies; those beyond an end lie at the end.
    pub fn at(&self, value: f64) -> f64 {
        let share = (value - self.low) / (self.high - self.low);
        self.from + (self.to - self.from) * share.clamp(0.0, 1.0)
    }

    /// Round values on the axis, all of them labelled: multiples of 1, 2 or 5 times a power of ten.
    pub fn ticks(&self) -> Vec<(f64, bool)> {
        let span = self.high - self.low;
        let power = 10.0_f64.powf((span / MOST_TICKS).log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
        let fits = |step: &&f64| span / **step <= MOST_TICKS;
        let step = steps.iter().find(fits).copied().unwrap_or(span);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last)
            .map(|count| (count as f64 * step, true))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_steps_have_equal_lengths_and_round_ticks() {
        let scale = LinearScale::holding([3.0, 50.0].into_iter(), 0.0, 100.0);
        let step = scale.at(20.0) - scale.at(10.0);
        assert!((scale.at(40.0) - scale.at(30.0) - step).abs() < 1e-9);
        assert_eq!(scale.at(0.0), 0.0, "0 is near");
        let ticks: Vec<f64> = scale.ticks().into_iter().map(|tick| tick.0).collect();
        assert_eq!(ticks, [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]);
        let far = LinearScale::holding([1000.0, 1001.0].into_iter(), 0.0, 100.0);
        assert!(far.at(1000.0) > 0.0, "0 is far");
    }

    #[test]
    fn it_holds_whatever_it_is_given() {
        for values in [vec![], vec![f64::NAN], vec![7.0], vec![-1e9, 1e9]] {
            let scale = LinearScale::holding(values.iter().copied(), 10.0, 20.0);
            assert!(scale.ticks().len() <= 10);
            for value in values.into_iter().filter(|value| value.is_finite()) {
                assert!((10.0..=20.0).contains(&scale.at(value)), "{value}");
            }
        }
    }
}
