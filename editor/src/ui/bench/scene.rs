//! How long it takes from saving a scene's script to the changed picture on the device, beside what
//! a load takes that can reuse nothing.
//!
//! The way is the editor's own: the watcher notices the file, the loader runs the script, the
//! workbench draws. Only the window is left out.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context as _, bail, ensure};
use lightbench::assets::Progress;
use lightbench::assets::cache::Cache;
use lightbench::assets::files::Files;
use lightbench::lab::measure::load_average;
use lightbench::script::{Limits, Scene, Settings, load_scene_within};
use lightbench::world::SystemTime;

use super::{BenchOptions, Session, percentile};

/// What was measured. A save is timed from the write to the end of the first frame on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneTimes {
    /// The adapter's name.
    pub adapter: String,
    /// The scene's name.
    pub scene: String,
    /// Size in pixels of the last picture: on slow adapters the editor shows a change small first.
    pub drawn: (u32, u32),
    /// Milliseconds of each save while the scene's time stands still.
    pub still_ms: Vec<f64>,
    /// Milliseconds of each save while the scene moves, when a frame that began before the save may
    /// keep the device busy. Empty for scenes that do not move.
    pub moving_ms: Vec<f64>,
    /// Loads that could reuse nothing.
    pub whole: Loads,
    /// Loads that could reuse what the one before has made.
    pub again: Loads,
    /// How many programs wanted a core, on average over the last minute.
    pub load_average: Option<f64>,
}

/// Loads by themselves, without a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Loads {
    /// Milliseconds that passed in each.
    pub ms: Vec<f64>,
    /// Milliseconds of the loading thread alone, without the threads that it shares work with.
    pub thread_ms: Vec<f64>,
}

impl Loads {
    fn add(&mut self, load: impl FnOnce() -> anyhow::Result<Scene>) -> anyhow::Result<Scene> {
        let began = Instant::now();
        let (time, scene) = SystemTime::of("load", load);
        self.ms.push(began.elapsed().as_secs_f64() * 1e3);
        self.thread_ms.push(time.thread_ms());
        scene
    }
}

impl std::fmt::Display for SceneTimes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (width, height) = self.drawn;
        write!(
            f,
            "{}, save to changed picture, first shown at {width} x {height}, {}",
            self.scene, self.adapter
        )?;
        let mut line = |what: &str, ms: &[f64]| {
            write!(
                f,
                "\n  {what:36}  {:4} times: median {:6.1} ms, p95 {:6.1} ms, longest {:6.1} ms",
                ms.len(),
                percentile(ms, 0.5),
                percentile(ms, 0.95),
                percentile(ms, 1.0),
            )
        };
        line("save to picture, time stands still", &self.still_ms)?;
        if !self.moving_ms.is_empty() {
            line("save to picture, the scene moves", &self.moving_ms)?;
        }
        line("a load that reuses nothing", &self.whole.ms)?;
        line("  its thread alone", &self.whole.thread_ms)?;
        line("a load after a save", &self.again.ms)?;
        line("  its thread alone", &self.again.thread_ms)?;
        match self.load_average {
            Some(average) => write!(f, "\n  load average: {average:.2}"),
            None => Ok(()),
        }
    }
}

/// Saves the script of a scene again and again, each time with another number in it, and measures.
/// It is a copy in a temporary project, with all scripts that it is made of. `on_edit` is told how
/// many saves are done.
///
/// # Errors
/// Without a driver, for a scene that is no script, or when a save does not change the picture.
pub fn scene(
    options: &BenchOptions,
    files: &Files,
    edits: usize,
    mut on_edit: impl FnMut(usize),
) -> anyhow::Result<SceneTimes> {
    let folder = tempfile::tempdir().context("no place for a temporary project")?;
    let project = Files::with_project(folder.path())?;
    let original = load(files, &options.scene, &Cache::default())?;
    if !original.path.ends_with(".rhai") {
        bail!("`{}` is no script", original.path);
    }
    for path in original.files() {
        project.write(&path, &files.read(&path)?)?;
    }
    let script = original.path.clone();
    drop(original);
    let text = project.read_text(&script)?;
    let on_disk = folder.path().join(&script);
    // A faint light from everywhere, each time of another strength.
    let variant = |edit: usize| {
        let strength = 0.02 + 0.02 * edit as f64 / (edits + 1) as f64;
        format!("{text}\nambient_light(\"number\").intensity({strength});\n")
    };

    std::fs::write(&on_disk, variant(0)).context("the temporary project can't be written")?;
    let mut times = SceneTimes {
        adapter: String::new(),
        scene: options.scene.clone(),
        drawn: options.size,
        still_ms: Vec::with_capacity(edits),
        moving_ms: Vec::new(),
        whole: Loads::default(),
        again: Loads::default(),
        load_average: None,
    };
    let mut cache = Cache::default();
    for _ in 0..edits.clamp(3, 20) {
        cache = Cache::default();
        times.whole.add(|| load(&project, &script, &cache))?;
    }
    for edit in 0..edits {
        std::fs::write(&on_disk, variant(edit))?;
        times.again.add(|| load(&project, &script, &cache))?;
    }
    drop(cache);
    std::fs::write(&on_disk, variant(0))?;
    let options = BenchOptions {
        scene: script,
        ..options.clone()
    };
    let mut session = Session::open(&options, project)?;
    times.adapter = session.adapter.clone();
    let moves = std::mem::take(&mut session.workbench.clock.playing);
    for edit in 1..=edits {
        let ms = save(&mut session, &on_disk, &variant(edit))?;
        times.still_ms.push(ms);
        on_edit(edit);
    }
    session.workbench.clock.playing = moves;
    for edit in (0..edits).filter(|_| moves) {
        let ms = save(&mut session, &on_disk, &variant(edit))?;
        times.moving_ms.push(ms);
    }
    times.drawn = session.workbench.drawn_size().unwrap_or(options.size);
    times.load_average = load_average();
    Ok(times)
}

fn load(files: &Files, scene: &str, cache: &Cache) -> anyhow::Result<Scene> {
    let (settings, progress, limits) = (Settings::new(), Progress::new(), Limits::default());
    let loaded = load_scene_within(files, scene, &settings, &progress, cache, &limits);
    Ok(loaded?)
}

/// Saves a text and gives the milliseconds until it is on screen.
fn save(session: &mut Session, path: &Path, text: &str) -> anyhow::Result<f64> {
    let before = session.picture()?;
    let swaps = session.workbench.scenes.swaps();
    let saved = Instant::now();
    std::fs::write(path, text).context("the temporary project can't be written")?;
    session.until(|w| w.scenes.swaps() > swaps && w.picture_is_current())?;
    session.finish()?;
    let ms = saved.elapsed().as_secs_f64() * 1e3;
    ensure!(
        session.picture()? != before,
        "a save did not change the picture"
    );
    Ok(ms)
}
