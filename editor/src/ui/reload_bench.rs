//! How long it takes from saving a shader to the changed picture on the device.
//!
//! The way is the editor's own: the watcher notices the file, the worker compiles, the workbench
//! draws. Only the window is left out.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail, ensure};
use lightbench::assets::files::Files;
use lightbench::render::{Gpu, GpuOptions};

use super::EditorOptions;
use super::workbench::Workbench;

/// What is edited, and by what its last line is led.
const SHADER: &str = "shaders/deferred_shading/light.wgsl";
const RESULT: &str = "return vec4f(radiance";

/// Longer than any step may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// What to measure.
#[derive(Clone, Debug)]
pub struct ReloadBench {
    /// Which adapter draws.
    pub gpu: GpuOptions,
    /// Which scene is drawn, through deferred shading.
    pub scene: String,
    /// The picture's size in pixels.
    pub size: (u32, u32),
    /// How often the shader is saved.
    pub edits: usize,
}

impl Default for ReloadBench {
    fn default() -> Self {
        Self {
            gpu: GpuOptions::default(),
            scene: "atrium".to_owned(),
            size: (640, 360),
            edits: 100,
        }
    }
}

/// What was measured. Times are from the save to the end of the first frame on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct ReloadTimes {
    /// The adapter's name.
    pub adapter: String,
    /// Size in pixels of the last picture: on slow adapters the editor shows a change small first.
    pub drawn: (u32, u32),
    /// Milliseconds of each edit, in the order in which they were made.
    pub ms: Vec<f64>,
}

impl ReloadTimes {
    /// The time that a share of all edits (0.5 for the median) did not exceed, milliseconds: the
    /// nearest rank.
    pub fn percentile(&self, share: f64) -> f64 {
        let mut sorted = self.ms.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let rank = (share * sorted.len() as f64).ceil() as usize;
        sorted.get(rank.max(1) - 1).copied().unwrap_or(f64::NAN)
    }
}

impl std::fmt::Display for ReloadTimes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "save to changed picture, {} edits of {SHADER}, first shown at {} x {}, {}: median \
             {:.0} ms, p95 {:.0} ms, longest {:.0} ms",
            self.ms.len(),
            self.drawn.0,
            self.drawn.1,
            self.adapter,
            self.percentile(0.5),
            self.percentile(0.95),
            self.percentile(1.0),
        )
    }
}

/// Saves a shader of a temporary project again and again and measures each time.
/// `on_edit` is told how many edits are done.
///
/// # Errors
/// Without a driver, or when an edit does not change the picture.
pub fn reload(bench: &ReloadBench, mut on_edit: impl FnMut(usize)) -> anyhow::Result<ReloadTimes> {
    let folder = tempfile::tempdir().context("no place for a temporary project")?;
    let files = Files::with_project(folder.path())?;
    let path = files.copy_to_project(SHADER)?;
    let text = files.read_text(SHADER)?;
    ensure!(text.contains(RESULT), "`{RESULT}` is no longer in {SHADER}");

    let (woken, wakes) = channel();
    let wake = Arc::new(move || {
        // The bench may be over: nobody is left to wake.
        let _ = woken.send(());
    });
    let options = EditorOptions {
        scene: bench.scene.clone(),
        gpu: bench.gpu.clone(),
        ..EditorOptions::new(files)
    };
    let gpu = Gpu::open(&bench.gpu)?;
    let adapter = gpu.summary.name.clone();
    let mut workbench = Workbench::new(gpu, options, wake);
    until(&mut workbench, &wakes, |w| w.picture_ready())?;
    let mut before = draw(&mut workbench, bench.size)?;

    let mut ms = Vec::with_capacity(bench.edits);
    let mut drawn = bench.size;
    for edit in 0..bench.edits {
        let builds = workbench.pipelines.builds();
        // Every edit dims the picture by another amount.
        let share = 1.0 - 0.5 * (edit + 1) as f64 / (bench.edits + 1) as f64;
        let edited = text.replace(RESULT, &format!("return vec4f({share} * radiance"));
        let saved = Instant::now();
        std::fs::write(&path, edited).context("the temporary project can't be written")?;
        until(&mut workbench, &wakes, |w| w.pipelines.builds() > builds)?;
        workbench.draw(bench.size, Instant::now());
        workbench.gpu().wait(PATIENCE.as_secs())?;
        drawn = workbench.drawn_size().unwrap_or(drawn);
        ms.push(saved.elapsed().as_secs_f64() * 1e3);

        let after = draw(&mut workbench, bench.size)?;
        ensure!(after != before, "edit {edit} did not change the picture");
        before = after;
        on_edit(edit + 1);
    }
    Ok(ReloadTimes { adapter, drawn, ms })
}

/// Ticks when woken until something is true.
fn until(
    workbench: &mut Workbench,
    wakes: &Receiver<()>,
    done: impl Fn(&Workbench) -> bool,
) -> anyhow::Result<()> {
    let began = Instant::now();
    loop {
        workbench.tick(Instant::now());
        if let Some(problem) = workbench.problems().next() {
            bail!("{problem}");
        }
        if done(workbench) {
            return Ok(());
        }
        ensure!(
            began.elapsed() < PATIENCE,
            "nothing happened for {PATIENCE:?}"
        );
        match wakes.recv_timeout(Duration::from_millis(20)) {
            Ok(()) | Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => bail!("the workbench has ended"),
        }
    }
}

/// The bytes of the picture.
fn draw(workbench: &mut Workbench, size: (u32, u32)) -> anyhow::Result<Vec<u8>> {
    let picture = workbench.draw(size, Instant::now());
    let picture = picture.context("nothing is drawn")?;
    let bytes = lightbench::render::readback::read_bytes(workbench.gpu(), &picture.texture)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_nearest_ranks() {
        let times = ReloadTimes {
            adapter: String::new(),
            drawn: (1, 1),
            ms: vec![4.0, 1.0, 3.0, 2.0],
        };
        assert_eq!(times.percentile(0.5), 2.0);
        assert_eq!(times.percentile(0.95), 4.0);
        assert_eq!(times.percentile(0.0), 1.0);
    }
}
