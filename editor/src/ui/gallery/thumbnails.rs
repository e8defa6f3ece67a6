//! The pictures of the gallery: made by a thread with a device of its own, one after the other, and
//! only while nobody works.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::render::GpuOptions;

use self::draw::Studio;
use super::cards::{Card, Opens};
use super::kept_pictures::{self, Picture};
use crate::ui::messages::say;
use crate::ui::workbench::Wake;

mod draw;

/// How long a person must do nothing before the next picture is drawn.
const REST: Duration = Duration::from_millis(400);

/// How long a device is held for pictures that may be wanted yet.
const HELD: Duration = Duration::from_secs(10);

/// How often the thread looks whether that is so.
const LOOK: Duration = Duration::from_millis(50);

/// What is known of a picture.
pub enum State {
    /// It will be drawn.
    Waiting,
    /// It was drawn and goes to the device when it is shown.
    Drawn(Picture),
    /// It is there.
    There(TextureHandle),
    /// Why there is none.
    None(String),
}

struct Order {
    path: String,
    opens: Opens,
}

struct Answer {
    path: String,
    /// `None` where nobody wanted it any more.
    picture: Option<Result<Picture, String>>,
}

/// What both sides share.
struct Shared {
    /// Nothing is drawn before that.
    busy_until: Mutex<Instant>,
    wanted: AtomicBool,
    /// Stops what is being made.
    progress: Progress,
}

struct Worker {
    orders: Option<Sender<Order>>,
    answers: Receiver<Answer>,
    thread: Option<JoinHandle<()>>,
    project: Option<PathBuf>,
}

/// All pictures that were asked for.
#[derive(Default)]
pub struct Thumbnails {
    /// Where they are kept over restarts; without it they are not.
    pub folder: Option<PathBuf>,
    states: BTreeMap<String, State>,
    queue: Vec<Order>,
    shared: Option<Arc<Shared>>,
    worker: Option<Worker>,
}

/// The folder for pictures, by the habits of the system; `None` where it has no place for such.
pub fn default_folder() -> Option<PathBuf> {
    let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let folder = if cfg!(windows) {
        PathBuf::from(variable("LOCALAPPDATA")?)
    } else if cfg!(target_os = "macos") {
        PathBuf::from(variable("HOME")?).join("Library/Caches")
    } else {
        match variable("XDG_CACHE_HOME") {
            Some(folder) => PathBuf::from(folder),
            None => PathBuf::from(variable("HOME")?).join(".cache"),
        }
    };
    Some(folder.join("lightbench").join("gallery"))
}

impl Thumbnails {
    /// The picture of a card; one that is not there yet is asked for.
    pub fn of(&mut self, ctx: &Context, card: &Card) -> &State {
        let state = self.states.entry(card.path.clone()).or_insert_with(|| {
            if card.opens == Opens::Script {
                return State::None(say!("gallery.an_experiment").to_owned());
            }
            self.queue.push(Order {
                path: card.path.clone(),
                opens: card.opens,
            });
            State::Waiting
        });
        if let State::Drawn(picture) = state {
            let image = ColorImage::from_rgba_unmultiplied(picture.size, &picture.rgba);
            let texture = ctx.load_texture(&card.path, image, TextureOptions::LINEAR);
            *state = State::There(texture);
        }
        state
    }

    /// Asks for all pictures again, as for another device, on which they are lost.
    pub fn forget(&mut self) {
        self.states.clear();
    }

    /// Somebody works: nothing is drawn for a moment.
    pub fn hold(&self) {
        if let Some(shared) = &self.shared {
            let mut until = shared
                .busy_until
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            *until = Instant::now() + REST;
        }
    }

    /// Whether pictures are wanted at all.
    pub(super) fn set_wanted(&self, wanted: bool) {
        if let Some(shared) = &self.shared {
            shared.wanted.store(wanted, Ordering::Relaxed);
        }
    }

    /// Whether pictures are missing that will come.
    pub fn is_busy(&self) -> bool {
        let waits = |state: &State| matches!(state, State::Waiting);
        self.states.values().any(waits)
    }

    /// Hands out what was asked for and takes in what was drawn.
    pub(super) fn tend(&mut self, files: &Files, gpu: &GpuOptions, wake: &Wake) {
        let project = files.project().map(ToOwned::to_owned);
        if let Some(worker) = &self.worker
            && worker.project != project
        {
            self.stop();
            self.states.clear();
            self.queue.clear();
        }
        if self.worker.is_none() && !self.queue.is_empty() {
            self.start(files.clone(), gpu.clone(), wake.clone(), project);
        }
        let Some(worker) = &self.worker else {
            return;
        };
        for order in self.queue.drain(..) {
            if let Some(orders) = &worker.orders {
                // The thread ends with this side alone.
                let _ = orders.send(order);
            }
        }
        for answer in worker.answers.try_iter() {
            match answer.picture {
                Some(Ok(picture)) => self.states.insert(answer.path, State::Drawn(picture)),
                Some(Err(why)) => self.states.insert(answer.path, State::None(why)),
                None => self.states.remove(&answer.path),
            };
        }
    }

    fn start(&mut self, files: Files, gpu: GpuOptions, wake: Wake, project: Option<PathBuf>) {
        let shared = Arc::new(Shared {
            busy_until: Mutex::new(Instant::now()),
            wanted: AtomicBool::new(true),
            progress: Progress::new(),
        });
        let (orders, inbox) = channel();
        let (outbox, answers) = channel();
        let folder = self.folder.clone();
        let seen = Arc::clone(&shared);
        let thread = std::thread::spawn(move || {
            work(&files, &gpu, folder, &seen, &inbox, &outbox, &wake);
        });
        self.shared = Some(shared);
        self.worker = Some(Worker {
            orders: Some(orders),
            answers,
            thread: Some(thread),
            project,
        });
    }

    fn stop(&mut self) {
        if let Some(shared) = self.shared.take() {
            shared.progress.cancel();
            shared.wanted.store(false, Ordering::Relaxed);
        }
        if let Some(mut worker) = self.worker.take() {
            worker.orders = None;
            if let Some(thread) = worker.thread.take()
                && thread.join().is_err()
            {
                tracing::error!("the thread that draws the gallery panicked");
            }
        }
    }
}

impl Drop for Thumbnails {
    fn drop(&mut self) {
        self.stop();
    }
}

fn work(
    files: &Files,
    gpu: &GpuOptions,
    folder: Option<PathBuf>,
    shared: &Shared,
    inbox: &Receiver<Order>,
    outbox: &Sender<Answer>,
    wake: &Wake,
) {
    // Opened for the first picture that is not kept.
    let mut studio: Option<Result<Studio, String>> = None;
    loop {
        let Order { path, opens } = match inbox.recv_timeout(HELD) {
            Ok(order) => order,
            Err(RecvTimeoutError::Timeout) => {
                studio = None;
                continue;
            }
            Err(RecvTimeoutError::Disconnected) => return,
        };
        let what = format!("{opens:?} {path}");
        let kept = folder
            .as_ref()
            .and_then(|folder| kept_pictures::find(folder, files, &what));
        let picture = match kept {
            Some(picture) => Some(Ok(picture)),
            None if !wait_for_rest(shared) => None,
            None => {
                let studio = studio.get_or_insert_with(|| Studio::open(files, gpu));
                let drawn = match studio {
                    Ok(studio) => studio.draw(&path, opens, &shared.progress),
                    Err(why) => Err(why.clone()),
                };
                if let (Ok((picture, made_of)), Some(folder)) = (&drawn, &folder) {
                    kept_pictures::keep(folder, &what, made_of, picture);
                }
                Some(drawn.map(|(picture, _)| picture))
            }
        };
        if outbox.send(Answer { path, picture }).is_err() {
            return;
        }
        wake();
    }
}

/// Waits until nobody works. Returns whether pictures are still wanted then.
fn wait_for_rest(shared: &Shared) -> bool {
    loop {
        if !shared.wanted.load(Ordering::Relaxed) || shared.progress.is_cancelled() {
            return false;
        }
        let until = *shared
            .busy_until
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if Instant::now() >= until {
            return true;
        }
        std::thread::sleep(LOOK);
    }
}
