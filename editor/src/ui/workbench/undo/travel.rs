//! The way through the steps, back and forth.

use super::super::Workbench;
use super::{Change, Content, Step, Target};
use crate::ui::messages::say;

impl Workbench {
    /// Takes back the last step. Returns whether there was one.
    ///
    /// Where the step before chose another scene, that is loaded first: the steps beyond it follow then.
    pub fn undo(&mut self) -> bool {
        self.note_dials();
        let at = self.undo.heading.unwrap_or(self.undo.done.len());
        if at == 0 {
            return false;
        }
        self.go_to_step(at - 1);
        true
    }

    /// Does again what was taken back last. Returns whether there was something.
    pub fn redo(&mut self) -> bool {
        self.note_dials();
        let at = self.undo.heading.unwrap_or(self.undo.done.len());
        if at == self.undo.done.len() + self.undo.undone.len() {
            return false;
        }
        self.go_to_step(at + 1);
        true
    }

    /// Goes to where so many steps are done.
    pub fn go_to_step(&mut self, steps: usize) {
        self.note_dials();
        self.undo.seal();
        let all = self.undo.done.len() + self.undo.undone.len();
        self.undo.heading = Some(steps.min(all));
        self.travel();
    }

    /// Goes on to the step that was asked for, as far as the scenes for that are there.
    pub(in crate::ui::workbench) fn travel(&mut self) {
        while let Some(steps) = self.undo.heading {
            if self.is_between_scenes() {
                return;
            }
            match self.undo.done.len().cmp(&steps) {
                std::cmp::Ordering::Equal => self.undo.heading = None,
                std::cmp::Ordering::Greater => self.take_one_back(),
                std::cmp::Ordering::Less => self.do_one_again(),
            }
        }
    }

    /// Whether another scene than that on screen is on its way.
    pub fn is_between_scenes(&self) -> bool {
        let other = self.scenes.shown() != Some(self.scenes.selected());
        self.is_arriving() || self.scenes.is_busy() && other
    }

    /// Takes back the step that goes on, and forgets it.
    pub fn give_up_step(&mut self) {
        if self.undo.goes_on && !self.is_between_scenes() && self.undo() {
            self.undo.undone.pop();
        }
    }

    fn take_one_back(&mut self) {
        let Some(mut step) = self.undo.done.pop() else {
            return;
        };
        if self.is_there_for(&step) {
            for change in &mut step.changes {
                // What came of it shows only now: time may have run since.
                if let Some(now) = self.content_now(change) {
                    change.after = Some(now);
                }
            }
            self.quietly(|this| {
                for change in step.changes.iter().rev() {
                    let (target, after) = (&change.target, change.after.as_ref());
                    this.apply(target, change.before.as_ref(), after);
                }
                this.choose_by_names(&step.chosen);
            });
        }
        self.undo.undone.push(step);
    }

    fn do_one_again(&mut self) {
        let Some(step) = self.undo.undone.pop() else {
            return;
        };
        if self.is_there_for(&step) {
            self.quietly(|this| {
                for change in &step.changes {
                    let (target, before) = (&change.target, change.before.as_ref());
                    this.apply(target, change.after.as_ref(), before);
                }
            });
        }
        self.undo.done.push(step);
    }

    /// Does something of which no note is taken.
    pub(in crate::ui::workbench) fn quietly<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.undo.quiet, true);
        let result = work(self);
        self.undo.quiet = before;
        self.undo.revision += 1;
        self.undo.dials = Some(self.dials());
        self.absorb_view();
        result
    }

    /// Whether the scene of a step is on screen. It is not where its file is broken or gone now.
    fn is_there_for(&mut self, step: &Step) -> bool {
        let wanted = step.scene.as_deref();
        let is_there = wanted.is_none() || wanted == self.scenes.shown();
        if !is_there {
            let (what, scene) = (&step.what, wanted.unwrap_or_default());
            self.log
                .warn(say!("history.no_scene", what = what, scene = scene));
        }
        is_there
    }

    /// What stands where a step was, for targets that go on changing after it.
    fn content_now(&mut self, change: &Change) -> Option<Content> {
        match (&change.target, &change.before) {
            (Target::Place(_), Some(Content::Place(before))) => {
                let moves = before.seen.is_some();
                Some(Content::Place(Box::new(self.place(moves))))
            }
            // Of an entry that was kept, its files come back byte for byte.
            (Target::Entry(name), None) => self.present_entry(name).map(Content::Entry),
            (Target::Moment(_), _) => self.keep_moment().map(Content::Moment),
            _ => None,
        }
    }

    fn choose_by_names(&mut self, names: &[String]) {
        let Some(scene) = self.scenes.scene().filter(|_| !names.is_empty()) else {
            return;
        };
        let found: Vec<_> = names.iter().filter_map(|n| scene.world.find(n)).collect();
        self.selection.set(scene, found);
    }
}
