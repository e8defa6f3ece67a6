//! What comes back from the device some frames later.

use std::time::Instant;

use lightbench::render::GpuError;

use super::Workbench;
use crate::ui::messages::say;

impl Workbench {
    pub(super) fn take_measurements(&mut self) {
        match self.renderer.poll() {
            Ok(results) => {
                let mut results = results.to_vec();
                self.measured_beside(&mut results);
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
                let beside = self.comparing.beside_ms();
                for measured in results {
                    if self.timings.measured(measured) {
                        self.trends.measured(Instant::now(), measured);
                    }
                    if let Some((scale, ms)) = self.canvas.measured(measured) {
                        self.resolution.measured(scale, ms + beside);
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
