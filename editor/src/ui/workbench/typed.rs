//! Lines of the console that have changed the scene on screen. They are kept with the session, and run again
//! where somebody goes on with that.

use std::collections::VecDeque;

use lightbench::script::overlays::KeptEdit;

use super::Workbench;
use crate::ui::messages::say;

/// What sums of steps lose of a moment, seconds.
const NOTHING: f64 = 1e-9;

/// A line that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Typed {
    /// The line.
    pub line: String,
    /// The time of the scene at which it was run, seconds.
    pub time: f64,
    /// How many changes of the structure by hand came before it.
    pub edits: usize,
    /// Whether it has changed the world, and not only what scripts remember.
    pub changes: bool,
}

/// Lines that are to be run again once their scene is there, and the changes by hand that came after the first
/// of them.
#[derive(Clone, Debug)]
pub(super) struct Coming {
    pub(super) scene: String,
    pub(super) lines: VecDeque<Typed>,
    pub(super) edits: VecDeque<KeptEdit>,
    /// How many changes by hand came before those.
    laid: usize,
}

impl Coming {
    /// The lines of a scene. Changes of `edits` that came after the first line wait for it from now on.
    pub(super) fn new(scene: String, lines: &[Typed], edits: &mut Vec<KeptEdit>) -> Option<Self> {
        let laid = lines.first()?.edits.min(edits.len());
        Some(Self {
            scene,
            lines: lines.iter().cloned().collect(),
            edits: edits.split_off(laid).into(),
            laid,
        })
    }
}

impl Workbench {
    /// How many changes of the structure of the scene on screen were made by hand.
    pub(super) fn count_of_edits(&self) -> usize {
        self.overlays_now().map_or(0, |all| all.edits().len())
    }

    /// Runs lines again that were run by a moment of the scene on screen, or all.
    pub(super) fn run_again(&mut self, until: Option<f64>) {
        let shown = self.scenes.shown().unwrap_or_default();
        let place = self.coming.iter().position(|one| one.scene == shown);
        let Some(place) = place else {
            return;
        };
        let mut coming = self.coming.remove(place);
        let is_due = |next: &Typed| until.is_none_or(|until| next.time <= until + NOTHING);
        while coming.lines.front().is_some_and(is_due)
            && let Some(next) = coming.lines.pop_front()
        {
            let wanted = next.edits.saturating_sub(coming.laid);
            let count = wanted.min(coming.edits.len());
            coming.laid += count;
            self.lay_edits(coming.edits.drain(..count));
            let evaluated = self.evaluate_now(&next.line);
            if evaluated.is_some_and(|it| it.result.is_ok()) {
                self.typed.push(next);
            } else {
                self.log
                    .error(say!("recovery.line_failed", line = next.line.trim()));
            }
        }
        if coming.lines.is_empty() {
            self.lay_edits(coming.edits);
        } else {
            self.coming.push(coming);
        }
    }

    fn lay_edits(&mut self, edits: impl IntoIterator<Item = KeptEdit>) {
        let edits: Vec<KeptEdit> = edits.into_iter().collect();
        if edits.is_empty() {
            return;
        }
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        // Where all of them came after the first line nothing lies on the scene yet.
        self.overlays.entry(name).or_default();
        self.on_overlays(|overlays, scene| overlays.lay_more(scene, edits));
    }

    /// How many lines have changed the world of the scene on screen, which is in no file as it is.
    pub(super) fn unsaved_lines(&self) -> usize {
        match self.typed == self.saved_lines {
            true => 0,
            false => self.typed.iter().filter(|typed| typed.changes).count(),
        }
    }
}
