//! Unsaved texts, kept in files of their own every few seconds, so that a crash takes little.
//!
//! Each run of the editor has a folder for them.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbench::assets::Digest;
use lightbench::assets::files::write_atomic;
use serde_json::{Value, json};

use super::document::Document;
use crate::ui::messages::say;
use crate::ui::runs::{abandoned, lock, name_of_run};

/// How long a change waits for others before it is kept. With the time that writing takes this is
/// the most that a crash can take.
pub const PAUSE: Duration = Duration::from_secs(2);

/// How long it takes until texts that could not be kept are tried again.
const AGAIN: Duration = Duration::from_secs(10);

/// A text that was not saved when the program ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draft {
    /// Its path in the project; as people write it where it is outside.
    pub path: String,
    /// Where its file is, or would be.
    pub on_disk: PathBuf,
    /// The digest of the text that it was changed from.
    base: Option<String>,
    /// What was typed.
    pub text: String,
    /// Where it is kept.
    file: PathBuf,
}

impl Draft {
    fn read(file: &Path) -> Option<Self> {
        let value: Value = serde_json::from_str(&fs::read_to_string(file).ok()?).ok()?;
        let text = |name: &str| value.get(name)?.as_str().map(str::to_owned);
        Some(Self {
            path: text("path")?,
            on_disk: text("file")?.into(),
            base: text("base"),
            text: text("text")?,
            file: file.to_owned(),
        })
    }

    /// Whether the draft was changed from this text.
    pub fn is_from(&self, text: &str) -> bool {
        self.base.as_ref() == Some(&digest(text))
    }
}

fn digest(text: &str) -> String {
    Digest::of(text.as_bytes()).to_string()
}

/// What the thread that writes is asked for.
enum Order {
    Write(PathBuf, String),
    Remove(PathBuf),
}

/// What is known of a document's draft.
#[derive(Default)]
struct Known {
    /// The edits of the text that was kept last.
    kept: Option<u64>,
    /// Whether there may be a file of it.
    is_on_disk: bool,
    /// When the first change came that is not kept.
    since: Option<Instant>,
}

/// The unsaved texts of this run, and those that others have left.
pub struct Drafts {
    /// This run's folder; it is made with the first draft.
    folder: Option<PathBuf>,
    /// Those of runs that have ended, while their drafts are offered.
    held: Vec<File>,
    known: BTreeMap<String, Known>,
    orders: Option<Sender<Order>>,
    results: Option<Receiver<Result<(), String>>>,
    /// Whether it was told that texts can't be kept.
    told: bool,
    /// It gives the lock of this run's folder, if it has one.
    thread: Option<JoinHandle<Option<File>>>,
}

impl Drafts {
    /// Looks for what other runs have left below a folder: texts that `wanted` fits.
    pub fn open(root: Option<PathBuf>, wanted: impl Fn(&Draft) -> bool) -> (Self, Vec<Draft>) {
        let mut held = Vec::new();
        let mut left = Vec::new();
        for run in root.iter().flat_map(fs::read_dir).flatten().flatten() {
            let Some(lock) = abandoned(&run.path()) else {
                continue;
            };
            let mut drafts = drafts_in(&run.path());
            if drafts.is_empty() {
                // Nothing is lost where that fails: it is tried again at the next start.
                let _ = fs::remove_dir_all(run.path());
                continue;
            }
            drafts.retain(&wanted);
            if !drafts.is_empty() {
                held.push(lock);
                left.extend(drafts);
            }
        }
        left.sort_by(|a, b| a.path.cmp(&b.path));
        let folder = root.map(|root| root.join(name_of_run()));
        let this = Self {
            folder,
            held,
            known: BTreeMap::new(),
            orders: None,
            results: None,
            told: false,
            thread: None,
        };
        (this, left)
    }

    /// Takes note of the texts: those that are not saved are kept after a pause, and what was kept
    /// of the others is removed. Returns what went wrong with earlier ones.
    pub fn note(&mut self, documents: &[Document], now: Instant) -> Vec<String> {
        let mut orders = Vec::new();
        self.known.retain(|path, known| {
            let document = documents.iter().find(|document| document.path == *path);
            let stays = document.is_some_and(Document::is_unsaved);
            if !stays && known.is_on_disk {
                orders.push(Order::Remove(name_of(path).into()));
            }
            stays
        });
        for document in documents.iter().filter(|document| document.is_unsaved()) {
            let known = self.known.entry(document.path.clone()).or_default();
            if known.kept == Some(document.edits()) {
                known.since = None;
                continue;
            }
            let since = *known.since.get_or_insert(now);
            if now.saturating_duration_since(since) >= PAUSE {
                (known.kept, known.is_on_disk) = (Some(document.edits()), true);
                known.since = None;
                orders.push(Order::Write(
                    name_of(&document.path).into(),
                    written(document),
                ));
            }
        }
        for order in orders {
            self.send(order);
        }
        let results: Vec<_> = self.results.iter().flat_map(Receiver::try_iter).collect();
        let mut news = Vec::new();
        for result in results {
            let Err(why) = result else {
                self.told = false;
                continue;
            };
            // Tried again later, and told once.
            for known in self.known.values_mut() {
                known.kept = None;
                known.since = Some(now + AGAIN);
            }
            if !std::mem::replace(&mut self.told, true) {
                news.push(why);
            }
        }
        news
    }

    /// Keeps a text at once.
    pub fn keep(&mut self, document: &Document) {
        let known = self.known.entry(document.path.clone()).or_default();
        (known.kept, known.is_on_disk) = (Some(document.edits()), true);
        known.since = None;
        self.send(Order::Write(
            name_of(&document.path).into(),
            written(document),
        ));
    }

    /// How long until something is to be kept.
    pub fn next_due(&self, now: Instant) -> Option<Duration> {
        let since = self.known.values().filter_map(|known| known.since);
        let first = since.min()?;
        Some((first + PAUSE).saturating_duration_since(now))
    }

    /// Removes what another run has left, once somebody has decided about it.
    pub fn forget(&mut self, draft: &Draft) {
        self.send(Order::Remove(draft.file.clone()));
    }

    fn send(&mut self, order: Order) {
        let Some(folder) = self.folder.clone() else {
            return;
        };
        if self.orders.is_none() {
            let (orders, inbox) = channel();
            let (outbox, results) = channel();
            self.orders = Some(orders);
            self.results = Some(results);
            self.thread = Some(std::thread::spawn(move || {
                let mut held = None;
                for order in inbox {
                    // The lock is there before the first draft is, so that no other run takes it.
                    let locked = match &held {
                        Some(_) => Ok(()),
                        None => lock(&folder).map(|lock| held = Some(lock)),
                    };
                    let locked = locked.map_err(|error| complaint(&folder, &error));
                    let done = locked.and_then(|()| follow(&folder, order));
                    if outbox.send(done).is_err() {
                        break;
                    }
                }
                held
            }));
        }
        if let Some(orders) = &self.orders {
            // The thread ends with this side alone.
            let _ = orders.send(order);
        }
    }
}

impl Drop for Drafts {
    fn drop(&mut self) {
        self.orders = None;
        let lock = self.thread.take().and_then(|thread| {
            let ended = thread.join();
            if ended.is_err() {
                tracing::error!("the thread that keeps unsaved texts panicked");
            }
            ended.ok().flatten()
        });
        self.held.clear();
        if lock.is_some()
            && let Some(folder) = &self.folder
            && drafts_in(folder).is_empty()
        {
            let _ = fs::remove_dir_all(folder);
        }
    }
}

fn follow(folder: &Path, order: Order) -> Result<(), String> {
    match order {
        Order::Write(name, text) => {
            let file = folder.join(name);
            write_atomic(file, text.as_bytes()).map_err(|error| complaint(folder, &error))
        }
        Order::Remove(name) => match fs::remove_file(folder.join(name)) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(complaint(folder, &error))
            }
            _ => Ok(()),
        },
    }
}

fn complaint(folder: &Path, error: &dyn std::fmt::Display) -> String {
    say!(
        "code.unsaved_text_is_not_kept",
        folder = folder.display(),
        error = error
    )
}

fn drafts_in(folder: &Path) -> Vec<Draft> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let files = entries.map(|entry| entry.path());
    let files = files.filter(|file| file.extension().is_some_and(|end| end == "json"));
    files.filter_map(|file| Draft::read(&file)).collect()
}

/// The name of a document's draft.
fn name_of(path: &str) -> String {
    format!("{}.json", &digest(path)[..16])
}

fn written(document: &Document) -> String {
    let on_disk = document.on_disk();
    json!({
        "path": document.path,
        "file": on_disk.map(|path| path.to_string_lossy()),
        "base": document.base().map(digest),
        "text": document.text,
    })
    .to_string()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use lightbench::assets::files::Files;

    use super::*;

    struct Desk {
        _folder: tempfile::TempDir,
        files: Files,
        root: PathBuf,
    }

    impl Desk {
        fn new() -> Self {
            let folder = tempfile::tempdir().unwrap();
            let project = folder.path().join("project");
            fs::create_dir(&project).unwrap();
            fs::write(project.join("a.rhai"), "saved").unwrap();
            Self {
                files: Files::with_project(&project).unwrap(),
                root: folder.path().join("unsaved"),
                _folder: folder,
            }
        }

        fn open(&self) -> (Drafts, Vec<Draft>) {
            Drafts::open(Some(self.root.clone()), |_| true)
        }

        fn edited(&self) -> Document {
            let mut document = Document::read(&self.files, "a.rhai").unwrap();
            document.text.push_str(", and more");
            document.touch();
            document
        }
    }

    #[test]
    fn a_text_is_kept_after_a_pause_and_found_by_the_next_run_alone() {
        let desk = Desk::new();
        let documents = [desk.edited()];
        let (mut drafts, left) = desk.open();
        assert_eq!(left, []);
        let now = Instant::now();
        assert_eq!(drafts.note(&documents, now), [""; 0]);
        assert!(drafts.next_due(now).is_some_and(|due| due <= PAUSE));
        drafts.note(&documents, now + PAUSE);
        assert_eq!(drafts.next_due(now + PAUSE), None, "it is kept");
        // Another run does not take what this one works on.
        assert_eq!(desk.open().1, []);
        drop(drafts);
        let (mut second, left) = desk.open();
        assert_eq!(left.len(), 1);
        assert_eq!(left[0].text, "saved, and more");
        assert_eq!(left[0].path, "a.rhai");
        assert!(left[0].is_from("saved") && !left[0].is_from("other"));
        // While it is offered, no third run offers it.
        assert_eq!(desk.open().1, []);
        second.forget(&left[0]);
        drop(second);
        assert_eq!(desk.open().1, []);
        assert_eq!(
            fs::read_dir(&desk.root).unwrap().count(),
            0,
            "nothing is left"
        );
    }

    #[test]
    fn a_text_that_was_saved_is_not_offered() {
        let desk = Desk::new();
        let mut documents = [desk.edited()];
        let (mut drafts, _) = desk.open();
        drafts.keep(&documents[0]);
        documents[0].save(&desk.files).unwrap();
        assert_eq!(drafts.note(&documents, Instant::now()), [""; 0]);
        drop(drafts);
        assert_eq!(desk.open().1, []);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_told() {
        let desk = Desk::new();
        fs::write(&desk.root, "a file").unwrap();
        let (mut drafts, _) = desk.open();
        let document = [desk.edited()];
        let began = Instant::now();
        let mut told = Vec::new();
        for round in 0..30 {
            told.extend(drafts.note(&document, began + PAUSE * round));
            std::thread::sleep(Duration::from_millis(5));
        }
        assert_eq!(told.len(), 1, "once: {told:?}");
        assert!(told[0].contains("not kept in"), "{told:?}");
        fs::remove_file(&desk.root).unwrap();
        for round in 30..40 {
            drafts.note(&document, began + PAUSE * round);
        }
        drop(drafts);
        assert_eq!(desk.open().1.len(), 1, "it was tried again");
    }
}
