//! Scripts and shaders that are edited in the window, without a widget in it.

pub mod difference;
pub mod document;
pub mod drafts;
pub mod search;
pub mod tokens;
pub mod typing;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use lightbench::assets::files::{FileError, Files};

use document::{Document, SaveError};
use drafts::{Draft, Drafts};

/// Where the caret goes when a file is shown next. Both count from 1; 0 where it is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// Line.
    pub line: usize,
    /// Column in letters.
    pub column: usize,
}

/// What somebody must say before texts are given up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leaving {
    /// One file is closed, by its path.
    File(String),
    /// The window is closed.
    Window,
    /// Another project is opened.
    Project(PathBuf),
}

/// The files that are open.
pub struct Code {
    documents: Vec<Document>,
    active: usize,
    drafts: Drafts,
    /// What a crash has left, until somebody decides.
    pub offered: Vec<Draft>,
    /// Where the caret goes in the file that is shown.
    pub going: Option<Spot>,
    /// A question that is asked.
    pub leaving: Option<Leaving>,
}

impl Code {
    /// No file is open. Unsaved texts are kept below `root`, and what a crash left there is offered.
    pub fn new(root: Option<PathBuf>, files: &Files) -> Self {
        let (drafts, offered) = Drafts::open(root, |draft| concerns(files, draft));
        Self {
            documents: Vec::new(),
            active: 0,
            drafts,
            offered,
            going: None,
            leaving: None,
        }
    }

    /// The open files, in the order of their tabs.
    pub fn documents(&self) -> &[Document] {
        &self.documents
    }

    /// Which of them is shown.
    pub fn active(&self) -> usize {
        self.active
    }

    /// The file that is shown.
    pub fn shown(&self) -> Option<&Document> {
        self.documents.get(self.active)
    }

    /// The file that is shown, to be changed.
    pub fn shown_mut(&mut self) -> Option<&mut Document> {
        self.documents.get_mut(self.active)
    }

    /// Shows an open file.
    pub fn show(&mut self, index: usize) {
        self.active = index.min(self.documents.len().saturating_sub(1));
    }

    /// Opens a file, or shows it where it is open.
    ///
    /// # Errors
    /// As [`Files::read_text`].
    pub fn open(&mut self, files: &Files, path: &str, spot: Option<Spot>) -> Result<(), FileError> {
        let known = self.documents.iter().position(|open| open.path == path);
        self.active = match known {
            Some(index) => index,
            None => {
                self.documents.push(Document::read(files, path)?);
                self.documents.len() - 1
            }
        };
        self.going = spot.or(self.going.filter(|_| known.is_some()));
        Ok(())
    }

    /// Files that differ from what is on the disk.
    pub fn unsaved(&self) -> impl Iterator<Item = &Document> {
        self.documents.iter().filter(|open| open.is_unsaved())
    }

    /// Looks at those of these files that are open; at all without a list.
    pub fn refresh(&mut self, files: &Files, changed: Option<&[String]>) {
        for document in &mut self.documents {
            if changed.is_none_or(|changed| changed.contains(&document.path)) {
                document.refresh(files);
            }
        }
    }

    /// Saves the file that is shown.
    ///
    /// # Errors
    /// As [`Document::save`]; the text stays.
    pub fn save(&mut self, files: &Files) -> Result<(), SaveError> {
        match self.documents.get_mut(self.active) {
            Some(document) if document.is_unsaved() => document.save(files),
            _ => Ok(()),
        }
    }

    /// Saves all files. The first that can't be saved is shown.
    ///
    /// # Errors
    /// As [`Document::save`], for the first that fails.
    pub fn save_all(&mut self, files: &Files) -> Result<(), SaveError> {
        for index in 0..self.documents.len() {
            if self.documents[index].is_unsaved()
                && let Err(error) = self.documents[index].save(files)
            {
                self.active = index;
                return Err(error);
            }
        }
        Ok(())
    }

    /// Closes a file, or asks where that would give up a text.
    pub fn close(&mut self, index: usize) {
        match self.documents.get(index) {
            Some(document) if document.is_unsaved() => {
                self.leaving = Some(Leaving::File(document.path.clone()));
            }
            Some(_) => self.remove(index),
            None => {}
        }
    }

    /// Closes a file and gives up what was not saved.
    pub fn discard(&mut self, path: &str) {
        if let Some(index) = self.documents.iter().position(|open| open.path == path) {
            self.remove(index);
        }
    }

    /// Gives up all texts that are not saved.
    pub fn discard_all(&mut self) {
        self.documents.retain(|open| !open.is_unsaved());
        self.show(self.active);
    }

    /// Closes all files, whose paths mean nothing in another project, and looks for what a crash
    /// has left of that.
    pub fn move_to(&mut self, root: Option<PathBuf>, files: &Files) {
        self.documents.clear();
        self.note(Instant::now());
        *self = Self::new(root, files);
    }

    fn remove(&mut self, index: usize) {
        self.documents.remove(index);
        if index < self.active || self.active == self.documents.len() {
            self.active = self.active.saturating_sub(1);
        }
    }

    /// Opens a text that a crash has left.
    pub fn restore(&mut self, files: &mut Files, index: usize) {
        let draft = self.offered.remove(index);
        // What is outside the project has another number in each run.
        let granted = draft
            .path
            .starts_with('@')
            .then(|| files.grant(&draft.on_disk));
        let path = granted.and_then(Result::ok);
        let path = path.unwrap_or_else(|| draft.path.clone());
        let (on_disk, text) = (draft.on_disk.clone(), draft.text.clone());
        let document = Document::recover(files, &path, on_disk, text, |text| draft.is_from(text));
        // Before the other is removed, so that there is one at any time.
        self.drafts.keep(&document);
        self.drafts.forget(&draft);
        self.discard(&path);
        self.documents.push(document);
        self.active = self.documents.len() - 1;
    }

    /// Throws away a text that a crash has left.
    pub fn throw_away(&mut self, index: usize) {
        let draft = self.offered.remove(index);
        self.drafts.forget(&draft);
    }

    /// Keeps what was not saved; called in every frame. Returns what went wrong with that.
    pub fn note(&mut self, now: Instant) -> Vec<String> {
        self.drafts.note(&self.documents, now)
    }

    /// How long until [`Code::note`] has something to do.
    pub fn next_due(&self, now: Instant) -> Option<Duration> {
        self.drafts.next_due(now)
    }
}

/// Whether a draft is of a file of this project, or of none.
fn concerns(files: &Files, draft: &Draft) -> bool {
    if draft.path.starts_with('@') {
        return true;
    }
    files
        .project()
        .is_some_and(|project| project.join(&draft.path) == draft.on_disk)
}
