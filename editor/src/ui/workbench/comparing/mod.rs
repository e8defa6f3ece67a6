//! Two pipelines on the same scene, camera and time: A, which the editor shows anyway, and B beside it.
//!
//! B has visited pipelines and settings of its own, so that one pipeline can be compared with itself
//! under other settings. Both stay warm, and a mistake in one leaves the other. While nothing is
//! compared, none of this holds anything on the device.

mod choosing;
mod drawing;
mod judging;
mod numbers;
mod side;

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use lightbench::render::inspect::{Combination, Combiner};
use lightbench::render::queries::Measured;
use lightbench::render::{Problem, Problems, View};

use self::judging::Judge;
use self::side::Side;
use super::Workbench;
use super::pipelines::News;
use super::viewports::Viewport;
use crate::ui::messages::say;

pub use self::judging::{Judged, Judgement};
pub use self::numbers::{Cost, Costs};

/// What the viewport shows of both pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// A at the left of a line, B at its right.
    #[default]
    Split,
    /// One after the other in the same place.
    Flicker,
    /// The absolute difference.
    Difference,
    /// FLIP of each pixel over the picture.
    Flip,
}

impl Mode {
    /// All, in the order of menus.
    pub const ALL: [Self; 4] = [Self::Split, Self::Flicker, Self::Difference, Self::Flip];

    /// The words for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Split => say!("comparing.split"),
            Self::Flicker => say!("comparing.flicker"),
            Self::Difference => say!("comparing.difference"),
            Self::Flip => say!("comparing.flip"),
        }
    }
}

/// Changes of the picture a second at most, while they go on by themselves. Three flashes a second, which
/// are six changes, can bring on seizures (WCAG 2.2, criterion 2.3.1); this is half of that.
pub const FASTEST: f32 = 3.0;

/// Changes between both pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flicker {
    /// Whether B is shown now.
    pub shows_b: bool,
    /// Whether it changes by itself.
    pub automatic: bool,
    /// Changes a second then.
    pub rate: f32,
    changed_at: Option<Instant>,
}

impl Default for Flicker {
    fn default() -> Self {
        Self {
            shows_b: false,
            automatic: false,
            rate: 1.0,
            changed_at: None,
        }
    }
}

impl Flicker {
    fn pause(&self) -> Duration {
        Duration::from_secs_f32(1.0 / self.rate.clamp(0.1, FASTEST))
    }

    /// Shows the other picture.
    pub fn change(&mut self) {
        self.shows_b = !self.shows_b;
        self.changed_at = None;
    }

    /// Changes by itself where it is time to. Returns how long it is until the next change.
    fn advance(&mut self, now: Instant) -> Option<Duration> {
        if !self.automatic {
            self.changed_at = None;
            return None;
        }
        let at = *self.changed_at.get_or_insert(now);
        if now - at >= self.pause() {
            self.shows_b = !self.shows_b;
            self.changed_at = Some(now);
            return Some(self.pause());
        }
        Some(self.pause() - (now - at))
    }
}

/// The state of the comparison.
pub struct Comparing {
    is_on: bool,
    /// What is shown.
    pub mode: Mode,
    /// The share of the picture at the left of the line, 0 to 1.
    pub split: f32,
    /// Which picture is shown, and for how long.
    pub flicker: Flicker,
    /// What a difference is multiplied with.
    pub gain: f32,
    /// Whether a difference is shown in false colours.
    pub false_colors: bool,
    /// How much the map of FLIP covers of the picture, 0 to 1.
    pub opacity: f32,
    side: Option<Side>,
    combiner: Option<Combiner>,
    /// What the viewport shows.
    shown: Option<wgpu::Texture>,
    /// From what that was made.
    made_from: Option<Made>,
    judge: Judge,
    /// How many pairs of pictures were drawn.
    pairs: u64,
    /// The moment that A has drawn and B has not.
    waiting: Option<Waiting>,
    /// Pairs of the same moment that are to be drawn yet.
    more: u32,
    /// Whether both pictures of the last pair show the same moment.
    is_whole: bool,
    /// The frames of B that were submitted and not yet measured.
    frames: VecDeque<u32>,
    problem: Option<Problem>,
}

/// A moment that B is to draw. The scene stands still until then.
///
/// A software driver does one frame after another, and who submits the next one waits for it, with all
/// widgets. So B is drawn once the device is done with A, and its times are its own.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    view: View,
    size: (u32, u32),
    /// What shaders see as `frame_index`.
    index: u32,
    /// Whether A has drawn it.
    is_whole: bool,
}

/// What a combined picture was made from.
#[derive(Clone, Debug, PartialEq)]
struct Made {
    pair: u64,
    how: Combination,
    judged: Option<u64>,
}

impl Default for Comparing {
    fn default() -> Self {
        Self {
            is_on: false,
            mode: Mode::default(),
            split: 0.5,
            flicker: Flicker::default(),
            gain: 4.0,
            false_colors: false,
            opacity: 1.0,
            side: None,
            combiner: None,
            shown: None,
            made_from: None,
            judge: Judge::default(),
            pairs: 0,
            waiting: None,
            more: 0,
            is_whole: false,
            frames: VecDeque::new(),
            problem: None,
        }
    }
}

impl Comparing {
    /// Whether two pipelines are drawn.
    pub fn is_on(&self) -> bool {
        self.is_on
    }

    /// The second side, once something was compared.
    pub fn side(&self) -> Option<&Side> {
        self.side.as_ref()
    }

    /// Whether A has drawn a moment that B has not: until then the scene stands still.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// The scene is another one: what B has not drawn, it need not draw any more.
    pub(super) fn wait_no_more(&mut self) {
        self.waiting = None;
    }

    /// How many pairs of pictures were drawn since the start.
    pub fn pairs(&self) -> u64 {
        self.pairs
    }

    /// What keeps B or what is made of both off the screen.
    pub(super) fn problems(&self) -> impl Iterator<Item = &Problem> {
        let side = self.side.as_ref().filter(|_| self.is_on);
        let compiled = side.and_then(|side| side.pipelines.problems());
        let drawn = side.and_then(|side| side.problem.as_ref());
        let compiled = compiled.into_iter().flat_map(|problems| problems.0.iter());
        compiled
            .chain(drawn)
            .chain(self.problem.as_ref().filter(|_| self.is_on))
    }

    /// Milliseconds that the device needs for B in addition to A.
    pub(super) fn beside_ms(&self) -> f64 {
        let side = self.side.as_ref().filter(|_| self.is_on);
        let last = side.and_then(|side| side.timings.gpu_ms.values().last());
        last.unwrap_or(0.0)
    }

    /// The shaders of the program itself have changed.
    pub(super) fn forget_shaders(&mut self) {
        if let Some(combiner) = &mut self.combiner {
            combiner.forget_shaders();
        }
        self.made_from = None;
        self.problem = None;
    }

    /// Takes in what was measured of B's frames. Gives the rest, where there are such, and whether B
    /// must be drawn again because a buffer was too small.
    pub(super) fn take_measured(&mut self, results: &[Measured]) -> Option<(Vec<Measured>, bool)> {
        if self.frames.is_empty() {
            return None;
        }
        let is_other = |measured: &&Measured| self.frames.contains(&measured.frame);
        let (other, rest): (Vec<&Measured>, Vec<&Measured>) = results.iter().partition(is_other);
        let rest: Vec<Measured> = rest.into_iter().cloned().collect();
        let other: Vec<Measured> = other.into_iter().cloned().collect();
        let Some(last) = other.last().map(|measured| measured.frame) else {
            return Some((rest, false));
        };
        // Results come in order: those before will not come any more.
        if let Some(at) = self.frames.iter().position(|frame| *frame == last) {
            self.frames.drain(..=at);
        }
        let grew = self.side.as_mut().is_some_and(|side| side.measured(&other));
        Some((rest, grew))
    }
}

impl Workbench {
    /// Begins or ends the comparison. What B was stays for the next time.
    pub fn compare(&mut self, on: bool) {
        if self.comparing.is_on == on {
            return;
        }
        let what = match on {
            true => say!("history.compare"),
            false => say!("history.compare_no_more"),
        };
        self.as_place("compare", what, false, |this| this.compare_now(on));
    }

    fn compare_now(&mut self, on: bool) {
        self.comparing.is_on = on;
        self.canvas.invalidate();
        if !on {
            self.rest_from_comparing();
            return;
        }
        if self.comparing.side.is_none() {
            let compiler = self.renderer.compiler();
            let side = Side::new(compiler, self.files.clone(), self.wake.clone());
            self.comparing.side = Some(side);
            let selected = self.pipelines.selected().to_owned();
            let beside = self.library.pipeline_beside(&selected, 1);
            let beside = beside.map_or(selected, str::to_owned);
            self.select_other(&beside);
        }
    }

    /// Gives back what only a comparison needs.
    fn rest_from_comparing(&mut self) {
        let comparing = &mut self.comparing;
        if let Some(side) = &mut comparing.side {
            side.rest();
        }
        comparing.combiner = None;
        comparing.shown = None;
        comparing.made_from = None;
        comparing.waiting = None;
        comparing.more = 0;
        comparing.judge.give_up();
        comparing.frames.clear();
    }

    /// Draws the same moment so many times more, for medians of more frames.
    pub fn draw_more(&mut self, pairs: u32) {
        if self.comparing.is_on {
            self.comparing.more = pairs;
            self.canvas.repeat();
        }
    }

    /// Makes A of B and B of A. Both stay warm.
    pub fn swap_sides(&mut self) {
        let what = say!("history.swap");
        self.as_place("swap", what, false, Self::swap_sides_now);
    }

    fn swap_sides_now(&mut self) {
        let Some(side) = self
            .comparing
            .side
            .as_mut()
            .filter(|_| self.comparing.is_on)
        else {
            return;
        };
        if side.pipelines.shown().is_none() || self.pipelines.shown().is_none() {
            return;
        }
        std::mem::swap(&mut self.pipelines, &mut side.pipelines);
        // The second viewport shows A.
        side.pipelines.release_series(Viewport::Second.series());
        self.comparing.waiting = None;
        // Frames on their way belong to the other side now.
        self.timings.reset();
        side.timings.reset();
        self.comparing.frames.clear();
        self.canvas.invalidate();
        let name = self.pipelines.selected().to_owned();
        self.did("pipeline", say!("comparing.the_pipeline", name = name));
    }

    /// Files have changed: B is built again where it depends on them.
    pub(super) fn other_files_changed(&mut self, paths: &[String]) {
        if let Some(side) = &mut self.comparing.side {
            side.pipelines.changed(paths);
        }
    }

    /// Takes in what was built of B.
    pub(super) fn take_other_pipelines(&mut self) {
        let Some(side) = &mut self.comparing.side else {
            return;
        };
        let before = side.pipelines.shown().map(str::to_owned);
        let news = side.pipelines.poll();
        if side.pipelines.shown() != before.as_deref() {
            side.timings.reset();
            self.canvas.invalidate();
        }
        for news in news {
            match news {
                News::Compiled(name, took) => {
                    let title = self.library.pipeline_title(&name).to_owned();
                    let ms = took.as_secs_f64() * 1e3;
                    self.log.info(say!(
                        "comparing.b_built_in_ms",
                        title = title,
                        ms = format_args!("{ms:.0}")
                    ));
                }
                News::Values(_) => self.canvas.invalidate(),
                News::Failed(_, Problems(problems)) => {
                    for problem in &problems {
                        self.log.problem(problem);
                    }
                }
                News::LeftOut(name, settings) => self.log.warn(say!(
                    "comparing.b_no_longer_set_because_the",
                    name = name,
                    parameters = settings.join(", ")
                )),
            }
        }
    }

    /// B on another device: it is built anew.
    pub(super) fn move_other(&mut self) {
        let (compiler, files, wake) = (
            self.renderer.compiler(),
            self.files.clone(),
            self.wake.clone(),
        );
        self.rest_from_comparing();
        if let Some(side) = &mut self.comparing.side {
            side.pipelines.move_to(compiler, files, wake);
        }
    }

    /// When the comparison has something to do next.
    pub(super) fn comparing_due(&self, now: Instant) -> Option<Duration> {
        const SOON: Duration = Duration::from_millis(20);
        const DEVICE: Duration = Duration::from_millis(4);
        const PROGRESS: Duration = Duration::from_millis(80);
        let comparing = &self.comparing;
        let side = comparing.side.as_ref().filter(|_| comparing.is_on)?;
        let mut flicker = comparing.flicker;
        let due = [
            (comparing.mode == Mode::Flicker)
                .then(|| flicker.advance(now))
                .flatten(),
            (comparing.judge.is_busy() || side.timings.is_waiting()).then_some(SOON),
            (side.pipelines.is_warming() || comparing.is_waiting()).then_some(DEVICE),
            side.pipelines.is_busy().then_some(PROGRESS),
            self.wants_judgement(now),
        ];
        due.into_iter().flatten().min()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_change_as_often_as_was_asked_and_never_too_fast() {
        let mut flicker = Flicker {
            automatic: true,
            rate: 2.0,
            ..Flicker::default()
        };
        let began = Instant::now();
        let mut changes = 0;
        let mut shown = false;
        for step in 0..400 {
            flicker.advance(began + Duration::from_millis(step * 10));
            changes += u32::from(std::mem::replace(&mut shown, flicker.shows_b) != shown);
        }
        // Four seconds, of which the last change would be at their end.
        assert_eq!(changes, 7);
        flicker.rate = 1000.0;
        assert!(flicker.pause() >= Duration::from_millis(333));
        flicker.automatic = false;
        assert_eq!(flicker.advance(began), None);
        let before = flicker.shows_b;
        flicker.change();
        assert_ne!(flicker.shows_b, before);
    }
}
