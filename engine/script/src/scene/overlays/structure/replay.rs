//! Changes of the structure on a scene that was loaded anew or taken back.

use lightbench_world::scene_file;

use super::super::kept::waiting;
use super::super::{KeptEdit, Overlays};
use super::{Done, work};
use crate::scene::Scene;

impl Overlays {
    /// Does all changes again from one on, on a scene without them. Those whose entities are not there
    /// wait.
    pub(in super::super) fn replay(&mut self, scene: &mut Scene, from: usize) {
        if self.edits.len() <= from {
            return;
        }
        // As when the first of them was done.
        scene_file::number(&mut scene.world);
        for place in from..self.edits.len() {
            self.do_again(scene, place);
        }
    }

    /// Does changes that were kept, after all others. Those whose entities are not there wait.
    pub fn lay_more(&mut self, scene: &mut Scene, edits: impl IntoIterator<Item = KeptEdit>) {
        for kept in edits {
            self.serial += 1;
            let fields = kept.fields.into_iter().map(waiting).collect();
            let done = Done::waiting(kept.edit, self.serial, fields, kept.greatest);
            self.edits.push(done);
            // As when it was done.
            scene_file::number(&mut scene.world);
            self.do_again(scene, self.edits.len() - 1);
        }
        self.settle(scene);
    }

    /// Does changes that waited, where their entities have come. Returns whether there were some.
    pub(in super::super) fn retry(&mut self, scene: &mut Scene) -> bool {
        let mut done_now = false;
        for place in 0..self.edits.len() {
            if self.edits[place].inverse.is_none() {
                done_now |= self.do_again(scene, place);
            }
        }
        done_now
    }

    /// Does one change again. Returns whether it can be done.
    fn do_again(&mut self, scene: &mut Scene, place: usize) -> bool {
        let before = scene.stock();
        let (earlier, later) = self.edits.split_at_mut(place);
        let Some(done) = later.first_mut() else {
            return false;
        };
        done.inverse = work::perform(scene, &done.edit, earlier).ok();
        done.stock = (before, scene.stock());
        if done.inverse.is_none() {
            // What a part of it has added.
            scene.forget_added(&done.stock);
            done.stock = (before, before);
        }
        done.inverse.is_some()
    }

    /// The structure of a scene that was taken back to a moment at which `before` lay on it: changes
    /// that both have stay, the others of `before` are taken back and the others of these done again.
    pub(in super::super) fn structure_taken_back(&mut self, scene: &mut Scene, mut before: Self) {
        let same = self.edits.iter().zip(&before.edits);
        let common = same.take_while(|(a, b)| a.serial == b.serial).count();
        while before.edits.len() > common {
            before.undo_edit(scene);
        }
        for ((_, path), overlay) in std::mem::take(&mut before.all) {
            overlay.take_off(scene, &path);
        }
        for (own, old) in self.edits.iter_mut().zip(before.edits) {
            own.inverse = old.inverse;
            own.stock = old.stock;
        }
        self.replay(scene, common);
    }
}
