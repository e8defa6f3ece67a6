//! Samples of pixels, their means, and how far off these may be.

use glam::DVec3;

use crate::HdrImage;

/// What the samples of a pixel add up to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    sum: DVec3,
    squares: DVec3,
    samples: u32,
    unusable: u32,
}

impl Pixel {
    /// Adds one. A value that is infinite or no number would spoil the pixel; it is counted and left
    /// out.
    pub fn add(&mut self, radiance: DVec3) {
        if !radiance.is_finite() {
            self.unusable += 1;
            return;
        }
        self.sum += radiance;
        self.squares += radiance * radiance;
        self.samples += 1;
    }

    /// How many samples it has.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// How many had to be left out.
    pub fn unusable(&self) -> u32 {
        self.unusable
    }

    fn mean(&self) -> DVec3 {
        self.sum / f64::from(self.samples.max(1))
    }

    /// The variance of the mean, from that of the samples; 0 where there is one sample.
    fn variance(&self) -> DVec3 {
        if self.samples < 2 {
            return DVec3::ZERO;
        }
        let count = f64::from(self.samples);
        let spread = self.squares / count - self.mean() * self.mean();
        spread.max(DVec3::ZERO) / (count - 1.0)
    }
}

/// The means of all pixels.
pub fn picture(pixels: &[Pixel], size: (u32, u32)) -> HdrImage {
    image(pixels, size, Pixel::mean)
}

/// The variances of these means: their square root is the standard error.
pub fn variance(pixels: &[Pixel], size: (u32, u32)) -> HdrImage {
    image(pixels, size, Pixel::variance)
}

fn image(
    pixels: &[Pixel],
    (width, height): (u32, u32),
    value: impl Fn(&Pixel) -> DVec3,
) -> HdrImage {
    let pixels = pixels.iter().map(|pixel| {
        let [red, green, blue] = value(pixel).as_vec3().to_array();
        [red, green, blue, 1.0]
    });
    HdrImage {
        width,
        height,
        pixels: pixels.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_variance_are_those_of_the_samples() {
        let mut pixel = Pixel::default();
        let samples = [1.0, 4.0, 2.0, 7.0, 1.0];
        for sample in samples {
            pixel.add(DVec3::new(sample, 2.0 * sample, 3.0));
        }
        pixel.add(DVec3::new(f64::NAN, 0.0, 0.0));
        let mean = samples.iter().sum::<f64>() / 5.0;
        let spread = samples
            .map(|sample| (sample - mean).powi(2))
            .iter()
            .sum::<f64>()
            / 4.0;
        assert!((pixel.mean() - DVec3::new(mean, 2.0 * mean, 3.0)).length() < 1e-12);
        let expected = DVec3::new(spread / 5.0, 4.0 * spread / 5.0, 0.0);
        assert!((pixel.variance() - expected).length() < 1e-12);
        assert_eq!((pixel.samples(), pixel.unusable()), (5, 1));
    }
}
