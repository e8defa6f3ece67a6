//! Progress on a terminal, and the end by Ctrl-C.

use std::io::IsTerminal as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use lightbench::assets::Progress;

/// How often the bar is painted.
const EVERY: Duration = Duration::from_millis(80);

/// A bar that follows a [`Progress`] until it is dropped. It is only there on a terminal.
pub struct Bar {
    thread: Option<JoinHandle<()>>,
    done: Arc<AtomicBool>,
}

impl Bar {
    /// Shows how far the work is.
    pub fn follow(progress: &Progress) -> Self {
        let done = Arc::new(AtomicBool::new(false));
        if !std::io::stderr().is_terminal() {
            return Self { thread: None, done };
        }
        let (seen, ended) = (progress.clone(), Arc::clone(&done));
        // Without a thread there is no bar, which is no reason to fail.
        let thread = thread::Builder::new()
            .name("progress".to_owned())
            .spawn(move || paint(&seen, &ended))
            .ok();
        Self { thread, done }
    }
}

fn paint(progress: &Progress, done: &AtomicBool) {
    let bar = ProgressBar::new(1000);
    if let Ok(style) =
        ProgressStyle::with_template("{bar:30} {percent:>3} %  {elapsed_precise}  {wide_msg}")
    {
        bar.set_style(style);
    }
    while !done.load(Ordering::Relaxed) {
        bar.set_position((progress.fraction() * 1000.0) as u64);
        bar.set_message(progress.label());
        thread::park_timeout(EVERY);
    }
    bar.finish_and_clear();
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            // The bar can only have failed to paint.
            let _ = thread.join();
        }
    }
}

/// What Ctrl-C stops; there is one handler in a process.
static RUNNING: Mutex<Option<Progress>> = Mutex::new(None);

/// Lets Ctrl-C stop the work in good order. A second one ends the program at once.
pub fn stop_on_ctrl_c(progress: &Progress) {
    let mut running = RUNNING.lock().unwrap_or_else(PoisonError::into_inner);
    if running.replace(progress.clone()).is_none() {
        // Without a handler Ctrl-C ends the program at once, which loses no file either.
        let _ = ctrlc::set_handler(|| {
            let running = RUNNING.lock().unwrap_or_else(PoisonError::into_inner);
            match &*running {
                Some(progress) if !progress.is_cancelled() => progress.cancel(),
                _ => std::process::exit(130),
            }
        });
    }
}
