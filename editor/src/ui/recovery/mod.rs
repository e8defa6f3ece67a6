//! What somebody works on, kept in a file every few seconds, and what earlier runs have left there.
//!
//! What is written is built in the window's thread and turned into text and written by another one. A file
//! stays until the next run has it in its own, or somebody gave it up.

mod asset_words;
mod session;
#[cfg(test)]
mod tests;
mod words;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

use lightbench::assets::files::write_atomic;

use super::messages::say;
use super::runs::{abandoned, lock, name_of_run};
pub use session::Session;

/// How long a change waits for others before it is kept. With the time that writing takes this is the
/// most that a crash can take.
pub const PAUSE: Duration = Duration::from_secs(2);

/// How long it takes until a file that could not be written is tried again.
const AGAIN: Duration = Duration::from_secs(10);

/// The file of a run, in its folder.
const FILE: &str = "session.json";

/// A session that an earlier run has left.
#[derive(Debug)]
pub struct Left {
    /// What was worked on.
    pub session: Session,
    /// When it was written.
    pub written: Option<SystemTime>,
    folder: PathBuf,
    _lock: File,
}

/// What the thread that writes is asked for.
enum Order {
    /// Write the session, and then remove a folder that it came from.
    Write(Box<Session>, Option<PathBuf>),
    /// Remove this run's file.
    Clear,
    /// Remove the folder of another run.
    Remove(PathBuf),
    /// Say that all before was done.
    Tell(Sender<()>),
}

/// The sessions of this run and of those before.
pub struct Recovery {
    /// Those that others have left, the newest last; the last one is asked about.
    pub left: Vec<Left>,
    root: Option<PathBuf>,
    folder: Option<PathBuf>,
    /// What the workbench had done when it was kept last.
    kept: (u64, u64),
    /// When the first change came that is not kept.
    since: Option<Instant>,
    /// Until when nothing is tried, because it failed.
    rests_until: Option<Instant>,
    /// What went wrong, told once.
    wrong: Option<String>,
    /// Told and not yet fetched.
    news: Vec<Result<String, String>>,
    orders: Option<Sender<Order>>,
    results: Option<Receiver<Result<(), String>>>,
    thread: Option<JoinHandle<()>>,
}

impl Recovery {
    /// Keeps sessions below `root`, and looks there for what other runs have left that `wanted` fits.
    pub fn open(root: Option<PathBuf>, wanted: impl Fn(&Session) -> bool) -> Self {
        let mut left = Vec::new();
        for run in root.iter().flat_map(fs::read_dir).flatten().flatten() {
            let folder = run.path();
            let Some(lock) = abandoned(&folder) else {
                continue;
            };
            let file = folder.join(FILE);
            let Ok(text) = fs::read_to_string(&file) else {
                // Nothing was kept there, and nothing is lost where that fails.
                let _ = fs::remove_dir_all(&folder);
                continue;
            };
            let Some(session) = Session::from_json(&text).filter(&wanted) else {
                continue;
            };
            let written = fs::metadata(&file).and_then(|it| it.modified()).ok();
            left.push(Left {
                session,
                written,
                folder,
                _lock: lock,
            });
        }
        left.sort_by_key(|left| left.written);
        Self {
            left,
            folder: root.as_ref().map(|root| root.join(name_of_run())),
            root,
            kept: (0, 0),
            since: None,
            rests_until: None,
            wrong: None,
            news: Vec::new(),
            orders: None,
            results: None,
            thread: None,
        }
    }

    /// Where sessions are kept.
    pub fn root(&self) -> Option<&Path> {
        self.root.as_deref()
    }

    /// Takes note of how much was done, and keeps what `session` gives once a change has waited.
    pub fn note(
        &mut self,
        done: (u64, u64),
        now: Instant,
        session: impl FnOnce() -> Option<Session>,
    ) {
        self.take_results(now);
        // Who only looks around loses nothing.
        if self.folder.is_none() || done == self.kept || done.0 == 0 {
            self.since = None;
            return;
        }
        let since = *self.since.get_or_insert(now);
        let rests = self.rests_until.is_some_and(|until| now < until);
        if rests || now.saturating_duration_since(since) < PAUSE {
            return;
        }
        if let Some(session) = session() {
            self.kept = done;
            self.since = None;
            self.send(Order::Write(Box::new(session), None));
        }
    }

    /// What went wrong, or right again, since the last call.
    pub fn take_news(&mut self) -> Vec<Result<String, String>> {
        std::mem::take(&mut self.news)
    }

    /// Until when something is to be kept.
    pub fn next_due(&self, now: Instant) -> Option<Duration> {
        let due = self.since? + PAUSE;
        let due = self.rests_until.map_or(due, |until| until.max(due));
        Some(due.saturating_duration_since(now))
    }

    /// Keeps a session now. Waits until it is written.
    ///
    /// # Errors
    /// A sentence that says why it can't be.
    pub fn keep_now(&mut self, session: Session) -> Result<(), String> {
        if self.folder.is_none() {
            return Err(say!("recovery.no_folder").to_owned());
        }
        self.send(Order::Write(Box::new(session), None));
        self.wait();
        let results = self.results.iter().flat_map(Receiver::try_iter);
        results.last().unwrap_or(Ok(()))
    }

    /// What was left last, as a session of this run from now on. The other file goes when this one is
    /// written.
    pub fn take_over(&mut self) -> Option<Session> {
        let left = self.left.pop()?;
        let mut session = left.session.clone();
        session.on_purpose = false;
        let write = Order::Write(Box::new(session), Some(left.folder.clone()));
        self.send(write);
        Some(left.session)
    }

    /// Throws away what was left last.
    pub fn throw_away(&mut self) {
        if let Some(left) = self.left.pop() {
            self.send(Order::Remove(left.folder.clone()));
        }
    }

    /// Forgets this run's session: all that it has is given up or saved.
    pub fn forget(&mut self) {
        if self.orders.is_some() {
            self.send(Order::Clear);
            self.wait();
        }
        self.since = None;
    }

    fn wait(&self) {
        let (done, wait) = channel();
        if let Some(orders) = &self.orders
            && orders.send(Order::Tell(done)).is_ok()
        {
            // The thread ends with this side alone.
            let _ = wait.recv();
        }
    }

    fn take_results(&mut self, now: Instant) {
        let results: Vec<_> = self.results.iter().flat_map(Receiver::try_iter).collect();
        for result in results {
            match result {
                Ok(()) => {
                    self.rests_until = None;
                    if self.wrong.take().is_some() {
                        self.news.push(Ok(say!("recovery.kept_again").to_owned()));
                    }
                }
                Err(why) => {
                    // It is not kept: the next round tries again.
                    self.kept = (0, 0);
                    self.rests_until = Some(now + AGAIN);
                    if self.wrong.is_none() {
                        self.news.push(Err(why.clone()));
                    }
                    self.wrong = Some(why);
                }
            }
        }
    }

    fn send(&mut self, order: Order) {
        let Some(folder) = self.folder.clone() else {
            return;
        };
        if self.orders.is_none() {
            let (orders, inbox) = channel();
            let (outbox, results) = channel();
            (self.orders, self.results) = (Some(orders), Some(results));
            self.thread = Some(std::thread::spawn(move || {
                let mut held = None;
                for order in inbox {
                    let result = match order {
                        Order::Tell(done) => {
                            // Nobody waits any more where that fails.
                            let _ = done.send(());
                            continue;
                        }
                        Order::Clear => {
                            held = None;
                            // What stays is offered again, which loses nothing.
                            let _ = fs::remove_dir_all(&folder);
                            continue;
                        }
                        Order::Remove(other) => {
                            let _ = fs::remove_dir_all(other);
                            continue;
                        }
                        Order::Write(session, other) => {
                            let written = write(&folder, &session, &mut held);
                            if let (Ok(()), Some(other)) = (&written, other) {
                                let _ = fs::remove_dir_all(other);
                            }
                            written
                        }
                    };
                    if outbox.send(result).is_err() {
                        return;
                    }
                }
            }));
        }
        if let Some(orders) = &self.orders {
            // The thread ends with this side alone.
            let _ = orders.send(order);
        }
    }
}

impl Drop for Recovery {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            tracing::error!("the thread that keeps sessions panicked");
        }
    }
}

fn write(folder: &Path, session: &Session, held: &mut Option<File>) -> Result<(), String> {
    let failed = |error: &dyn std::fmt::Display| {
        say!(
            "recovery.not_kept",
            folder = folder.display(),
            error = error
        )
    };
    if held.is_none() {
        // The lock is there before the file is, so that no other run takes it.
        *held = Some(lock(folder).map_err(|error| failed(&error))?);
    }
    let text = session.to_json();
    write_atomic(folder.join(FILE), text.as_bytes()).map_err(|error| failed(&error))
}
