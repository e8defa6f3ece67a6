//! One file that is edited: its text, and what is known of it on the disk.

use std::path::PathBuf;

use lightbench::assets::files::{FileError, Files, Origin, decode_text, write_atomic};

use crate::ui::messages::say;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// How a file's lines end and begin on the disk. In the editor they end with LF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Form {
    mark: bool,
    crlf: bool,
}

impl Form {
    fn of(bytes: &[u8]) -> Self {
        let ends = bytes.iter().filter(|byte| **byte == b'\n').count();
        let crlf = bytes.windows(2).filter(|pair| *pair == b"\r\n").count();
        Self {
            mark: bytes.starts_with(BYTE_ORDER_MARK),
            crlf: 2 * crlf > ends,
        }
    }

    fn encode(self, text: &str) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(text.len() + 3);
        if self.mark {
            bytes.extend_from_slice(BYTE_ORDER_MARK);
        }
        if self.crlf {
            bytes.extend_from_slice(text.replace('\n', "\r\n").as_bytes());
        } else {
            bytes.extend_from_slice(text.as_bytes());
        }
        bytes
    }
}

/// A file as it is in its layer now.
struct Found {
    text: String,
    form: Form,
    origin: Origin,
}

fn look_up(files: &Files, path: &str) -> Result<Found, FileError> {
    let origin = files.origin(path)?;
    let bytes = files.read(path)?;
    let form = Form::of(&bytes);
    let text = decode_text(path, bytes)?;
    Ok(Found { text, form, origin })
}

/// What became of a file while its text in the editor was changed too.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outside {
    /// Somebody wrote this.
    Changed(String),
    /// It is not there any more.
    Deleted,
}

/// Why a text was not saved. It stays in the editor.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// Nobody has chosen yet between the text in the editor and that on the disk.
    #[error("{}", say!("code.changed_outside_the_editor", path = .0))]
    Conflict(String),
    /// The file is marked as not to be written.
    #[error("{}", say!("code.is_read_only", path = .0.display()))]
    ReadOnly(PathBuf),
    /// What the disk says.
    #[error(transparent)]
    File(#[from] FileError),
}

/// A text and the file that it belongs to.
#[derive(Debug)]
pub struct Document {
    /// For [`Files::read`].
    pub path: String,
    /// As it is in the editor. Whoever changes it calls [`Document::touch`].
    pub text: String,
    /// As it was last seen in the file; `None` where there is no file.
    base: Option<String>,
    form: Form,
    origin: Origin,
    /// A change of the file that somebody must decide about.
    pub outside: Option<Outside>,
    /// Why the file could not be written or read at last.
    pub failure: Option<String>,
    /// Grows with each change of the text.
    edits: u64,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    /// As [`Files::read_text`].
    pub fn read(files: &Files, path: &str) -> Result<Self, FileError> {
        let found = look_up(files, path)?;
        Ok(Self {
            path: path.to_owned(),
            base: Some(found.text.clone()),
            text: found.text,
            form: found.form,
            origin: found.origin,
            outside: None,
            failure: None,
            edits: 0,
        })
    }

    /// A text that was kept after a crash, over the file as it is now. `base` tells whether a text
    /// is the one that it was changed from.
    pub fn recover(
        files: &Files,
        path: &str,
        on_disk: PathBuf,
        text: String,
        base: impl Fn(&str) -> bool,
    ) -> Self {
        let found = look_up(files, path).ok();
        let outside = match &found {
            Some(found) if found.text == text || base(&found.text) => None,
            Some(found) => Some(Outside::Changed(found.text.clone())),
            None => Some(Outside::Deleted),
        };
        let (base, form) = match found {
            Some(found) => (Some(found.text), found.form),
            None => (None, Form::default()),
        };
        Self {
            path: path.to_owned(),
            text,
            base,
            form,
            origin: Origin::Project(on_disk),
            outside,
            failure: None,
            edits: 1,
        }
    }

    /// The name without its folders.
    pub fn name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or(&self.path)
    }

    /// Where the file is on the disk, unless it is inside the program.
    pub fn on_disk(&self) -> Option<&PathBuf> {
        match &self.origin {
            Origin::Project(path) => Some(path),
            Origin::Shipped => None,
        }
    }

    /// Whether the text can only be read, because the file is inside the program.
    pub fn is_shipped(&self) -> bool {
        self.origin == Origin::Shipped && !self.is_unsaved()
    }

    /// Whether the text differs from the file, or is nowhere else.
    pub fn is_unsaved(&self) -> bool {
        self.is_changed() || self.outside == Some(Outside::Deleted)
    }

    /// Whether the text differs from what was last seen in the file.
    fn is_changed(&self) -> bool {
        self.base.as_deref() != Some(self.text.as_str())
    }

    /// Takes note that the text was changed.
    pub fn touch(&mut self) {
        self.edits += 1;
    }

    /// Grows with each change of the text.
    pub fn edits(&self) -> u64 {
        self.edits
    }

    /// The text that the present one was changed from.
    pub fn base(&self) -> Option<&str> {
        self.base.as_deref()
    }

    /// Looks at the file again. Without changes in the editor its text is taken; with such nothing
    /// is, and [`Document::outside`] says what there is to decide.
    pub fn refresh(&mut self, files: &Files) {
        let found = match look_up(files, &self.path) {
            Ok(found) => found,
            Err(FileError::NotFound { .. }) => {
                // What it was stays known: some programs save by deleting first.
                if self.base.is_some() {
                    self.outside = Some(Outside::Deleted);
                }
                return;
            }
            Err(error) => {
                self.failure = Some(error.to_string());
                return;
            }
        };
        let unsaved = self.is_changed();
        // A text that is not saved stays one of the project, where its file has gone.
        if !unsaved || found.origin != Origin::Shipped {
            self.origin = found.origin;
        }
        if self.base.as_deref() == Some(found.text.as_str()) {
            self.outside = None;
            return;
        }
        if unsaved && found.text != self.text {
            self.outside = Some(Outside::Changed(found.text));
            return;
        }
        self.form = found.form;
        self.outside = None;
        self.failure = None;
        self.base = Some(found.text.clone());
        if found.text != self.text {
            self.text = found.text;
            self.touch();
        }
    }

    /// Goes on with the text in the editor; what the file has now is replaced by the next save.
    pub fn keep_mine(&mut self) {
        match self.outside.take() {
            Some(Outside::Changed(theirs)) => self.base = Some(theirs),
            Some(Outside::Deleted) => self.base = None,
            None => {}
        }
    }

    /// Goes on with the text of the file. Returns whether there is one.
    pub fn take_theirs(&mut self, files: &Files) -> bool {
        match self.outside.take() {
            Some(Outside::Changed(theirs)) => {
                self.base = Some(theirs.clone());
                self.text = theirs;
                self.touch();
                // It may have changed once more.
                self.refresh(files);
                true
            }
            Some(Outside::Deleted) => false,
            None => true,
        }
    }

    /// Writes the text to the file, whole or not at all, unless that would undo what somebody
    /// else wrote.
    ///
    /// # Errors
    /// A change outside, a file or folder that can't be written, a full disk. The text stays.
    pub fn save(&mut self, files: &Files) -> Result<(), SaveError> {
        let saved = self.try_to_save(files);
        self.failure = saved.as_ref().err().map(ToString::to_string);
        saved
    }

    fn try_to_save(&mut self, files: &Files) -> Result<(), SaveError> {
        // The watcher may not have told yet.
        self.refresh(files);
        if self.outside.is_some() {
            return Err(SaveError::Conflict(files.display(&self.path)));
        }
        let bytes = self.form.encode(&self.text);
        let place = match &self.origin {
            // Renaming would replace a file that its owner does not want written.
            Origin::Project(place) if is_read_only(place) => {
                return Err(SaveError::ReadOnly(place.clone()));
            }
            Origin::Project(place) if self.path.starts_with('@') => {
                write_atomic(place, &bytes)?;
                place.clone()
            }
            _ => files.write(&self.path, &bytes)?,
        };
        self.origin = Origin::Project(place);
        self.base = Some(self.text.clone());
        Ok(())
    }

    /// Where a line of the saved text, from 1, is in the present one; `None` where it was changed.
    pub fn line_now(&self, line: usize) -> Option<usize> {
        let Some(base) = &self.base else {
            return Some(line);
        };
        if *base == self.text {
            return Some(line);
        }
        let (before, after): (Vec<&str>, Vec<&str>) =
            (base.split('\n').collect(), self.text.split('\n').collect());
        let pairs = before.iter().zip(&after);
        let head = pairs.take_while(|(a, b)| a == b).count();
        let pairs = before[head..].iter().rev().zip(after[head..].iter().rev());
        let tail = pairs.take_while(|(a, b)| a == b).count();
        let index = line.checked_sub(1)?;
        if index < head {
            Some(line)
        } else if index >= before.len() - tail && index < before.len() {
            Some(line + after.len() - before.len())
        } else {
            None
        }
    }
}

fn is_read_only(path: &std::path::Path) -> bool {
    std::fs::metadata(path).is_ok_and(|found| found.permissions().readonly())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn project() -> (tempfile::TempDir, Files) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.rhai"), "one\ntwo\n").unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        (folder, files)
    }

    fn type_into(document: &mut Document, text: &str) {
        text.clone_into(&mut document.text);
        document.touch();
    }

    #[test]
    fn a_text_is_saved_in_the_form_that_the_file_had() {
        let (folder, files) = project();
        let path = folder.path().join("a.rhai");
        std::fs::write(&path, b"\xef\xbb\xbfone\r\ntwo\r\n").unwrap();
        let mut document = Document::read(&files, "a.rhai").unwrap();
        assert_eq!(document.text, "one\ntwo\n");
        assert!(!document.is_unsaved());
        type_into(&mut document, "one\n2\n");
        assert!(document.is_unsaved());
        document.save(&files).unwrap();
        assert!(!document.is_unsaved());
        assert_eq!(std::fs::read(&path).unwrap(), b"\xef\xbb\xbfone\r\n2\r\n");
    }

    #[test]
    fn a_change_outside_is_taken_or_decided_about_and_never_undone() {
        let (folder, files) = project();
        let path = folder.path().join("a.rhai");
        let write = |text: &str| std::fs::write(&path, text).unwrap();
        let on_disk = || std::fs::read_to_string(&path).unwrap();
        let mut document = Document::read(&files, "a.rhai").unwrap();
        write("theirs\n");
        document.refresh(&files);
        assert_eq!(
            (document.text.as_str(), document.outside.as_ref()),
            ("theirs\n", None)
        );

        // Saved before the watcher told.
        type_into(&mut document, "mine\n");
        write("theirs again\n");
        let refused = document.save(&files).unwrap_err().to_string();
        assert!(refused.contains("a.rhai changed outside"), "{refused}");
        assert_eq!(on_disk(), "theirs again\n");
        assert_eq!(document.text, "mine\n");
        let theirs = Outside::Changed("theirs again\n".to_owned());
        assert_eq!(document.outside, Some(theirs));
        // Once more, and nothing was decided.
        assert!(document.save(&files).is_err());
        document.keep_mine();
        document.save(&files).unwrap();
        assert_eq!(on_disk(), "mine\n");

        type_into(&mut document, "mine, more\n");
        write("the third\n");
        document.refresh(&files);
        assert!(document.take_theirs(&files));
        assert_eq!(document.text, "the third\n");
        assert!(!document.is_unsaved());

        // The same change on both sides is none.
        type_into(&mut document, "equal\n");
        write("equal\n");
        document.refresh(&files);
        assert!(document.outside.is_none() && !document.is_unsaved());
    }

    #[test]
    fn a_file_that_was_deleted_is_written_again_only_on_demand() {
        let (folder, files) = project();
        let path = folder.path().join("a.rhai");
        let mut document = Document::read(&files, "a.rhai").unwrap();
        std::fs::remove_file(&path).unwrap();
        document.refresh(&files);
        document.refresh(&files);
        assert_eq!(document.outside, Some(Outside::Deleted));
        assert!(document.is_unsaved(), "the text is nowhere else");
        assert!(document.save(&files).is_err());
        assert!(!path.exists());
        document.keep_mine();
        document.save(&files).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "one\ntwo\n");

        // One that is deleted to be written anew is no conflict, unless there is unsaved text.
        std::fs::remove_file(&path).unwrap();
        document.refresh(&files);
        std::fs::write(&path, "three\n").unwrap();
        document.refresh(&files);
        assert_eq!(
            (document.text.as_str(), document.outside.as_ref()),
            ("three\n", None)
        );
        type_into(&mut document, "mine\n");
        std::fs::remove_file(&path).unwrap();
        document.refresh(&files);
        std::fs::write(&path, "four\n").unwrap();
        document.refresh(&files);
        assert_eq!(
            document.outside,
            Some(Outside::Changed("four\n".to_owned()))
        );
        // It is as it was again.
        std::fs::write(&path, "three\n").unwrap();
        document.refresh(&files);
        assert_eq!(
            (document.text.as_str(), document.outside.as_ref()),
            ("mine\n", None)
        );
    }

    #[test]
    fn a_failed_write_keeps_the_text_and_says_why() {
        let (folder, files) = project();
        let path = folder.path().join("a.rhai");
        let mut document = Document::read(&files, "a.rhai").unwrap();
        let mut permissions = std::fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(true);
        std::fs::set_permissions(&path, permissions).unwrap();
        type_into(&mut document, "mine\n");
        let refused = document.save(&files).unwrap_err().to_string();
        assert!(refused.contains("read-only"), "{refused}");
        assert_eq!(document.failure.as_ref(), Some(&refused));
        assert!(document.is_unsaved());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "one\ntwo\n");
    }

    #[test]
    fn a_shipped_file_is_read_until_the_project_has_a_copy() {
        let (_folder, files) = project();
        let shipped = "shaders/output.wgsl";
        let mut document = Document::read(&files, shipped).unwrap();
        assert!(document.is_shipped());
        files.copy_to_project(shipped).unwrap();
        document.refresh(&files);
        assert!(!document.is_shipped());
        assert!(!document.is_unsaved());
    }

    #[test]
    fn lines_of_the_saved_text_are_found_again() {
        let (_folder, files) = project();
        let mut document = Document::read(&files, "a.rhai").unwrap();
        let now = |document: &Document| [1, 2, 3].map(|line| document.line_now(line));
        assert_eq!(now(&document), [Some(1), Some(2), Some(3)]);
        type_into(&mut document, "one\nmore\nand more\ntwo\n");
        assert_eq!(now(&document), [Some(1), Some(4), Some(5)]);
        type_into(&mut document, "1\ntwo\n");
        assert_eq!(now(&document), [None, Some(2), Some(3)]);
        type_into(&mut document, "two\n");
        assert_eq!(document.line_now(1), None);
        assert_eq!(document.line_now(2), Some(1));
    }
}
