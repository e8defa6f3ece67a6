//! How many pixels the viewport draws, so that widgets stay quick on slow adapters.
//!
//! While something moves, the scale follows the time that frames take. At rest the picture is
//! drawn once more at full size.

/// Scales of width and height. Few of them, since each change allocates the targets anew.
const STEPS: [f32; 6] = [1.0, 0.75, 0.5, 0.375, 0.25, 0.1875];

/// Milliseconds that a frame may take while something moves.
const TARGET_MS: f64 = 45.0;

/// Frames that must agree before the scale rises again.
const PATIENCE: u32 = 8;

/// Chooses the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Whether the scale adapts; else it is always 1.
    pub adaptive: bool,
    step: usize,
    fast_frames: u32,
}

impl Resolution {
    /// Adaptive on adapters that draw with the processor.
    pub fn new(software: bool) -> Self {
        Self {
            adaptive: software,
            // A first guess that is seldom too slow; it rises within a few frames.
            step: if software { 2 } else { 0 },
            fast_frames: 0,
        }
    }

    /// The factor for width and height, while moving or at rest.
    pub fn scale(&self, moving: bool) -> f32 {
        if self.adaptive && moving {
            STEPS[self.step]
        } else {
            1.0
        }
    }

    /// Takes note that a frame of `scale` took `ms` on the GPU.
    pub fn measured(&mut self, scale: f32, ms: f64) {
        if !self.adaptive || scale != STEPS[self.step] {
            return;
        }
        let cost = |step: usize| ms * f64::from((STEPS[step] / scale).powi(2));
        if ms > TARGET_MS * 1.25 {
            let fits = (self.step..STEPS.len()).find(|step| cost(*step) <= TARGET_MS);
            self.step = fits.unwrap_or(STEPS.len() - 1);
            self.fast_frames = 0;
        } else if self.step > 0 && cost(self.step - 1) < TARGET_MS * 0.9 {
            self.fast_frames += 1;
            if self.fast_frames >= PATIENCE {
                self.step -= 1;
                self.fast_frames = 0;
            }
        } else {
            self.fast_frames = 0;
        }
    }

    /// The size in pixels for a viewport of `size` at `scale`.
    pub fn apply(size: (u32, u32), scale: f32) -> (u32, u32) {
        let scaled = |length: u32| ((length as f32 * scale).round() as u32).max(1);
        (scaled(size.0), scaled(size.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A driver that needs `full_ms` for a frame at scale 1.
    fn settle(full_ms: f64) -> f32 {
        let mut resolution = Resolution::new(true);
        for _ in 0..200 {
            let scale = resolution.scale(true);
            resolution.measured(scale, full_ms * f64::from(scale * scale));
        }
        resolution.scale(true)
    }

    #[test]
    fn the_scale_settles_where_frames_fit() {
        assert_eq!(settle(10.0), 1.0);
        assert_eq!(settle(150.0), 0.5);
        assert_eq!(settle(1e6), 0.1875);
    }

    #[test]
    fn at_rest_and_on_graphics_cards_every_pixel_is_drawn() {
        let mut resolution = Resolution::new(true);
        resolution.measured(resolution.scale(true), 900.0);
        assert!(resolution.scale(true) < 0.5);
        assert_eq!(resolution.scale(false), 1.0);
        let mut card = Resolution::new(false);
        card.measured(1.0, 900.0);
        assert_eq!(card.scale(true), 1.0);
        assert_eq!(Resolution::apply((637, 3), 0.1875), (119, 1));
    }
}
