//! Number keys of pipelines. Who owns them is the editor, which keeps them over restarts.

use std::collections::BTreeMap;

use super::super::Workbench;
use super::{Change, Content, Target, Undo};
use crate::ui::messages::say;

/// The pipelines of number keys from 1.
pub type NumberKeys = BTreeMap<usize, String>;

impl Undo {
    /// Which pipelines are to have number keys, where that was taken back or done again.
    pub fn take_number_keys(&mut self) -> Option<NumberKeys> {
        self.number_keys.take()
    }
}

impl Workbench {
    /// Takes note of a number key that was given to a pipeline.
    pub fn note_number_keys(
        &mut self,
        key: usize,
        pipeline: &str,
        before: NumberKeys,
        after: NumberKeys,
    ) {
        let entries = self.library.pipelines.iter();
        let mut named = entries.filter(|entry| entry.name == pipeline);
        let title = named.next().map_or(pipeline, |entry| &entry.title);
        let what = say!("history.number_key", key = key, pipeline = title);
        let change = Change {
            target: Target::NumberKeys,
            before: Some(Content::NumberKeys(before)),
            after: Some(Content::NumberKeys(after)),
        };
        self.undo.seal();
        self.undo.note(what, vec![change]);
        self.undo.seal();
    }
}
