//! How long a pipeline may be measured.

/// Two frames that differ by less than this share have the same time.
const SETTLED: f64 = 0.05;
/// How much longer than the last a frame may take and still keep to the limit.
const CAUTION: f64 = 1.05;
/// The share of a pipeline's time that a warm-up may be prolonged to.
const WARMING: f64 = 0.3;

/// The time that a pipeline may take in one process, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// No frame is begun that would end later, but for the first that is measured. No frame is drawn
    /// to warm up that would leave no time for one more.
    pub share: f64,
    /// The first frame that is measured is not begun if it would end later.
    pub most: f64,
    /// What a frame takes, where that is known before one is drawn.
    pub expected: Option<f64>,
}

impl Default for Allowance {
    fn default() -> Self {
        Self::of_one_process(f64::INFINITY)
    }
}

impl Allowance {
    /// For the only process: one frame is always measured.
    pub fn of_one_process(seconds: f64) -> Self {
        Self {
            share: seconds,
            most: f64::INFINITY,
            expected: None,
        }
    }

    /// What is left of `seconds` for a process after others: `spent` has the seconds and `frames` the
    /// times of the frames of each process before it, and `left` processes are to come, this one
    /// included. The first process measures one frame however long it takes: without one, a pipeline
    /// would have no time at all.
    pub fn after(seconds: f64, spent: &[f64], frames: &[f64], left: u32) -> Self {
        let rest = seconds - spent.iter().sum::<f64>();
        Self {
            share: rest / f64::from(left.max(1)),
            most: if spent.is_empty() {
                f64::INFINITY
            } else {
                rest
            },
            // The longest, so that the limit holds where times vary.
            expected: frames.iter().copied().reduce(f64::max),
        }
    }
}

/// The time that a pipeline has taken.
#[derive(Clone, Debug, Default)]
pub(super) struct Clock {
    allowance: Allowance,
    spent: f64,
    /// Of the newest frame.
    last: Option<f64>,
    /// Times of the frames of the warm-up.
    warming: Vec<f64>,
}

impl Clock {
    pub(super) fn new(allowance: Allowance) -> Self {
        Self {
            allowance,
            ..Self::default()
        }
    }

    /// Adds what was no frame.
    pub(super) fn add(&mut self, seconds: f64) {
        self.spent += seconds;
    }

    pub(super) fn add_frame(&mut self, seconds: f64) {
        self.add(seconds);
        self.last = Some(seconds);
    }

    pub(super) fn add_warming(&mut self, seconds: f64) {
        self.add_frame(seconds);
        self.warming.push(seconds);
    }

    pub(super) fn spent(&self) -> f64 {
        self.spent
    }

    pub(super) fn warming_frames(&self) -> u32 {
        self.warming.len() as u32
    }

    pub(super) fn is_warm(&self) -> bool {
        !self.warming.is_empty()
    }

    /// What the next frame will take, as far as can be known.
    fn next(&self) -> f64 {
        CAUTION * self.last.or(self.allowance.expected).unwrap_or(0.0)
    }

    /// Whether the last two frames took the same time.
    fn has_settled(&self) -> bool {
        matches!(self.warming[..], [.., a, b] if (a - b).abs() <= SETTLED * a.min(b))
    }

    /// Whether one more frame may be drawn that is not measured: one that was `asked` for, or one until
    /// times settle.
    pub(super) fn allows_warming(&self, asked: bool) -> bool {
        let share = self.allowance.share;
        if asked {
            self.spent + 2.0 * self.next() <= share
        } else {
            !self.has_settled() && self.spent + self.next() < WARMING * share
        }
    }

    pub(super) fn allows_first(&self) -> bool {
        self.spent + self.next() <= self.allowance.most
    }

    pub(super) fn allows_another(&self) -> bool {
        self.spent + self.next() <= self.allowance.share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames that are drawn to warm up and measured in each of five processes, where a frame takes
    /// `frame` seconds, and the seconds that this takes.
    fn five_processes(frame: f64, asked: u32, wanted: u32) -> ([(u32, u32); 5], f64) {
        let (mut spent, mut times) = (Vec::new(), Vec::new());
        let found = [0, 1, 2, 3, 4].map(|process| {
            let allowance = Allowance::after(5.0, &spent, &times, 5 - process);
            let mut clock = Clock::new(allowance);
            for round in 0..asked + 6 {
                if clock.allows_warming(round < asked) {
                    clock.add_warming(frame);
                }
            }
            let mut measured = 0;
            while measured < wanted
                && match measured {
                    0 => clock.allows_first(),
                    _ => clock.allows_another(),
                }
            {
                clock.add_frame(frame);
                measured += 1;
            }
            spent.push(clock.spent());
            times.extend((measured > 0).then_some(frame));
            (clock.warming_frames(), measured)
        });
        (found, spent.iter().sum())
    }

    #[test]
    fn quick_pipelines_measure_all_that_is_asked_for() {
        let (found, spent) = five_processes(0.01, 1, 20);
        assert_eq!(found, [(2, 20); 5]);
        assert!((spent - 1.1).abs() < 1e-9, "{spent}");
    }

    #[test]
    fn slow_ones_measure_a_frame_in_each_process_as_long_as_there_is_time() {
        // The first does not know how long a frame takes, and warms up with a whole one. So does the last,
        // to which the others have left enough.
        let (found, spent) = five_processes(0.68, 1, 20);
        assert_eq!(found, [(1, 1), (0, 1), (0, 1), (0, 1), (1, 1)]);
        assert!(spent <= 5.0, "{spent}");
        let (found, spent) = five_processes(1.4, 1, 20);
        assert_eq!(found, [(1, 1), (0, 1), (0, 0), (0, 0), (0, 0)]);
        assert!(spent <= 5.0, "{spent}");
    }

    #[test]
    fn times_in_between_never_take_longer_than_allowed() {
        for hundredths in 1..=250 {
            let frame = f64::from(hundredths) / 100.0;
            let (found, spent) = five_processes(frame, 1, 20);
            assert!(spent <= 5.0 + 1e-9, "{frame}: {spent} {found:?}");
            assert!(found[0].1 >= 1);
        }
    }

    #[test]
    fn the_first_process_measures_one_frame_however_long_it_takes() {
        let (found, _) = five_processes(30.0, 1, 20);
        assert_eq!(found, [(1, 1), (0, 0), (0, 0), (0, 0), (0, 0)]);
    }

    #[test]
    fn one_process_alone_always_measures_a_frame() {
        let mut clock = Clock::new(Allowance::of_one_process(1.0));
        assert!(clock.allows_warming(true));
        clock.add_warming(3.0);
        assert!(!clock.allows_warming(true) && !clock.allows_warming(false));
        assert!(clock.allows_first());
        clock.add_frame(3.0);
        assert!(!clock.allows_another());
    }

    #[test]
    fn a_warm_up_ends_when_two_frames_agree() {
        let mut clock = Clock::new(Allowance::of_one_process(100.0));
        for (frame, more) in [(2.0, true), (1.0, true), (1.04, false)] {
            clock.add_warming(frame);
            assert_eq!(clock.allows_warming(false), more, "{frame}");
        }
    }
}
