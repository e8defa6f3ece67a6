//! The editor measures itself, without a window: the workbench ticks and draws as it does there.

pub mod reload;
pub mod scene;
pub mod swap;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail, ensure};
use lightbench::assets::files::Files;
use lightbench::render::{Gpu, GpuOptions};

use super::EditorOptions;
use super::workbench::Workbench;

/// How long to wait where nothing is due.
const PAUSE: Duration = Duration::from_millis(20);

/// Longer than any step may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// What all benchmarks of the editor need.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// Which adapter draws.
    pub gpu: GpuOptions,
    /// Which scene is drawn.
    pub scene: String,
    /// The picture's size in pixels.
    pub size: (u32, u32),
}

/// A workbench that runs as in a window.
struct Session {
    workbench: Workbench,
    wakes: Receiver<()>,
    size: (u32, u32),
    adapter: String,
    /// The longest time that one tick and draw took: for so long no widget could answer.
    longest_pause: Duration,
}

impl Session {
    /// Opens a scene through deferred shading, and waits for its picture.
    fn open(options: &BenchOptions, files: Files) -> anyhow::Result<Self> {
        let (woken, wakes) = channel();
        let wake = Arc::new(move || {
            // The benchmark may be over: nobody is left to wake.
            let _ = woken.send(());
        });
        let editor = EditorOptions {
            scene: options.scene.clone(),
            gpu: options.gpu.clone(),
            ..EditorOptions::new(files)
        };
        let gpu = Gpu::open(&options.gpu)?;
        let adapter = gpu.summary.name.clone();
        let mut this = Self {
            workbench: Workbench::new(gpu, editor, wake),
            wakes,
            size: options.size,
            adapter,
            longest_pause: Duration::ZERO,
        };
        this.until(|workbench| workbench.drawn_size().is_some())?;
        Ok(this)
    }

    /// One tick and draw.
    fn step(&mut self) -> anyhow::Result<()> {
        let began = Instant::now();
        self.workbench.tick(began);
        if let Some(problem) = self.workbench.problems().next() {
            bail!("{problem}");
        }
        self.workbench.draw(self.size, Instant::now());
        self.longest_pause = self.longest_pause.max(began.elapsed());
        Ok(())
    }

    /// Steps until something is true, and waits between the steps as a window does.
    fn until(&mut self, done: impl Fn(&Workbench) -> bool) -> anyhow::Result<()> {
        let began = Instant::now();
        loop {
            self.step()?;
            if done(&self.workbench) {
                return Ok(());
            }
            ensure!(
                began.elapsed() < PATIENCE,
                "nothing happened for {PATIENCE:?}"
            );
            let patience = self.workbench.next_due(Instant::now()).unwrap_or(PAUSE);
            match self.wakes.recv_timeout(patience.min(PAUSE)) {
                Ok(()) | Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => bail!("the workbench has ended"),
            }
        }
    }

    /// Waits until the device has done everything.
    fn finish(&self) -> anyhow::Result<()> {
        Ok(self.workbench.gpu().wait(PATIENCE.as_secs())?)
    }

    /// The bytes of the picture on screen.
    fn picture(&mut self) -> anyhow::Result<Vec<u8>> {
        let picture = self.workbench.picture().context("nothing is drawn")?;
        let gpu = self.workbench.gpu();
        Ok(lightbench::render::readback::read_bytes(
            gpu,
            &picture.texture,
        )?)
    }
}

/// The number that a share of all (0.5 for the median) does not exceed: the nearest rank.
fn percentile(numbers: &[f64], share: f64) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_nearest_ranks() {
        let numbers = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(percentile(&numbers, 0.5), 2.0);
        assert_eq!(percentile(&numbers, 0.95), 4.0);
        assert_eq!(percentile(&numbers, 0.0), 1.0);
        assert!(percentile(&[], 0.5).is_nan());
    }
}
