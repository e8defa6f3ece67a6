//! What the editor keeps so that nothing is lost: sessions after a crash, and what is asked before it closes.

use std::path::Path;
use std::time::Instant;

use super::code::Leaving;
use super::editor::Editor;
use super::layout::Panel;
use super::messages::say;
use super::recovery::{Recovery, Session};

/// Whether a session is of the project that is open.
fn concerns(project: Option<&Path>, session: &Session) -> bool {
    let whole = |path: &Path| path.canonicalize().ok();
    match (project, session.project.as_deref()) {
        (None, None) => true,
        (Some(a), Some(b)) => a == b || whole(a).is_some() && whole(a) == whole(b),
        _ => false,
    }
}

/// Sessions below a folder, with those that were left of a project.
pub(super) fn open_recovery(root: Option<std::path::PathBuf>, project: Option<&Path>) -> Recovery {
    Recovery::open(root, |session| concerns(project, session))
}

impl Editor {
    /// Keeps what was done, and tells what went wrong with that.
    pub(super) fn tend_recovery(&mut self, now: Instant) {
        if self.quit {
            // What is kept was decided about.
            return;
        }
        let workbench = &self.workbench;
        let done = workbench.done_so_far();
        self.recovery.note(done, now, || workbench.session());
        for news in self.recovery.take_news() {
            match news {
                Ok(text) => self.workbench.log.info(text),
                Err(text) => {
                    self.workbench.log.error(text);
                    self.reveal(Panel::Log);
                }
            }
        }
    }

    /// Goes on with what the last run has left.
    pub(super) fn restore_session(&mut self) {
        let Some(session) = self.recovery.take_over() else {
            return;
        };
        let result = self.workbench.resume(&session);
        match result {
            Ok(()) => self.workbench.log.info(say!("recovery.restored")),
            Err(why) => {
                self.workbench.log.error(why);
                self.reveal(Panel::Log);
            }
        }
    }

    /// Closes the window, after what would be lost was decided about.
    pub fn ask_to_quit(&mut self) {
        if self.has_something_to_lose() {
            self.code.leaving = Some(Leaving::Window);
        } else {
            self.quit(false);
        }
    }

    /// Whether closing would lose something.
    pub(super) fn has_something_to_lose(&self) -> bool {
        let workbench = &self.workbench;
        self.code.unsaved().next().is_some()
            || !workbench.unsaved_changes().is_empty()
            || workbench.notebook.unsaved().next().is_some()
    }

    /// Saves texts and entries of the notebook, and keeps changes by hand for the next start. Returns
    /// whether all of it is kept.
    pub(super) fn keep_all(&mut self) -> bool {
        self.not_kept = None;
        if !self.save_all_files() {
            return false;
        }
        if !self.workbench.save_entries() {
            let mut unsaved = self.workbench.notebook.unsaved();
            self.not_kept = unsaved.find_map(|kept| kept.unsaved.clone());
            return false;
        }
        if self.workbench.unsaved_changes().is_empty() {
            return true;
        }
        let Some(mut session) = self.workbench.session() else {
            self.not_kept = Some(say!("recovery.loading").to_owned());
            return false;
        };
        session.on_purpose = true;
        let kept = self.recovery.keep_now(session);
        self.not_kept = kept.err();
        self.not_kept.is_none()
    }

    /// Closes the window in the next frame. `keeps` leaves what was kept for the next start.
    pub(super) fn quit(&mut self, keeps: bool) {
        self.leave_session(keeps);
        self.quit = true;
    }

    /// Ends this run's session, with or without what was kept.
    pub(super) fn leave_session(&mut self, keeps: bool) {
        if !keeps || self.workbench.unsaved_changes().is_empty() {
            self.recovery.forget();
        }
    }
}
