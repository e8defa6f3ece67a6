//! What scripts say with `print` and `debug`.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
#[derive(Clone, Debug, Default)]
pub(crate) struct Log(Arc<Mutex<Vec<LogLine>>>);

impl Log {
    pub(crate) fn add(&self, place: Place, text: String) {
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
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
