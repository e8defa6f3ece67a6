//! How long it takes from saving a shader to the changed picture on the device, and whether memory
//! grows with the saves.
//!
//! The way is the editor's own: the watcher notices the file, the worker compiles, the workbench
//! draws. Only the window is left out.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context as _, ensure};
use lightbench::assets::files::Files;
use lightbench::lab::measure::resident_bytes;

use super::{BenchOptions, Session, percentile};

/// What is edited, and by what its last line is led.
const SHADER: &str = "shaders/deferred_shading/light.wgsl";
const RESULT: &str = "return vec4f(radiance";

/// After how many reloads memory is first looked at: caches are full by then.
const SETTLED: usize = 50;
/// Memory goes up and down by some per cent with what a compilation needs for a moment, so it is looked
/// at after each of so many reloads, and the median is taken.
const LOOKS: usize = 20;

/// What was measured. Times are from the save to the end of the first frame on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct ReloadTimes {
    /// The adapter's name.
    pub adapter: String,
    /// Size in pixels of the last picture: on slow adapters the editor shows a change small first.
    pub drawn: (u32, u32),
    /// Milliseconds of each save of a text that no driver has seen before, in order.
    pub new_ms: Vec<f64>,
    /// Milliseconds of each save of the text before that one, again.
    pub seen_ms: Vec<f64>,
    /// Bytes of memory after each pair of saves; empty where the system does not tell.
    pub memory: Vec<f64>,
}

impl std::fmt::Display for ReloadTimes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (width, height) = self.drawn;
        writeln!(
            f,
            "save to changed picture, {SHADER}, first shown at {width} x {height}, {}",
            self.adapter
        )?;
        for (what, ms) in [
            ("new text", &self.new_ms),
            ("text seen before", &self.seen_ms),
        ] {
            writeln!(
                f,
                "  {what:16}  {:4} saves: median {:4.0} ms, p95 {:4.0} ms, longest {:4.0} ms",
                ms.len(),
                percentile(ms, 0.5),
                percentile(ms, 0.95),
                percentile(ms, 1.0),
            )?;
        }
        match self.settled_memory() {
            Some((settled, end)) => write!(
                f,
                "  memory: {:.1} MiB after {SETTLED} reloads, {:.1} MiB after {}, {:+.1} %; medians \
                 of {LOOKS} reloads",
                settled / f64::from(1 << 20),
                end / f64::from(1 << 20),
                self.new_ms.len() + self.seen_ms.len(),
                (end / settled - 1.0) * 100.0,
            ),
            None => write!(
                f,
                "  memory: looked at only after {} reloads",
                SETTLED + LOOKS
            ),
        }
    }
}

impl ReloadTimes {
    /// Bytes after the first [`SETTLED`] reloads and after all, if there were enough of them.
    fn settled_memory(&self) -> Option<(f64, f64)> {
        let looks = LOOKS / 2;
        let first = self.memory.get(SETTLED / 2..SETTLED / 2 + looks)?;
        let last = self.memory.last_chunk::<{ LOOKS / 2 }>()?;
        Some((percentile(first, 0.5), percentile(last, 0.5)))
    }
}

/// Saves a shader of a temporary project again and again, each time with a new text and then with
/// the one before, and measures both. `on_edit` is told how many new texts are done.
///
/// # Errors
/// Without a driver, or when a save does not change the picture.
pub fn reload(
    options: &BenchOptions,
    edits: usize,
    mut on_edit: impl FnMut(usize),
) -> anyhow::Result<ReloadTimes> {
    let folder = tempfile::tempdir().context("no place for a temporary project")?;
    let files = Files::with_project(folder.path())?;
    let path = files.copy_to_project(SHADER)?;
    let text = files.read_text(SHADER)?;
    ensure!(text.contains(RESULT), "`{RESULT}` is no longer in {SHADER}");
    // Every text dims the picture by another amount.
    let variant = |edit: usize| {
        let share = 1.0 - 0.5 * edit as f64 / (edits + 1) as f64;
        text.replace(RESULT, &format!("return vec4f({share} * radiance"))
    };

    let mut session = Session::open(options, files)?;
    save(&mut session, &path, &variant(0))?;
    let mut times = ReloadTimes {
        adapter: session.adapter.clone(),
        drawn: options.size,
        new_ms: Vec::with_capacity(edits),
        seen_ms: Vec::with_capacity(edits),
        memory: Vec::with_capacity(edits),
    };
    for edit in 1..=edits {
        times
            .new_ms
            .push(save(&mut session, &path, &variant(edit))?);
        times
            .seen_ms
            .push(save(&mut session, &path, &variant(edit - 1))?);
        times
            .memory
            .extend(resident_bytes().map(|bytes| bytes as f64));
        on_edit(edit);
    }
    times.drawn = session.workbench.drawn_size().unwrap_or(options.size);
    Ok(times)
}

/// Saves a text and gives the milliseconds until it is on screen.
fn save(session: &mut Session, path: &Path, text: &str) -> anyhow::Result<f64> {
    let before = session.picture()?;
    let swaps = session.workbench.pipelines.swaps();
    let saved = Instant::now();
    std::fs::write(path, text).context("the temporary project can't be written")?;
    session.until(|w| w.pipelines.swaps() > swaps && w.picture_is_current())?;
    session.finish()?;
    let ms = saved.elapsed().as_secs_f64() * 1e3;
    ensure!(
        session.picture()? != before,
        "a save did not change the picture"
    );
    Ok(ms)
}
