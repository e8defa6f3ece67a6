//! Settings of the comparison and of time: noted where they differ from those that were known.

use super::super::Workbench;
use super::super::comparing::Mode;
use super::{Change, Content, Target};
use crate::ui::messages::{message, text};

/// Settings of the comparison and of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dials {
    /// What is shown of both pictures.
    pub mode: Mode,
    /// Where the line between them is.
    pub split: f32,
    /// Whether one of them follows the other by itself.
    pub automatic: bool,
    /// How often then.
    pub rate: f32,
    /// What a difference is multiplied with.
    pub gain: f32,
    /// Whether a difference is in false colours.
    pub false_colors: bool,
    /// How much the map of FLIP covers.
    pub opacity: f32,
    /// Scene seconds in a second.
    pub speed: f64,
    /// Fixed steps of the scene in one of its seconds.
    pub steps: Option<u32>,
}

impl Dials {
    /// The message that names the first setting that differs.
    fn difference(&self, other: &Self) -> Option<&'static str> {
        let all = [
            (self.mode != other.mode, message!("history.shown_as")),
            (self.split != other.split, message!("history.split")),
            (
                self.automatic != other.automatic || self.rate != other.rate,
                message!("history.flicker"),
            ),
            (self.gain != other.gain, message!("history.gain")),
            (
                self.false_colors != other.false_colors,
                message!("history.false_colors"),
            ),
            (self.opacity != other.opacity, message!("history.opacity")),
            (self.speed != other.speed, message!("history.speed")),
            (self.steps != other.steps, message!("history.steps")),
        ];
        let mut all = all.into_iter();
        all.find_map(|(differs, key)| differs.then_some(key))
    }
}

impl Workbench {
    pub(in crate::ui::workbench) fn dials(&self) -> Dials {
        let comparing = &self.comparing;
        let flicker = comparing.flicker;
        Dials {
            mode: comparing.mode,
            split: comparing.split,
            automatic: flicker.automatic,
            rate: flicker.rate,
            gain: comparing.gain,
            false_colors: comparing.false_colors,
            opacity: comparing.opacity,
            speed: self.clock.speed,
            steps: self.clock.rate,
        }
    }

    pub(in crate::ui::workbench) fn set_dials(&mut self, dials: Dials) {
        let comparing = &mut self.comparing;
        comparing.mode = dials.mode;
        comparing.split = dials.split;
        comparing.flicker.automatic = dials.automatic;
        comparing.flicker.rate = dials.rate;
        comparing.gain = dials.gain;
        comparing.false_colors = dials.false_colors;
        comparing.opacity = dials.opacity;
        self.clock.speed = dials.speed;
        self.clock.rate = dials.steps;
        self.canvas.invalidate();
    }

    /// Takes note of settings that panels, keys and the mouse have changed.
    pub fn note_dials(&mut self) {
        let now = self.dials();
        let Some(before) = self.undo.dials.replace(now) else {
            return;
        };
        let Some(key) = before.difference(&now) else {
            return;
        };
        let change = Change {
            target: Target::Dials(key),
            before: Some(Content::Dials(before)),
            after: Some(Content::Dials(now)),
        };
        self.undo.note(text(key).to_owned(), vec![change]);
    }
}
