//! What comes back from the device: what frames cost, warnings, and that it failed.

use lightbench::render::GpuError;

use super::Workbench;

impl Workbench {
    /// Takes in what the device has measured since.
    pub(super) fn take_measurements(&mut self) {
        match self.renderer.poll() {
            Ok(results) => {
                let others = self.comparing.take_measured(results);
                let results = match &others {
                    Some((mine, grew)) => {
                        if *grew {
                            self.canvas.invalidate();
                        }
                        mine.as_slice()
                    }
                    None => results,
                };
                if let Some(pipeline) = self.pipelines.shown_pipeline()
                    && pipeline.grow(results)
                {
                    self.canvas.invalidate();
                }
                let beside = self.comparing.beside_ms();
                for measured in results {
                    self.timings.measured(measured);
                    if let Some((scale, ms)) = self.canvas.measured(measured) {
                        self.resolution.measured(scale, ms + beside);
                    }
                }
            }
            Err(error) => self.device_failed(error),
        }
        self.take_probed();
        for warning in self.renderer.take_warnings() {
            self.log.warn(warning);
        }
    }

    pub(super) fn device_failed(&mut self, error: GpuError) {
        if let GpuError::Lost(reason) = &error {
            if self.lost.is_none() {
                self.log
                    .error(format!("The graphics device was lost: {reason}"));
            }
            self.lost = Some(reason.clone());
        } else {
            self.log.error(error.to_string());
        }
    }
}
