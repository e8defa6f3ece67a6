//! Work on another thread, with progress and a way to stop it.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use thiserror::Error;

/// How far some work is. Clones share it: one side reports, the other shows.
#[derive(Clone, Debug, Default)]
pub struct Progress {
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    /// The bits of a float of 0 to 1.
    fraction: AtomicU32,
    label: Mutex<String>,
    cancelled: AtomicBool,
}

/// The work was stopped by its user.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("stopped")]
pub struct Cancelled;

impl Progress {
    /// Nothing done yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The share that is done, 0 to 1. It never falls.
    #[must_use]
    pub fn fraction(&self) -> f32 {
        f32::from_bits(self.shared.fraction.load(Ordering::Relaxed))
    }

    /// What is being done, in a few words for the user.
    #[must_use]
    pub fn label(&self) -> String {
        let label = self
            .shared
            .label
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        label.clone()
    }

    /// Asks the work to stop.
    pub fn cancel(&self) {
        self.shared.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the work was asked to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancelled.load(Ordering::Relaxed)
    }

    /// Reports the share that is done.
    ///
    /// # Errors
    /// The work was asked to stop; return from it.
    pub fn report(&self, fraction: f32) -> Result<(), Cancelled> {
        // Positive floats are in the order of their bits.
        let bits = crate::clamped(fraction, 0.0, 1.0).to_bits();
        self.shared.fraction.fetch_max(bits, Ordering::Relaxed);
        if self.is_cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }

    /// Reports what begins now, and the share that is done.
    ///
    /// # Errors
    /// As [`Progress::report`].
    pub fn begin(&self, label: impl Into<String>, fraction: f32) -> Result<(), Cancelled> {
        let mut shared = self
            .shared
            .label
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        *shared = label.into();
        drop(shared);
        self.report(fraction)
    }
}

/// Work that runs on a thread of its own. Dropping it asks the work to stop.
#[derive(Debug)]
pub struct Task<T> {
    progress: Progress,
    result: Receiver<T>,
}

/// The thread of a task ended without a result.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("the work on another thread ended without a result; this is a fault of the program")]
pub struct TaskLost;

impl<T: Send + 'static> Task<T> {
    /// Starts some work. Its progress is given to it, to be reported.
    ///
    /// # Errors
    /// The system gives no more threads.
    pub fn start(work: impl FnOnce(&Progress) -> T + Send + 'static) -> std::io::Result<Self> {
        let progress = Progress::new();
        let (sender, result) = sync_channel(1);
        let reported = progress.clone();
        thread::Builder::new()
            .name("loader".to_owned())
            .spawn(move || {
                // Nobody may be waiting any more.
                let _ = sender.send(work(&reported));
            })?;
        Ok(Self { progress, result })
    }

    /// How far the work is.
    #[must_use]
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// The result, once, as soon as it is there. Does not wait.
    ///
    /// # Errors
    /// The thread ended without a result, or the result was taken already.
    pub fn poll(&self) -> Result<Option<T>, TaskLost> {
        match self.result.try_recv() {
            Ok(result) => Ok(Some(result)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(TaskLost),
        }
    }

    /// Waits for the result.
    ///
    /// # Errors
    /// As [`Task::poll`].
    pub fn wait(self) -> Result<T, TaskLost> {
        self.result.recv().map_err(|_| TaskLost)
    }
}

impl<T> Drop for Task<T> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn a_task_reports_and_hands_back_its_result() {
        let (go, wait) = mpsc::channel::<()>();
        let (said, told) = mpsc::channel::<()>();
        let task = Task::start(move |progress| {
            progress.begin("Reading", 0.25).unwrap();
            said.send(()).unwrap();
            wait.recv().unwrap();
            progress.report(0.1).unwrap();
            42
        })
        .unwrap();
        told.recv().unwrap();
        assert_eq!(task.poll(), Ok(None));
        assert_eq!(
            (task.progress().fraction(), task.progress().label().as_str()),
            (0.25, "Reading")
        );
        go.send(()).unwrap();
        let progress = task.progress().clone();
        assert_eq!(task.wait(), Ok(42));
        assert_eq!(progress.fraction(), 0.25, "progress never falls");
    }

    #[test]
    fn a_dropped_task_is_asked_to_stop() {
        let (said, told) = mpsc::channel();
        let task = Task::start(move |progress| {
            while progress.report(0.5).is_ok() {
                thread::yield_now();
            }
            said.send(()).unwrap();
        })
        .unwrap();
        drop(task);
        told.recv().unwrap();
    }

    #[test]
    fn a_task_that_fails_is_noticed() {
        let task: Task<()> = Task::start(|_| {
            std::panic::resume_unwind(Box::new("a fault"));
        })
        .unwrap();
        assert_eq!(task.wait(), Err(TaskLost));
    }

    #[test]
    fn odd_fractions_are_clamped() {
        let progress = Progress::new();
        for fraction in [-1.0, f32::NAN, 0.5, 0.2, 7.0] {
            progress.report(fraction).unwrap();
        }
        assert_eq!(progress.fraction(), 1.0);
    }
}
