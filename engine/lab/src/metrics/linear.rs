//! Pointwise errors of linear HDR pictures, before any tone curve.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::colour::luminance;
use super::srgb::psnr;
use super::{infinite_or_null, number_or_null};
use crate::LabError;
use crate::picture::{HdrImage, check_hdr};

/// Keeps relMSE finite where the reference is black (Rousselle et al. 2011 use the same value).
pub const REL_MSE_EPSILON: f64 = 0.01;
/// Keeps SMAPE finite where both pictures are black.
pub const SMAPE_EPSILON: f64 = 0.01;

/// Result of [`linear_errors`]. A pixel is valid if R, G and B are finite in both pictures; only
/// valid pixels enter the errors, and the others are counted. With no valid pixel at all the
/// errors are NaN, which JSON writes as `null`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinearErrors {
    /// Mean of (t − r)² over valid pixels and R, G, B.
    #[serde(with = "number_or_null")]
    pub mse: f64,
    /// √MSE.
    #[serde(with = "number_or_null")]
    pub rmse: f64,
    /// 10 · log₁₀(p² / MSE) in dB with p the largest valid value of the reference; infinite for
    /// equal pictures, which JSON writes as `null`.
    #[serde(with = "infinite_or_null")]
    pub psnr_db: f64,
    /// Mean of (t − r)² / (r² + [`REL_MSE_EPSILON`]).
    #[serde(with = "number_or_null")]
    pub rel_mse: f64,
    /// Mean of |t − r| / (|t| + |r| + [`SMAPE_EPSILON`]).
    #[serde(with = "number_or_null")]
    pub smape: f64,
    /// Total luminance of the test over that of the reference; NaN if the latter is zero.
    #[serde(with = "number_or_null")]
    pub energy_ratio: f64,
    /// Largest |t − r| / max(|r|, 1/1024), the bound in which pipelines state their agreement.
    #[serde(with = "number_or_null")]
    pub max_relative: f64,
    /// Share of pixels that are NaN or infinite in either picture, 0 to 1.
    pub share_invalid: f64,
    /// Share of valid pixels that are black in the reference, of all pixels, 0 to 1.
    pub reference_black: f64,
    /// Share of valid pixels that are black in the picture under test, of all pixels, 0 to 1.
    pub test_black: f64,
}

#[derive(Clone, Copy, Default)]
struct Sums {
    square: f64,
    relative_square: f64,
    symmetric: f64,
    energy: [f64; 2],
    peak: f64,
    max_relative: f64,
    valid: u64,
    black: [u64; 2],
}

impl Sums {
    fn add(self, o: Self) -> Self {
        Self {
            square: self.square + o.square,
            relative_square: self.relative_square + o.relative_square,
            symmetric: self.symmetric + o.symmetric,
            energy: [self.energy[0] + o.energy[0], self.energy[1] + o.energy[1]],
            peak: self.peak.max(o.peak),
            max_relative: self.max_relative.max(o.max_relative),
            valid: self.valid + o.valid,
            black: [self.black[0] + o.black[0], self.black[1] + o.black[1]],
        }
    }

    fn of(reference: &[f32; 4], test: &[f32; 4]) -> Self {
        let mut sums = Self::default();
        if !HdrImage::is_valid(reference) || !HdrImage::is_valid(test) {
            return sums;
        }
        for channel in 0..3 {
            let (r, t) = (f64::from(reference[channel]), f64::from(test[channel]));
            let d = (t - r).abs();
            sums.square += d * d;
            sums.relative_square += d * d / (r * r + REL_MSE_EPSILON);
            sums.symmetric += d / (t.abs() + r.abs() + SMAPE_EPSILON);
            sums.peak = sums.peak.max(r);
            sums.max_relative = sums.max_relative.max(d / r.abs().max(1.0 / 1024.0));
        }
        sums.energy = [reference, test].map(|p| f64::from(luminance([p[0], p[1], p[2]])));
        sums.black = [reference, test].map(|p| u64::from(p[..3].iter().all(|c| *c <= 0.0)));
        sums.valid = 1;
        sums
    }
}

/// Pointwise errors of two linear pictures. Alpha is ignored.
///
/// # Errors
/// If the sizes differ.
pub fn linear_errors(reference: &HdrImage, test: &HdrImage) -> Result<LinearErrors, LabError> {
    check_hdr(reference, test)?;
    let width = reference.width as usize;
    // One sum a row, then the rows in order: the result is the same for any number of threads.
    let rows: Vec<Sums> = reference
        .pixels
        .par_chunks(width)
        .zip(test.pixels.par_chunks(width))
        .map(|(r, t)| {
            r.iter()
                .zip(t)
                .fold(Sums::default(), |sums, (r, t)| sums.add(Sums::of(r, t)))
        })
        .collect();
    let sums = rows.into_iter().fold(Sums::default(), Sums::add);
    let pixels = reference.pixels.len() as f64;
    let values = if sums.valid > 0 {
        3.0 * sums.valid as f64
    } else {
        f64::NAN
    };
    let mse = sums.square / values;
    Ok(LinearErrors {
        mse,
        rmse: mse.sqrt(),
        psnr_db: if mse.is_nan() {
            f64::NAN
        } else {
            psnr(sums.peak, mse)
        },
        rel_mse: sums.relative_square / values,
        smape: sums.symmetric / values,
        energy_ratio: if sums.energy[0] == 0.0 {
            f64::NAN
        } else {
            sums.energy[1] / sums.energy[0]
        },
        max_relative: if sums.valid > 0 {
            sums.max_relative
        } else {
            f64::NAN
        },
        share_invalid: 1.0 - sums.valid as f64 / pixels,
        reference_black: sums.black[0] as f64 / pixels,
        test_black: sums.black[1] as f64 / pixels,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn grey(v: f32) -> [f32; 4] {
        [v, v, v, 1.0]
    }

    #[test]
    fn two_pixels_by_hand() {
        let a = HdrImage::new(2, 1, vec![grey(2.0), grey(0.0)]).unwrap();
        let b = HdrImage::new(2, 1, vec![grey(3.0), grey(0.5)]).unwrap();
        let e = linear_errors(&a, &b).unwrap();
        assert!((e.mse - 0.625).abs() < 1e-12);
        assert!((e.psnr_db - 10.0 * (4.0_f64 / 0.625).log10()).abs() < 1e-12);
        // (1 / 4.01 + 0.25 / 0.01) / 2 and (1 / 5.01 + 0.5 / 0.51) / 2
        assert!((e.rel_mse - (1.0 / 4.01 + 25.0) / 2.0).abs() < 1e-12);
        assert!((e.smape - (1.0 / 5.01 + 0.5 / 0.51) / 2.0).abs() < 1e-12);
        assert!((e.energy_ratio - 1.75).abs() < 1e-6);
        assert_eq!(
            (e.reference_black, e.test_black, e.share_invalid),
            (0.5, 0.0, 0.0)
        );
        assert!((e.max_relative - 512.0).abs() < 1e-9);
        let back = linear_errors(&b, &a).unwrap();
        assert_eq!((back.mse, back.smape), (e.mse, e.smape));
        assert_ne!(back.rel_mse, e.rel_mse);
    }

    #[test]
    fn invalid_pixels_are_counted_and_left_out() {
        let a = HdrImage::new(4, 1, vec![grey(1.0); 4]).unwrap();
        let mut b = a.clone();
        b.pixels[0][2] = f32::NAN;
        b.pixels[1][0] = f32::NEG_INFINITY;
        let e = linear_errors(&a, &b).unwrap();
        assert_eq!(
            (e.share_invalid, e.mse, e.psnr_db),
            (0.5, 0.0, f64::INFINITY)
        );
        let none = HdrImage::new(1, 1, vec![grey(f32::NAN)]).unwrap();
        let e = linear_errors(&none, &none).unwrap();
        assert!(e.mse.is_nan() && e.psnr_db.is_nan() && e.max_relative.is_nan());
        assert_eq!(e.share_invalid, 1.0);
        let text = serde_json::to_string(&e).unwrap();
        assert!(
            serde_json::from_str::<LinearErrors>(&text)
                .unwrap()
                .rmse
                .is_nan()
        );
    }

    #[test]
    fn a_dark_estimator_shows_in_the_energy() {
        let a = HdrImage::from_fn(7, 5, |x, y| grey((x + y) as f32 * 0.3 + 0.1));
        let b = HdrImage::from_fn(7, 5, |x, y| grey(((x + y) as f32 * 0.3 + 0.1) * 0.9));
        let e = linear_errors(&a, &b).unwrap();
        assert!((e.energy_ratio - 0.9).abs() < 1e-6, "{}", e.energy_ratio);
        assert!((e.max_relative - 0.1).abs() < 1e-6);
    }
}
