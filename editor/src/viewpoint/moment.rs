//! The way to a moment of a scene: the steps by which both the editor and the command line get there.

use lightbench::assets::{Cancelled, Progress};
use lightbench::lab::capture::STEP;
use lightbench::render::Problem;
use lightbench::script::Scene;

/// Parts of a second that are no step of their own: what sums of steps lose.
const NOTHING: f64 = 1e-9;

/// The steps from the beginning of time to a moment. Each is a moment and the seconds to it from the one
/// before: first the beginning itself, then sixtieths of a second, then what is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    now: Option<f64>,
    end: f64,
}

impl Steps {
    /// The way to `end`, seconds.
    pub fn to(end: f64) -> Self {
        Self { now: None, end }
    }

    /// The share of the way that is behind, 0 to 1.
    pub fn share(&self) -> f32 {
        let now = self.now.unwrap_or(0.0);
        (now / self.end.max(STEP)).clamp(0.0, 1.0) as f32
    }
}

impl Iterator for Steps {
    type Item = (f64, f64);

    fn next(&mut self) -> Option<(f64, f64)> {
        let Some(now) = self.now else {
            self.now = Some(0.0);
            return Some((0.0, 0.0));
        };
        let left = self.end - now;
        let step = if left >= STEP - NOTHING { STEP } else { left };
        if step <= NOTHING {
            return None;
        }
        self.now = Some(now + step);
        Some((now + step, step))
    }
}

/// Why a scene did not get to a moment.
#[derive(Debug, thiserror::Error)]
pub enum WayError {
    /// Its script failed.
    #[error("{0}")]
    Script(Problem),
    /// It was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Moves a scene that was just loaded to a moment, and gives the time that it then has.
///
/// # Errors
/// A mistake of its script, or somebody who stopped it.
pub fn go(scene: &mut Scene, time: f64, progress: &Progress) -> Result<f64, WayError> {
    let mut steps = Steps::to(time);
    let mut reached = 0.0;
    while let Some((now, step)) = steps.next() {
        progress.report(steps.share())?;
        scene.update(now, step).map_err(WayError::Script)?;
        reached = now;
    }
    Ok(reached)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_those_of_a_clock_that_is_stepped() {
        let mut clock = 0.0;
        for _ in 0..1000 {
            clock += STEP;
        }
        let all: Vec<(f64, f64)> = Steps::to(clock).collect();
        assert_eq!(all.len(), 1001);
        assert_eq!(all.first(), Some(&(0.0, 0.0)));
        assert_eq!(all.last(), Some(&(clock, STEP)));
        let all: Vec<(f64, f64)> = Steps::to(0.02).collect();
        assert_eq!(all.len(), 3);
        assert!((all[2].0 - 0.02).abs() < 1e-12 && all[2].1 < STEP);
        assert_eq!(Steps::to(0.0).count(), 1);
    }
}
