//! How the values of the target that is looked at spread, and a range that follows them.

use std::time::{Duration, Instant};

use lightbench::render::inspect::{Inspection, Measured};

use super::Workbench;

/// How long a measurement of a moving picture holds: often enough to follow.
const REFRESH: Duration = Duration::from_millis(150);

/// What is measured, and what was.
#[derive(Debug, Default)]
pub struct Measuring {
    /// Whether the range goes from the least to the greatest value.
    pub automatic: bool,
    /// The last measurement.
    pub last: Option<Measured>,
    /// What was asked for last, and the number of the frame in which it was to be measured.
    asked: Option<(Inspection, u32)>,
    asked_at: Option<Instant>,
    waiting: bool,
}

impl Measuring {
    /// Whether an answer is on its way.
    pub fn is_waiting(&self) -> bool {
        self.waiting
    }
}

impl Workbench {
    /// Keeps the measurement of what is looked at up to date; to be called while somebody sees it.
    pub fn measure(&mut self, now: Instant) {
        self.follow_range();
        let Some(request) = self.inspection() else {
            return;
        };
        let next = self.renderer.next_frame();
        let same = |(asked, _): &&(Inspection, u32)| *asked == request;
        let known = self.measuring.asked.as_ref().filter(same);
        let due = match known {
            None => true,
            // Other frames were drawn since.
            Some((_, frame)) => {
                let held = self.measuring.asked_at.is_some_and(|at| now - at < REFRESH);
                !held && !self.measuring.waiting && next > frame + 1
            }
        };
        if due {
            self.renderer
                .inspector()
                .measure(&self.files, request.clone());
            self.measuring.asked = Some((request, next));
            self.measuring.asked_at = Some(now);
            self.measuring.waiting = true;
            self.canvas.repeat();
        }
    }

    /// Takes in an answer.
    pub(super) fn take_measured(&mut self) {
        let inspector = self.renderer.inspector();
        let Some(measured) = inspector.take_measured() else {
            self.measuring.waiting &= inspector.is_measuring();
            return;
        };
        self.measuring.waiting = inspector.is_measuring();
        if self.measuring.waiting {
            // Something else was asked for meanwhile.
            self.canvas.repeat();
        }
        self.measuring.last = Some(measured);
        self.follow_range();
    }

    /// Has the range go from the least to the greatest value, where it shall.
    fn follow_range(&mut self) {
        if !self.measuring.automatic {
            return;
        }
        let Some(range) = self.measured().and_then(Measured::range) else {
            return;
        };
        let [low, high] = with_room(range);
        let request = self.inspection();
        if let Some(request) = request.filter(|now| (now.low, now.high) != (low, high)) {
            self.inspect(Some(Inspection {
                low,
                high,
                ..request
            }));
        }
    }

    /// The measurement of what is looked at; none while it is of something else.
    pub fn measured(&mut self) -> Option<&Measured> {
        let now = self.inspection()?;
        let last = self.measuring.last.as_ref();
        last.filter(|measured| is_same_part(&now, &measured.request))
    }
}

/// Whether two look at the same numbers, in whatever colours and over whatever range.
fn is_same_part(a: &Inspection, b: &Inspection) -> bool {
    let part = |of: &Inspection| (of.pass, of.slice, of.sample, of.aspect, of.channels);
    part(a) == part(b) && a.target == b.target
}

/// A range that is not empty.
fn with_room([low, high]: [f32; 2]) -> [f32; 2] {
    if high > low {
        return [low, high];
    }
    let room = (low.abs() * 0.01).max(1e-3);
    [low - room, high + room]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_of_a_single_value_has_room() {
        assert_eq!(with_room([0.0, 2.0]), [0.0, 2.0]);
        assert_eq!(with_room([0.0, 0.0]), [-1e-3, 1e-3]);
        assert_eq!(with_room([100.0, 100.0]), [99.0, 101.0]);
        assert_eq!(with_room([-100.0, -100.0]), [-101.0, -99.0]);
    }
}
