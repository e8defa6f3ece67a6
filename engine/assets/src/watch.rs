//! Noticing that files of a project changed.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use notify::{EventKind, RecommendedWatcher, RecursiveMode};
use notify_debouncer_full::{
    DebounceEventResult, DebouncedEvent, Debouncer, RecommendedCache, new_debouncer,
};
use thiserror::Error;

use crate::files::Files;

/// How long after a change it is reported, since programs save in several steps
/// and most are done within a few milliseconds; and how often at most there is
/// a report.
const SETTLE: Duration = Duration::from_millis(10);

/// Where pictures and reports are written, which nobody waits for.
const OUTPUT_FOLDER: &str = "out";

/// What changed since the last look: written, made, renamed or deleted. A file
/// may be empty or half written still; it will be named again when it goes on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// For [`Files::read`].
    pub paths: BTreeSet<String>,
    /// The system lost count: anything may have changed.
    pub everything: bool,
}

/// Why a folder can't be watched.
#[derive(Debug, Error)]
#[error("{}: changes can't be watched ({cause}); save and load by hand, or raise the system's limit of watches", folder.display())]
pub struct WatchError {
    folder: PathBuf,
    cause: notify::Error,
}

/// A folder that is watched, and what its paths begin with in [`Files`].
#[derive(Clone, Debug)]
struct Root {
    folder: PathBuf,
    prefix: String,
    /// Whether it is a project, with the folders below.
    project: bool,
}

/// Watches the project of a file store, and the folders of granted files, until
/// it is dropped.
#[derive(Debug)]
pub struct Watcher {
    // Stops its thread when it is dropped.
    _debouncer: Debouncer<RecommendedWatcher, RecommendedCache>,
    changes: Receiver<Changes>,
}

impl Watcher {
    /// Begins to watch. `wake` is called on another thread after each change,
    /// for instance to have a window drawn again.
    ///
    /// # Errors
    /// A folder that can't be watched, as when the system's limit is reached.
    pub fn new(files: &Files, wake: impl Fn() + Send + 'static) -> Result<Self, WatchError> {
        let roots = roots(files);
        let failed = |folder: &Path| {
            let folder = folder.to_owned();
            move |cause| WatchError { folder, cause }
        };
        let (sender, changes) = channel();
        let known = roots.clone();
        let handler = move |result: DebounceEventResult| {
            let changes = match result {
                Ok(events) => relevant(&known, &events),
                Err(errors) => {
                    for error in errors {
                        tracing::warn!("watching files: {error}");
                    }
                    Changes {
                        everything: true,
                        ..Changes::default()
                    }
                }
            };
            if changes != Changes::default() && sender.send(changes).is_ok() {
                wake();
            }
        };
        let mut debouncer =
            new_debouncer(SETTLE, Some(SETTLE), handler).map_err(failed(Path::new("watcher")))?;
        for root in &roots {
            let mode = if root.project {
                RecursiveMode::Recursive
            } else {
                RecursiveMode::NonRecursive
            };
            debouncer
                .watch(&root.folder, mode)
                .map_err(failed(&root.folder))?;
        }
        Ok(Self {
            _debouncer: debouncer,
            changes,
        })
    }

    /// All changes since the last call, as one set. Does not wait.
    #[must_use]
    pub fn changes(&self) -> Option<Changes> {
        self.changes.try_iter().reduce(merged)
    }

    /// As [`Watcher::changes`], but waits for the first one.
    #[must_use]
    pub fn wait(&self, timeout: Duration) -> Option<Changes> {
        let first = self.changes.recv_timeout(timeout).ok()?;
        Some(self.changes.try_iter().fold(first, merged))
    }
}

fn merged(mut one: Changes, other: Changes) -> Changes {
    one.paths.extend(other.paths);
    one.everything |= other.everything;
    one
}

fn roots(files: &Files) -> Vec<Root> {
    let project = files.project().map(|folder| Root {
        folder: folder.to_owned(),
        prefix: String::new(),
        project: true,
    });
    let granted = files.granted_folders().map(|(prefix, folder)| Root {
        folder: folder.to_owned(),
        prefix,
        project: false,
    });
    project.into_iter().chain(granted).collect()
}

fn relevant(roots: &[Root], events: &[DebouncedEvent]) -> Changes {
    let mut changes = Changes::default();
    for event in events {
        changes.everything |= event.need_rescan();
        // To read a file is no change of it.
        if matches!(event.kind, EventKind::Access(_)) {
            continue;
        }
        for path in &event.paths {
            for root in roots {
                if let Some(relative) = relative(root, path) {
                    if relative.is_empty() {
                        changes.everything = true;
                    } else {
                        add(&mut changes, root, path, relative);
                    }
                }
            }
        }
    }
    changes
}

/// Adds a file, or all files in a folder: those written before the system began
/// to watch a new folder have no event of their own.
fn add(changes: &mut Changes, root: &Root, path: &Path, relative: String) {
    if root.project && path.is_dir() && !path.is_symlink() {
        let entries = std::fs::read_dir(path).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()) {
            if let Some(relative) = self::relative(root, &path) {
                add(changes, root, &path, relative);
            }
        }
    }
    changes.paths.insert(format!("{}{relative}", root.prefix));
}

/// The path below a root, or `None` for what is outside, hidden, temporary or
/// in the folder of outputs.
fn relative(root: &Root, path: &Path) -> Option<String> {
    let below = path.strip_prefix(&root.folder).ok()?;
    let parts: Vec<&str> = below
        .iter()
        .map(|part| part.to_str())
        .collect::<Option<_>>()?;
    let ignored =
        |part: &&str| part.starts_with('.') || part.ends_with('~') || part.ends_with(".tmp");
    if parts.iter().any(ignored) || root.project && parts.first() == Some(&OUTPUT_FOLDER) {
        return None;
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests;
