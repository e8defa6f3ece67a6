//! The scene's time: playing, paused, stepped.

use std::time::Duration;

/// Seconds that one step advances.
pub const STEP: f64 = 1.0 / 60.0;

/// The longest step that a slow frame may cause, in seconds. Without it a pause of the program
/// would throw moving things far.
const MAX_STEP: f64 = 0.1;

/// Time of a scene in seconds since it began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    time: f64,
    /// Whether time runs by itself.
    pub playing: bool,
    /// Scene seconds in a second.
    pub speed: f64,
    /// What the next [`Clock::advance`] adds although the clock is paused.
    pending: f64,
    /// Whether time changed in a way that the scene has not seen yet.
    unseen: bool,
}

impl Default for Clock {
    fn default() -> Self {
        Self {
            time: 0.0,
            playing: false,
            speed: 1.0,
            pending: 0.0,
            unseen: true,
        }
    }
}

impl Clock {
    /// Seconds since the scene began.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Back to the beginning.
    pub fn rewind(&mut self) {
        self.time = 0.0;
        self.unseen = true;
    }

    /// The scene has been brought to a moment.
    pub fn set(&mut self, time: f64) {
        self.time = time;
        self.pending = 0.0;
        self.unseen = false;
    }

    /// One step further, also while paused.
    pub fn step(&mut self) {
        self.pending += STEP;
    }

    /// The same moment, with no time that is to pass.
    pub fn held(self) -> Self {
        Self {
            playing: false,
            pending: 0.0,
            ..self
        }
    }

    /// Makes the scene see the present time again, as after it was loaded anew.
    pub fn refresh(&mut self) {
        self.unseen = true;
    }

    /// Lets `elapsed` real time pass. Returns the scene's step in seconds, or `None` where the
    /// scene has nothing new to see.
    pub fn advance(&mut self, elapsed: Duration) -> Option<f64> {
        let mut step = std::mem::take(&mut self.pending);
        if self.playing {
            step += elapsed.as_secs_f64().min(MAX_STEP) * self.speed;
        }
        let unseen = std::mem::take(&mut self.unseen);
        self.time += step;
        (step > 0.0 || unseen).then_some(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paused_clock_moves_only_by_steps() {
        let mut clock = Clock::default();
        let frame = Duration::from_millis(20);
        assert_eq!(
            clock.advance(frame),
            Some(0.0),
            "the beginning is seen once"
        );
        assert_eq!(clock.advance(frame), None);
        clock.step();
        clock.step();
        assert_eq!(clock.advance(frame), Some(2.0 * STEP));
        assert_eq!(clock.advance(frame), None);
    }

    #[test]
    fn a_held_clock_stays_where_it_is() {
        let mut clock = Clock {
            playing: true,
            ..Clock::default()
        };
        clock.step();
        let mut held = clock.held();
        assert_eq!(held.advance(Duration::from_millis(20)), Some(0.0));
        assert_eq!(held.advance(Duration::from_millis(20)), None);
        assert_eq!(held.time(), 0.0);
    }

    #[test]
    fn a_playing_clock_keeps_its_speed_and_survives_pauses_of_the_program() {
        let mut clock = Clock {
            playing: true,
            speed: 0.5,
            ..Clock::default()
        };
        assert_eq!(clock.advance(Duration::from_millis(20)), Some(0.01));
        assert_eq!(clock.advance(Duration::from_secs(60)), Some(0.05));
        clock.rewind();
        assert_eq!(clock.time(), 0.0);
    }
}
