//! What a script may use, and the watch that stops it when it wants more.
//!
//! Scripts come from strangers. Rhai itself bounds single values and counts operations; the watch
//! adds the two things that it can't see: the clock, and the memory of everything together.

mod given;

use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use lightbench_assets::Progress;
use rhai::{Dynamic, Engine};

use crate::memory;

pub use given::GivenLimits;

/// The bounds within which a script runs. Each one ends the script with a sentence that names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Operations (roughly: expressions and calls) of one run: a load, or one update.
    pub operations: u64,
    /// How deep functions may call each other.
    pub call_depth: usize,
    /// How deep expressions and blocks may be nested.
    pub nesting: usize,
    /// Bytes of text that one value holds, at any depth.
    pub text_bytes: usize,
    /// Elements of arrays that one value holds, at any depth. Rhai counts them all after each call
    /// that may have changed the value.
    pub array_elements: usize,
    /// Entries of maps that one value holds, at any depth.
    pub map_entries: usize,
    /// Variables alive at the same time.
    pub variables: usize,
    /// Functions of one file.
    pub functions: usize,
    /// Files that one script may import, directly and indirectly.
    pub modules: usize,
    /// Bytes of one script file.
    pub file_bytes: usize,
    /// Wall time of loading a file. Time spent in reading models, making meshes and painting
    /// textures is free.
    pub load_time: Duration,
    /// Wall time of one update.
    pub update_time: Duration,
    /// Bytes that all values of a run may hold together, without its meshes and textures. Counted only in programs that use
    /// [`CountingAllocator`](crate::CountingAllocator).
    pub memory_bytes: usize,
    /// Entities that a scene may hold.
    pub entities: usize,
    /// Triangles that the meshes of a scene may hold together.
    pub triangles: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            operations: 50_000_000,
            call_depth: 64,
            nesting: 64,
            text_bytes: 4 << 20,
            array_elements: 1_000_000,
            map_entries: 200_000,
            variables: 10_000,
            functions: 1_000,
            modules: 64,
            file_bytes: 1 << 20,
            load_time: Duration::from_secs(10),
            update_time: Duration::from_secs(1),
            memory_bytes: 256 << 20,
            entities: 1_000_000,
            triangles: 50_000_000,
        }
    }
}

/// Why a run was ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The clock ran out.
    Time,
    /// The values took too much memory.
    Memory,
    /// The host asked for it.
    Cancelled,
}

/// Watches one run at a time. Shared between the host, the engine's progress callback and the
/// functions whose time is free.
#[derive(Debug)]
pub(crate) struct Watch {
    epoch: Instant,
    /// Nanoseconds after `epoch` at which the run must have ended.
    deadline: AtomicU64,
    /// Live bytes of the thread when the run began.
    bytes_at_start: AtomicI64,
    memory_bytes: i64,
    /// Through which the host stops the load.
    progress: OnceLock<Progress>,
    /// Whether the load is over: what happens to its progress later stops nothing.
    loaded: AtomicBool,
}

impl Watch {
    pub(crate) fn new(limits: &Limits) -> Arc<Self> {
        Arc::new(Self {
            epoch: Instant::now(),
            deadline: AtomicU64::new(u64::MAX),
            bytes_at_start: AtomicI64::new(0),
            memory_bytes: i64::try_from(limits.memory_bytes).unwrap_or(i64::MAX),
            progress: OnceLock::new(),
            loaded: AtomicBool::new(false),
        })
    }

    /// Starts a run that may last `time`.
    pub(crate) fn start(&self, time: Duration) {
        let deadline = self.epoch.elapsed().saturating_add(time).as_nanos();
        self.deadline.store(
            u64::try_from(deadline).unwrap_or(u64::MAX),
            Ordering::Relaxed,
        );
        self.bytes_at_start
            .store(memory::live_bytes(), Ordering::Relaxed);
    }

    /// Runs engine work whose time and memory are not the script's.
    pub(crate) fn free_of_charge<T>(&self, work: impl FnOnce() -> T) -> T {
        let (start, bytes) = (Instant::now(), memory::live_bytes());
        let result = work();
        self.bytes_at_start
            .fetch_add(memory::live_bytes() - bytes, Ordering::Relaxed);
        let spent = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
        // Saturating: a deadline of `u64::MAX` means that there is none.
        let deadline = self.deadline.load(Ordering::Relaxed).saturating_add(spent);
        self.deadline.store(deadline, Ordering::Relaxed);
        result
    }

    /// Ends runs when `progress` is cancelled, until [`Watch::loaded`] is called.
    pub(crate) fn stop_with(&self, progress: &Progress) {
        // The first one stays; there is one for each engine.
        let _ = self.progress.set(progress.clone());
    }

    /// The load is over. A task that is dropped with its result taken cancels its progress.
    pub(crate) fn loaded(&self) {
        self.loaded.store(true, Ordering::Relaxed);
    }

    /// Whether the time is over. For single calls that work on much.
    pub(crate) fn is_late(&self) -> bool {
        let now = u64::try_from(self.epoch.elapsed().as_nanos()).unwrap_or(u64::MAX);
        now > self.deadline.load(Ordering::Relaxed)
    }

    fn check(&self, operations: u64) -> Option<Stop> {
        let used = memory::live_bytes() - self.bytes_at_start.load(Ordering::Relaxed);
        if used > self.memory_bytes {
            return Some(Stop::Memory);
        }
        // Asking for the time costs more than an operation.
        if operations.is_multiple_of(128) {
            let cancelled = || self.progress.get().is_some_and(Progress::is_cancelled);
            if !self.loaded.load(Ordering::Relaxed) && cancelled() {
                return Some(Stop::Cancelled);
            }
            if self.is_late() {
                return Some(Stop::Time);
            }
        }
        None
    }
}

/// Makes `engine` obey the limits.
pub(crate) fn apply(engine: &mut Engine, limits: &Limits, watch: &Arc<Watch>) {
    engine
        .set_max_operations(limits.operations)
        .set_max_call_levels(limits.call_depth)
        .set_max_expr_depths(limits.nesting, limits.nesting)
        .set_max_string_size(limits.text_bytes)
        .set_max_array_size(limits.array_elements)
        .set_max_map_size(limits.map_entries)
        .set_max_variables(limits.variables)
        .set_max_functions(limits.functions)
        .set_max_modules(limits.modules);
    let watch = Arc::clone(watch);
    engine.on_progress(move |operations| watch.check(operations).map(Dynamic::from));
}

/// The sentence for a run that the watch ended.
pub(crate) fn sentence(stop: Stop, limits: &Limits) -> String {
    match stop {
        Stop::Time => "the script takes too long: is there a loop that never ends?".to_owned(),
        Stop::Memory => format!(
            "the script's values take more than {} MiB together: does an array or a text grow \
             without end?",
            limits.memory_bytes >> 20
        ),
        Stop::Cancelled => "the script was stopped".to_owned(),
    }
}
