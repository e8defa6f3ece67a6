//! What comes back from the device some frames later.

use std::time::Instant;

use lightbench::render::GpuError;

use super::Workbench;
use super::viewports::Viewport;
use crate::ui::messages::say;

impl Workbench {
    pub(super) fn take_measurements(&mut self) {
        match self.renderer.poll() {
            Ok(results) => {
                let mut results = results.to_vec();
                self.measured_beside(&mut results);
                let now = Instant::now();
                self.measured_second(&mut results, now);
                if let Some((mine, grew)) = self.comparing.take_measured(&results) {
                    results = mine;
                    if grew {
                        self.canvas.invalidate();
                    }
                }
                let results = results.as_slice();
                if let Some(pipeline) = self.pipelines.shown_pipeline()
                    && pipeline.grow(results)
                {
                    self.canvas.invalidate();
                }
                for measured in results {
                    if self.timings.measured(measured) {
                        self.trends.measured(now, measured);
                    }
                    if let Some((scale, ms)) = self.canvas.measured(measured) {
                        let ms = ms + self.comparing.beside_ms();
                        self.guide_resolution(Viewport::First, scale, ms, now);
                    }
                }
            }
            Err(error) => self.device_failed(error),
        }
        self.take_probed();
        self.take_measured();
        self.take_lighting();
        for warning in self.renderer.take_warnings() {
            self.log.warn(warning);
        }
    }

    /// Takes note of the milliseconds that a viewport's frame took. Where the other one moves too, its
    /// frames must fit into the same time.
    pub(super) fn guide_resolution(
        &mut self,
        viewport: Viewport,
        scale: f32,
        ms: f64,
        now: Instant,
    ) {
        let other = self.canvas_of(viewport.other());
        let other = other.cost_at(scale).filter(|_| other.is_moving(now));
        self.resolution.measured(scale, ms + other.unwrap_or(0.0));
    }

    pub(super) fn device_failed(&mut self, error: GpuError) {
        if let GpuError::Lost(reason) = &error {
            if self.lost.is_none() {
                self.log.error(say!(
                    "returning.the_graphics_device_was_lost",
                    reason = reason
                ));
            }
            self.lost = Some(reason.clone());
        } else {
            self.log.error(error.to_string());
        }
    }
}
