//! Folders of runs of the editor, in which each keeps what a crash must not take.
//!
//! A run holds a lock in its folder. The system gives up the lock however the program ends, so that a
//! folder without one is what a crash left.

use std::fs::{self, File};
use std::path::Path;

/// The lock of a run, in its folder.
const LOCK: &str = "lock";

/// Makes the folder of a run and its lock.
pub(super) fn lock(folder: &Path) -> std::io::Result<File> {
    fs::create_dir_all(folder)?;
    let file = File::create(folder.join(LOCK))?;
    file.try_lock().map_err(std::io::Error::from)?;
    Ok(file)
}

/// The lock of a run that has ended; `None` where it goes on.
pub(super) fn abandoned(folder: &Path) -> Option<File> {
    let file = File::open(folder.join(LOCK)).ok()?;
    file.try_lock().ok()?;
    Some(file)
}

/// A name for the folder of a run, which no other run has.
pub(super) fn name_of_run() -> String {
    let since = std::time::SystemTime::UNIX_EPOCH.elapsed();
    let nanos = since.map_or(0, |since| since.as_nanos());
    format!("{}-{nanos}", std::process::id())
}
