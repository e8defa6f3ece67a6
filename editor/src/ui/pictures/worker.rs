//! The thread that draws.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbench::assets::files::Files;
use lightbench::render::GpuOptions;

use super::draw::Studio;
use super::order::Order;
use super::{Pixels, Wake};

/// How long a person must do nothing before the next small picture is drawn.
const REST: Duration = Duration::from_millis(400);

/// How often the thread looks whether that is so.
const LOOK: Duration = Duration::from_millis(50);

/// How long a device is held for pictures that may be wanted yet.
const HELD: Duration = Duration::from_secs(60);

/// What was drawn.
pub(super) struct Answer {
    pub key: String,
    pub is_large: bool,
    pub pixels: Result<Pixels, String>,
}

/// What is to be drawn, with the version of the files that it is to be made from.
#[derive(Default)]
struct Queue {
    large: Option<(u64, Order)>,
    small: VecDeque<(u64, Order)>,
    /// Small ones wait until then.
    busy_until: Option<Instant>,
    ends: bool,
}

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    changed: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The thread, as the editor sees it.
pub(super) struct Worker {
    shared: Arc<Shared>,
    answers: Receiver<Answer>,
    thread: Option<JoinHandle<()>>,
    project: Option<PathBuf>,
}

impl Worker {
    pub(super) fn start(files: Files, gpu: GpuOptions, wake: Wake) -> Self {
        let shared = Arc::new(Shared::default());
        let (outbox, answers) = channel();
        let project = files.project().map(ToOwned::to_owned);
        let seen = Arc::clone(&shared);
        let thread = std::thread::spawn(move || work(&files, &gpu, &seen, &outbox, &wake));
        Self {
            shared,
            answers,
            thread: Some(thread),
            project,
        }
    }

    pub(super) fn is_for(&self, files: &Files) -> bool {
        self.project.as_deref() == files.project()
    }

    pub(super) fn hold(&self) {
        self.shared.lock().busy_until = Some(Instant::now() + REST);
    }

    pub(super) fn order(
        &self,
        version: u64,
        small: impl Iterator<Item = Order>,
        large: Option<Order>,
    ) {
        let mut queue = self.shared.lock();
        queue.small.extend(small.map(|order| (version, order)));
        if let Some(order) = large {
            // Whatever waited for it is not wanted any more.
            queue.large = Some((version, order));
        }
        self.shared.changed.notify_one();
    }

    pub(super) fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.shared.lock().ends = true;
        self.shared.changed.notify_one();
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            tracing::error!("the thread that draws pictures of assets panicked");
        }
    }
}

/// What the thread does next.
enum Next {
    Draw {
        version: u64,
        order: Box<Order>,
        is_large: bool,
    },
    /// Nothing was wanted for long.
    Rest,
    End,
}

fn next(shared: &Shared) -> Next {
    let since = Instant::now();
    let mut queue = shared.lock();
    loop {
        if queue.ends {
            return Next::End;
        }
        if let Some((version, order)) = queue.large.take() {
            return Next::Draw {
                version,
                order: Box::new(order),
                is_large: true,
            };
        }
        let works = queue.busy_until.is_some_and(|until| until > Instant::now());
        if !works && let Some((version, order)) = queue.small.pop_front() {
            return Next::Draw {
                version,
                order: Box::new(order),
                is_large: false,
            };
        }
        if since.elapsed() > HELD && queue.small.is_empty() {
            return Next::Rest;
        }
        let wait = if queue.small.is_empty() { HELD } else { LOOK };
        let waited = shared.changed.wait_timeout(queue, wait);
        queue = waited.unwrap_or_else(PoisonError::into_inner).0;
    }
}

fn work(files: &Files, gpu: &GpuOptions, shared: &Shared, outbox: &Sender<Answer>, wake: &Wake) {
    // Opened for the first picture.
    let mut studio: Option<Result<Studio, String>> = None;
    loop {
        match next(shared) {
            Next::End => return,
            Next::Rest => studio = None,
            Next::Draw {
                version,
                order,
                is_large,
            } => {
                let studio = studio.get_or_insert_with(|| Studio::open(files, gpu));
                let pixels = match studio {
                    Ok(studio) => studio.draw(&order, version),
                    Err(why) => Err(why.clone()),
                };
                let key = order.key(version);
                let answer = Answer {
                    key,
                    is_large,
                    pixels,
                };
                if outbox.send(answer).is_err() {
                    return;
                }
                wake();
            }
        }
    }
}
