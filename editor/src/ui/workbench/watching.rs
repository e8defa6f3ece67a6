//! Files of the project that change while the editor runs.

use std::collections::BTreeSet;
use std::sync::Arc;

use lightbench::assets::files::Files;
use lightbench::assets::watch::{Changes, Watcher};

use super::Wake;
use super::log::Log;
use crate::ui::messages::say;

/// What changed on the disk.
#[derive(Debug, Default)]
pub(in crate::ui) struct Touched {
    /// Files, for [`Files::read`].
    pub(in crate::ui) paths: BTreeSet<String>,
    /// Anything may have changed.
    pub(in crate::ui) everything: bool,
}

/// The watched project, if there is one.
pub(super) struct Watch(Option<Watcher>);

impl Watch {
    /// Begins to watch. Where that is not possible, the log says so.
    pub(super) fn start(files: &Files, wake: &Wake, log: &mut Log) -> Self {
        let wake = Arc::clone(wake);
        match Watcher::new(files, move || wake()) {
            Ok(watcher) => {
                if let Some(project) = files.project() {
                    log.info(say!("watching.watching", project = project.display()));
                }
                Self(Some(watcher))
            }
            Err(error) => {
                log.warn(error.to_string());
                Self(None)
            }
        }
    }

    /// Whether there is something that is watched.
    pub(super) fn is_on(&self) -> bool {
        self.0.is_some()
    }

    /// What changed since the last call.
    pub(super) fn poll(&self) -> Option<Changes> {
        self.0.as_ref()?.changes()
    }
}
