//! The scene's time: playing, paused, stepped.

use std::time::Duration;

/// Seconds that one step advances where no other step is chosen.
pub const STEP: f64 = 1.0 / 60.0;

/// The slowest and the fastest that time may run.
pub const SPEEDS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// Steps that may be chosen, in their number a second.
pub const RATES: [u32; 4] = [30, 60, 120, 240];

/// Fixed steps that one frame may catch up with. What is more is lost, as where the program paused.
const MOST_STEPS: usize = 32;

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
    /// Steps of the scene in one of its seconds; without it each frame makes one step, as long as the
    /// frame took.
    pub rate: Option<u32>,
    /// Scene seconds that have passed and are not stepped yet, since they are less than a fixed step.
    rest: f64,
    /// Fixed steps that are due.
    due: usize,
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
            rate: None,
            rest: 0.0,
            due: 0,
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
        self.rest = 0.0;
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
        match self.rate {
            Some(_) => self.due += 1,
            None => self.pending += STEP,
        }
    }

    /// The same moment, with no time that is to pass.
    pub fn held(self) -> Self {
        Self {
            playing: false,
            pending: 0.0,
            rest: 0.0,
            due: 0,
            ..self
        }
    }

    /// Makes the scene see the present time again, as after it was loaded anew.
    pub fn refresh(&mut self) {
        self.unseen = true;
    }

    /// Lets `elapsed` real time pass. Returns the scene's next step in seconds, or `None` where the
    /// scene has nothing new to see. With a fixed step several may be due: [`Clock::next_step`].
    pub fn advance(&mut self, elapsed: Duration) -> Option<f64> {
        let mut step = std::mem::take(&mut self.pending);
        let passed = match self.playing {
            true => elapsed.as_secs_f64().min(MAX_STEP) * self.speed,
            false => 0.0,
        };
        match self.rate {
            None => step += passed,
            Some(rate) => {
                self.rest += passed * f64::from(rate.max(1));
                // A share of a step too little is rounding.
                let whole = (self.rest + 1e-9).floor().max(0.0);
                self.rest = (self.rest - whole).max(0.0);
                self.due = (self.due + whole as usize).min(MOST_STEPS);
                if step == 0.0 && self.due > 0 {
                    return self.next_step();
                }
            }
        }
        let unseen = std::mem::take(&mut self.unseen);
        self.time += step;
        (step > 0.0 || unseen).then_some(step)
    }

    /// The next fixed step that is due in the same frame, in seconds.
    pub fn next_step(&mut self) -> Option<f64> {
        let Some(rate) = self.rate else {
            self.due = 0;
            return None;
        };
        self.due = self.due.checked_sub(1)?;
        self.unseen = false;
        let step = 1.0 / f64::from(rate.max(1));
        self.time += step;
        Some(step)
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

    #[test]
    fn fixed_steps_are_all_alike_and_none_is_lost_or_added() {
        let mut clock = Clock {
            playing: true,
            rate: Some(60),
            speed: 2.0,
            ..Clock::default()
        };
        let mut steps = Vec::new();
        // 25 frames of 20 ms at twice the speed are one second of the scene.
        for _ in 0..25 {
            let first = clock.advance(Duration::from_millis(20));
            steps.extend(first.filter(|step| *step > 0.0));
            while let Some(step) = clock.next_step() {
                steps.push(step);
            }
        }
        assert_eq!(steps, [1.0 / 60.0; 60]);
        assert!((clock.time() - 1.0).abs() < 1e-12);
        // Held, a step is one of the chosen length.
        clock.playing = false;
        clock.rate = Some(240);
        clock.step();
        assert_eq!(clock.advance(Duration::from_millis(20)), Some(1.0 / 240.0));
        assert_eq!(clock.next_step(), None);
        assert_eq!(clock.advance(Duration::from_millis(20)), None);
        // A pause of the program is not caught up with.
        clock.playing = true;
        clock.speed = 10.0;
        clock.advance(Duration::from_secs(60));
        let mut count = 1;
        while clock.next_step().is_some() {
            count += 1;
        }
        assert_eq!(count, MOST_STEPS);
    }
}
