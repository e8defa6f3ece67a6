//! HDR-FLIP: the largest LDR-FLIP over all exposures at which the reference can be shown.

use rayon::prelude::*;

use super::{Filters, FlipOptions};
use crate::LabError;
use crate::metrics::colour::{self, Triple};
use crate::metrics::plane::Plane;
use crate::picture::{HdrImage, check_hdr};

/// Result of [`hdr_flip`].
#[derive(Clone, Debug, PartialEq)]
pub struct HdrFlip {
    /// The largest FLIP of each pixel over the exposures.
    pub map: Plane,
    /// Darkest exposure in stops: the brightest pixel of the reference stays below white.
    pub start_exposure: f64,
    /// Brightest exposure in stops: the median pixel of the reference reaches white.
    pub stop_exposure: f64,
    /// Number of exposures evaluated, one a stop and at least two unless the reference is black.
    pub exposures: u32,
}

/// Level after the tone curve that counts as "near white" when exposures are chosen
/// (Andersson et al. 2021, section 3.2).
const NEAR_WHITE: f64 = 0.85;

/// Narkowicz' fit of the ACES tone curve (2015), with its input scaled by 0.6 as the authors do.
/// `x (a x + b) / (x (c x + d) + e)`.
const CURVE: [f64; 5] = [2.51, 0.03, 2.43, 0.59, 0.14];
const CURVE_SCALE: f64 = 0.6;

#[inline]
fn tone_curve(value: f32) -> f32 {
    let [a, b, c, d, e] = CURVE.map(|v| v as f32);
    let x = value * CURVE_SCALE as f32;
    // The fraction tends to a/c; a huge x must not become infinity over infinity.
    if x > 1e6 {
        return 1.0;
    }
    (x * (a * x + b) / (x * (c * x + d) + e)).clamp(0.0, 1.0)
}

/// The input that the tone curve takes to [`NEAR_WHITE`]: the positive root of a quadratic.
fn input_near_white() -> f64 {
    let [a, b, c, d, e] = CURVE;
    let (p, q, r) = (a - NEAR_WHITE * c, b - NEAR_WHITE * d, -NEAR_WHITE * e);
    let x = (-q + (q * q - 4.0 * p * r).sqrt()) / (2.0 * p);
    x / CURVE_SCALE
}

/// HDR-FLIP of two pictures in linear Rec. 709 RGB before any tone curve.
///
/// Negative values count as 0. A pixel that is NaN or infinite in only one picture, or in both,
/// is taken as black for its neighbours and has the error 1 itself, so that it can't hide.
///
/// # Errors
/// If the sizes differ, or the number of pixels per degree is out of range.
pub fn hdr_flip(
    reference: &HdrImage,
    test: &HdrImage,
    options: FlipOptions,
) -> Result<HdrFlip, LabError> {
    check_hdr(reference, test)?;
    let filters = Filters::new(options.check()?);
    let (width, height) = (reference.width as usize, reference.height as usize);
    let steps = exposures(reference);
    let mut map = Plane {
        width,
        height,
        values: vec![0.0; width * height],
    };
    for &stops in &steps {
        let scale = stops.exp2() as f32;
        let show =
            |image: &HdrImage, i: usize| clean(&image.pixels[i]).map(|c| tone_curve(c * scale));
        let seen_reference = filters.see(width, height, |i| show(reference, i));
        let seen_test = filters.see(width, height, |i| show(test, i));
        let flip = seen_reference.difference(&seen_test);
        map.values
            .par_iter_mut()
            .zip(&flip.values)
            .for_each(|(m, f)| *m = m.max(*f));
    }
    map.values
        .par_iter_mut()
        .zip(&reference.pixels)
        .zip(&test.pixels)
        .for_each(|((m, r), t)| {
            if !HdrImage::is_valid(r) || !HdrImage::is_valid(t) {
                *m = 1.0;
            }
        });
    Ok(HdrFlip {
        map,
        start_exposure: steps.first().copied().unwrap_or(0.0),
        stop_exposure: steps.last().copied().unwrap_or(0.0),
        exposures: steps.len() as u32,
    })
}

fn clean(pixel: &[f32; 4]) -> Triple {
    if HdrImage::is_valid(pixel) {
        [pixel[0], pixel[1], pixel[2]].map(|c| c.max(0.0))
    } else {
        [0.0; 3]
    }
}

/// The exposures in stops: from the one where the brightest pixel is near white to the one where
/// the median pixel is, one a stop, at least two. A black reference is shown as it is.
fn exposures(reference: &HdrImage) -> Vec<f64> {
    let mut luminance: Vec<f32> = reference
        .pixels
        .par_iter()
        .map(|p| colour::luminance(clean(p)))
        .collect();
    let middle = luminance.len() / 2;
    let (_, &mut median, above) = luminance.select_nth_unstable_by(middle, f32::total_cmp);
    let brightest = above.iter().copied().fold(median, f32::max);
    if brightest <= 0.0 {
        return vec![0.0];
    }
    let near_white = input_near_white();
    let start = (near_white / f64::from(brightest)).log2();
    // The authors' floor keeps a mostly black reference finite.
    let stop = (near_white / f64::from(median.max(f32::EPSILON)))
        .log2()
        .max(start);
    let count = (stop - start).ceil().max(2.0) as u32;
    (0..count)
        .map(|i| start + f64::from(i) * (stop - start) / f64::from(count - 1))
        .collect()
}
