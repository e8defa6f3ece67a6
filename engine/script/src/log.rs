//! What scripts say with `print` and `debug`.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use lightbench_render::Place;

/// One line that a script printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogLine {
    /// Where the script printed it.
    pub place: Place,
    /// The text.
    pub text: String,
}

/// Lines kept of one run; later ones are dropped, and the last line says so.
const MAX_LINES: usize = 1_000;

/// The lines that a script printed, shared with the engine that runs it.
#[derive(Clone, Default)]
pub(crate) struct Log(Arc<Inner>);

#[derive(Default)]
struct Inner {
    lines: Mutex<Vec<LogLine>>,
    listener: OnceLock<Box<dyn Fn(LogLine) + Send + Sync>>,
}

impl fmt::Debug for Log {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Log").field(&*self.lines()).finish()
    }
}

impl Log {
    /// Hands each line on when it is printed, and keeps none.
    pub(crate) fn pass_on(&self, listener: impl Fn(LogLine) + Send + Sync + 'static) {
        // The first one stays; there is one for each engine.
        let _ = self.0.listener.set(Box::new(listener));
    }

    pub(crate) fn add(&self, place: Place, text: String) {
        if let Some(listener) = self.0.listener.get() {
            return listener(LogLine { place, text });
        }
        let mut lines = self.lines();
        match lines.len() {
            0..MAX_LINES => lines.push(LogLine { place, text }),
            MAX_LINES => lines.push(LogLine {
                place,
                text: "(more was printed, but is not kept)".to_owned(),
            }),
            _ => {}
        }
    }

    /// Takes the lines out.
    pub(crate) fn take(&self) -> Vec<LogLine> {
        std::mem::take(&mut self.lines())
    }

    fn lines(&self) -> MutexGuard<'_, Vec<LogLine>> {
        self.0.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
