//! Pointwise errors of 8-bit sRGB pictures, as a display shows them.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::infinite_or_null;
use crate::LabError;
use crate::picture::{LdrImage, check_ldr};

/// Result of [`srgb_errors`]. Values are 8-bit sRGB divided by 255.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SrgbErrors {
    /// Mean of (t − r)² over all pixels and R, G, B.
    pub mse: f64,
    /// √MSE.
    pub rmse: f64,
    /// 10 · log₁₀(1 / MSE) in dB; infinite for equal pictures, which JSON writes as `null`.
    #[serde(with = "infinite_or_null")]
    pub psnr_db: f64,
    /// Largest |t − r| of any channel of any pixel, in steps of 1/255.
    pub max_steps: u8,
    /// Share of pixels whose R, G or B differ at all, 0 to 1.
    pub share_different: f64,
    /// Share of black pixels in the reference, 0 to 1.
    pub reference_black: f64,
    /// Share of black pixels in the picture under test, 0 to 1.
    pub test_black: f64,
}

/// Sums over some pixels, in integers: exact in any order.
#[derive(Clone, Copy, Default)]
struct Sums {
    squares: u64,
    largest: u8,
    different: u64,
    black: [u64; 2],
}

impl Sums {
    fn add(mut self, other: Self) -> Self {
        self.squares += other.squares;
        self.largest = self.largest.max(other.largest);
        self.different += other.different;
        self.black = [
            self.black[0] + other.black[0],
            self.black[1] + other.black[1],
        ];
        self
    }

    fn of(r: &[u8; 4], t: &[u8; 4]) -> Self {
        let steps = [0, 1, 2].map(|c| r[c].abs_diff(t[c]));
        let largest = steps.into_iter().fold(0, u8::max);
        Self {
            squares: steps.iter().map(|&d| u64::from(d) * u64::from(d)).sum(),
            largest,
            different: u64::from(largest > 0),
            black: [r, t].map(|p| u64::from(p[..3] == [0, 0, 0])),
        }
    }
}

/// Pointwise errors of two 8-bit pictures. Alpha is ignored.
///
/// # Errors
/// If the sizes differ.
pub fn srgb_errors(reference: &LdrImage, test: &LdrImage) -> Result<SrgbErrors, LabError> {
    check_ldr(reference, test)?;
    let sums = reference
        .pixels
        .par_iter()
        .zip(&test.pixels)
        .with_min_len(4096)
        .fold(Sums::default, |sums, (r, t)| sums.add(Sums::of(r, t)))
        .reduce(Sums::default, Sums::add);
    let pixels = reference.pixels.len() as f64;
    let mse = sums.squares as f64 / (3.0 * pixels * 255.0 * 255.0);
    Ok(SrgbErrors {
        mse,
        rmse: mse.sqrt(),
        psnr_db: psnr(1.0, mse),
        max_steps: sums.largest,
        share_different: sums.different as f64 / pixels,
        reference_black: sums.black[0] as f64 / pixels,
        test_black: sums.black[1] as f64 / pixels,
    })
}

/// 10 · log₁₀(peak² / MSE), infinite where there is no error.
pub(crate) fn psnr(peak: f64, mse: f64) -> f64 {
    if mse > 0.0 {
        10.0 * (peak * peak / mse).log10()
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn one_step_everywhere() {
        let a = LdrImage::from_fn(64, 64, |_, _| [100, 100, 100, 255]);
        let b = LdrImage::from_fn(64, 64, |_, _| [101, 101, 101, 0]);
        let e = srgb_errors(&a, &b).unwrap();
        assert!((e.rmse - 1.0 / 255.0).abs() < 1e-12);
        // The well-known PSNR of one 8-bit step: 20 log10(255).
        assert!((e.psnr_db - 48.130_803_608_679_1).abs() < 1e-9);
        assert_eq!((e.max_steps, e.share_different), (1, 1.0));
    }

    #[test]
    fn one_pixel_by_hand() {
        let a = LdrImage::from_fn(5, 2, |_, _| [0, 0, 0, 255]);
        let mut b = a.clone();
        b.pixels[3] = [51, 0, 102, 255];
        let e = srgb_errors(&a, &b).unwrap();
        // (0.2² + 0.4²) / 30
        assert!((e.mse - 0.2 / 30.0).abs() < 1e-12);
        assert_eq!(
            (e.share_different, e.reference_black, e.test_black),
            (0.1, 1.0, 0.9)
        );
        assert_eq!(srgb_errors(&b, &a).unwrap().mse, e.mse);
    }

    #[test]
    fn equal_pictures_survive_json() {
        let a = LdrImage::from_fn(1, 1, |_, _| [9, 9, 9, 255]);
        let e = srgb_errors(&a, &a).unwrap();
        assert_eq!((e.mse, e.psnr_db), (0.0, f64::INFINITY));
        let text = serde_json::to_string(&e).unwrap();
        assert!(text.contains("\"psnr_db\":null"), "{text}");
        assert_eq!(serde_json::from_str::<SrgbErrors>(&text).unwrap(), e);
    }
}
