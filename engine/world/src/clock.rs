//! The world's clock of changes.

use std::sync::atomic::{AtomicU32, Ordering};

use crate::ticks::Tick;

/// Counts observations. Shared by reference, because observers only read.
#[derive(Debug)]
pub(crate) struct Clock(AtomicU32);

impl Default for Clock {
    fn default() -> Self {
        Self(AtomicU32::new(Tick::START.next().0))
    }
}

impl Clone for Clock {
    fn clone(&self) -> Self {
        Self(AtomicU32::new(self.now().0))
    }
}

impl Clock {
    /// The tick that a write carries now.
    pub fn now(&self) -> Tick {
        Tick(self.0.load(Ordering::Relaxed))
    }

    /// Closes the current tick and returns it: later writes carry a later one.
    pub fn observe(&self) -> Tick {
        Tick(self.0.fetch_add(1, Ordering::Relaxed))
    }
}
