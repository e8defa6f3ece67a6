//! Changing the notes of entries and deleting entries, both to be taken back.

use std::sync::Arc;

use super::super::Workbench;
use super::super::undo::{Change, Content, Target};
use super::{Kept, disk};
use crate::ui::messages::say;

/// An entry that was deleted, with the files that it had.
#[derive(Clone, Debug)]
pub struct Deleted(Arc<Gone>);

#[derive(Debug)]
struct Gone {
    kept: Kept,
    /// Its files as they were; `None` where they were not on the disk.
    files: Option<disk::Files>,
}

impl PartialEq for Deleted {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Workbench {
    /// Changes the note of an entry.
    pub fn set_note(&mut self, name: &str, note: &str) {
        let folder = self.notebook_folder();
        let mut all = self.notebook.entries.iter_mut();
        let Some(kept) = all.find(|kept| kept.entry.name == name) else {
            return;
        };
        if kept.entry.note == note {
            return;
        }
        let before = std::mem::replace(&mut kept.entry.note, note.to_owned());
        let written = folder.and_then(|folder| disk::write(&folder, &kept.entry, kept.png()));
        kept.unsaved = written.err();
        self.notebook.said = kept
            .unsaved
            .clone()
            .map(|why| Err(say!("notebook.the_note_is_in_memory_alone", why = why)));
        let change = Change {
            target: Target::Note(name.to_owned()),
            before: Some(Content::Text(before)),
            after: Some(Content::Text(note.to_owned())),
        };
        let what = say!("history.note", name = name);
        self.undo.note(what, vec![change]);
    }

    /// Takes note of an entry that was made.
    pub(super) fn note_entry(&mut self, name: &str) {
        let Some(entry) = self.present_entry(name) else {
            return;
        };
        let change = Change {
            target: Target::Entry(name.to_owned()),
            before: None,
            after: Some(Content::Entry(entry)),
        };
        self.undo.seal();
        let what = say!("history.keep_entry", name = name);
        self.undo.note(what, vec![change]);
        self.undo.seal();
    }

    /// An entry as it is now, with the files that it has.
    pub(in crate::ui::workbench) fn present_entry(&self, name: &str) -> Option<Deleted> {
        let mut all = self.notebook.entries.iter();
        let kept = all.find(|kept| kept.entry.name == name)?.clone();
        let folder = self.notebook_folder().ok();
        let files = folder.and_then(|folder| disk::files(&folder, name));
        Some(Deleted(Arc::new(Gone { kept, files })))
    }

    /// Deletes an entry with its picture.
    pub fn delete_entry(&mut self, name: &str) {
        let Some(gone) = self.present_entry(name) else {
            return;
        };
        let folder = self.notebook_folder();
        let result = folder.and_then(|folder| disk::delete(&folder, name));
        match result {
            Err(why) if gone.0.kept.png.is_none() => {
                let text = say!("notebook.was_not_deleted", name = name, why = why);
                self.notebook.said = Some(Err(text));
            }
            _ => {
                self.notebook.entries.retain(|k| k.entry.name != name);
                self.notebook.said = Some(Ok(say!("notebook.was_deleted", name = name)));
                let change = Change {
                    target: Target::Entry(name.to_owned()),
                    before: Some(Content::Entry(gone)),
                    after: None,
                };
                let what = say!("history.delete_entry", name = name);
                self.undo.note(what, vec![change]);
            }
        }
    }

    /// Brings an entry back that was deleted, with its files as they were.
    pub(in crate::ui::workbench) fn bring_entry_back(&mut self, deleted: &Deleted) {
        let Gone { kept, files } = deleted.0.as_ref();
        let mut kept = kept.clone();
        let name = kept.entry.name.clone();
        if let Some(files) = files {
            let folder = self.notebook_folder();
            let written = folder.and_then(|folder| disk::bring_back(&folder, &name, files));
            if let Err(why) = written {
                // What is not on the disk any more is here.
                kept.png = files.png.clone().map(Arc::new);
                kept.unsaved = Some(why);
            }
        }
        self.notebook.said = Some(match &kept.unsaved {
            None => Ok(say!("notebook.back", name = name)),
            Some(why) => Err(say!("notebook.the_entry_is_in_memory_alone", why = why)),
        });
        self.notebook.add(kept);
    }

    /// Tries to write all entries that are in memory alone. Returns whether none is any more.
    pub fn save_entries(&mut self) -> bool {
        let folder = self.notebook_folder();
        for kept in &mut self.notebook.entries {
            if kept.unsaved.is_none() {
                continue;
            }
            let written = folder
                .clone()
                .and_then(|folder| disk::write(&folder, &kept.entry, kept.png()));
            match written {
                Ok(()) => (kept.unsaved, kept.png) = (None, None),
                Err(why) => kept.unsaved = Some(why),
            }
        }
        self.notebook.unsaved().next().is_none()
    }
}
