//! Frames and what they take.

use std::time::Instant;

use cpu_time::ProcessTime;
use lightbench::render::Pipeline;
use lightbench_tests::Studio;

use crate::SIZE;

/// What frames took, in milliseconds, from the beginning of recording until the device was idle.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// By the clock on the wall.
    pub wall: Vec<f64>,
    /// Processor time of all threads of the process.
    pub processor: Vec<f64>,
}

impl Times {
    /// Draws a frame and takes its time.
    pub fn take(&mut self, draw: impl FnOnce()) {
        let (wall, processor) = (Instant::now(), ProcessTime::now());
        draw();
        self.wall.push(wall.elapsed().as_secs_f64() * 1e3);
        self.processor.push(processor.elapsed().as_secs_f64() * 1e3);
    }

    /// The times by which a pipeline is judged. A software driver draws with the processor: its time
    /// says as much as the clock, and what else the machine does disturbs it less.
    pub fn judged(&self, software: bool) -> &[f64] {
        match software {
            true => &self.processor,
            false => &self.wall,
        }
    }

    /// Forgets the first frames, in which the driver compiled and buffers grew.
    pub fn warm(&mut self, frames: usize) {
        self.wall.drain(..frames.min(self.wall.len()));
        self.processor.drain(..frames.min(self.processor.len()));
    }
}

/// Draws one frame of the scene as it stands, and waits until the device is idle.
pub fn draw(studio: &mut Studio, pipeline: &mut Pipeline) {
    draw_at(studio, pipeline, SIZE);
}

/// The same, at another width and height.
pub fn draw_at(studio: &mut Studio, pipeline: &mut Pipeline, size: (u32, u32)) {
    let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
    studio.renderer.set_frame_index(0);
    studio
        .renderer
        .render(world, assets, pipeline, &studio.view, size, 0.0)
        .unwrap();
    let measured = studio.renderer.finish(60).unwrap();
    pipeline.grow(&measured);
}

/// Draws so many frames of each pipeline, in turn; who begins changes from frame to frame.
pub fn in_turn(studio: &mut Studio, pipelines: &mut [Pipeline], frames: usize) -> Vec<Times> {
    let mut times = vec![Times::default(); pipelines.len()];
    for frame in 0..frames + 2 {
        for turn in 0..pipelines.len() {
            let index = (frame + turn) % pipelines.len();
            times[index].take(|| draw(studio, &mut pipelines[index]));
        }
    }
    times.iter_mut().for_each(|times| times.warm(2));
    times
}
