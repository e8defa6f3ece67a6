//! What happened, for the log panel.

use std::collections::VecDeque;

use lightbench::render::{Place, Problem};

/// How much a line matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Something worth knowing.
    Info,
    /// Something that was put right, or that a script said.
    Script,
    /// Something that is not as asked, but goes on.
    Warning,
    /// Something that did not work.
    Error,
}

/// One line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Seconds since the program began.
    pub at: f64,
    /// How much it matters.
    pub level: Level,
    /// Which file it is about.
    pub place: Option<Place>,
    /// What happened.
    pub text: String,
    /// How often it was said in a row.
    pub count: u32,
}

/// Lines kept; older ones are dropped.
const CAPACITY: usize = 2_000;

/// The log of a run.
#[derive(Debug)]
pub struct Log {
    began: std::time::Instant,
    lines: VecDeque<Line>,
}

impl Default for Log {
    fn default() -> Self {
        Self {
            began: std::time::Instant::now(),
            lines: VecDeque::new(),
        }
    }
}

impl Log {
    /// Adds a line. One that repeats the last is counted there.
    pub fn add(&mut self, level: Level, place: Option<Place>, text: impl Into<String>) {
        let text = text.into();
        let at = self.began.elapsed().as_secs_f64();
        if let Some(last) = self.lines.back_mut()
            && last.level == level
            && last.text == text
            && last.place == place
        {
            last.count += 1;
            last.at = at;
            return;
        }
        if self.lines.len() == CAPACITY {
            self.lines.pop_front();
        }
        self.lines.push_back(Line {
            at,
            level,
            place,
            text,
            count: 1,
        });
    }

    /// Adds something worth knowing.
    pub fn info(&mut self, text: impl Into<String>) {
        self.add(Level::Info, None, text);
    }

    /// Adds something that is not as asked.
    pub fn warn(&mut self, text: impl Into<String>) {
        self.add(Level::Warning, None, text);
    }

    /// Adds something that did not work.
    pub fn error(&mut self, text: impl Into<String>) {
        self.add(Level::Error, None, text);
    }

    /// Adds a mistake with its place and the way out.
    pub fn problem(&mut self, problem: &Problem) {
        let text = match &problem.hint {
            Some(hint) => format!("{} ({hint})", problem.message),
            None => problem.message.clone(),
        };
        self.add(Level::Error, Some(problem.place.clone()), text);
    }

    /// The lines, oldest first.
    pub fn lines(&self) -> impl DoubleEndedIterator<Item = &Line> + ExactSizeIterator {
        self.lines.iter()
    }

    /// Forgets all lines.
    pub fn clear(&mut self) {
        self.lines.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_lines_are_counted_and_old_ones_dropped() {
        let mut log = Log::default();
        log.info("same");
        log.info("same");
        assert_eq!(log.lines().len(), 1);
        assert_eq!(log.lines().next().map(|line| line.count), Some(2));
        for i in 0..CAPACITY {
            log.info(format!("{i}"));
        }
        assert_eq!(log.lines().len(), CAPACITY);
        assert_eq!(log.lines().next().map(|line| line.text.as_str()), Some("0"));
    }
}
