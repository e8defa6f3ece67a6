//! Structural similarity (Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality
//! Assessment: From Error Visibility to Structural Similarity", IEEE Transactions on Image
//! Processing 13(4), 2004).

use super::colour::luma;
use super::plane::Plane;
use crate::LabError;
use crate::picture::{LdrImage, check_ldr};

/// Side of the Gaussian window in pixels.
pub(super) const WINDOW: usize = 11;
/// Standard deviation of the window in pixels.
pub(super) const DEVIATION: f64 = 1.5;
/// Constant of the luminance term.
pub(super) const K1: f64 = 0.01;
/// Constant of the contrast term.
pub(super) const K2: f64 = 0.03;

/// Mean SSIM of the luma of two 8-bit sRGB pictures, 1 for equal ones, at least −1.
///
/// # Errors
/// If the sizes differ.
pub fn ssim(reference: &LdrImage, test: &LdrImage) -> Result<f64, LabError> {
    check_ldr(reference, test)?;
    let (width, height) = (reference.width as usize, reference.height as usize);
    let kernel = window();
    // Variances don't depend on an offset; values around zero keep more digits of them.
    let value = |image: &LdrImage, i: usize| luma(image.pixels[i]) - 0.5;
    let moments = Plane::split(width, height, |i| {
        let (r, t) = (value(reference, i), value(test, i));
        [r, t, r * r, t * t, r * t]
    });
    let [r, t, rr, tt, rt] =
        moments.map(|plane| plane.filter_rows(&kernel).filter_columns(&kernel));
    let map = Plane::from_index(width, height, |i| {
        let [r, t, rr, tt, rt] = [&r, &t, &rr, &tt, &rt].map(|plane| f64::from(plane.values[i]));
        let (mean_r, mean_t) = (r + 0.5, t + 0.5);
        let (var_r, var_t, covariance) = (rr - r * r, tt - t * t, rt - r * t);
        let (c1, c2) = (K1 * K1, K2 * K2);
        let luminance = (2.0 * mean_r * mean_t + c1) / (mean_r * mean_r + mean_t * mean_t + c1);
        (luminance * (2.0 * covariance + c2) / (var_r + var_t + c2)) as f32
    });
    // Only windows inside the picture count.
    let margin = |side: usize| if side >= WINDOW { WINDOW / 2 } else { 0 };
    let (mx, my) = (margin(width), margin(height));
    let rows = map.values.chunks(width).take(height - my).skip(my);
    let sum: f64 = rows
        .flat_map(|row| &row[mx..width - mx])
        .map(|&v| f64::from(v))
        .sum();
    Ok(sum / ((width - 2 * mx) * (height - 2 * my)) as f64)
}

fn window() -> Vec<f32> {
    let half = (WINDOW / 2) as i32;
    let weight = |x: i32| (-f64::from(x * x) / (2.0 * DEVIATION * DEVIATION)).exp();
    let sum: f64 = (-half..=half).map(weight).sum();
    (-half..=half).map(|x| (weight(x) / sum) as f32).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn weave(raise: u32) -> LdrImage {
        LdrImage::from_fn(48, 32, |x, y| {
            let g = ((x * y) % 256 + raise * ((x / 8 + y / 8) % 2)).min(255);
            let b = (255 + 3 * y as i32 - 5 * x as i32).rem_euclid(256);
            [((37 * x + 11 * y) % 256) as u8, g as u8, b as u8, 255]
        })
    }

    #[test]
    fn agrees_with_scikit_image() {
        // scikit-image 0.26, structural_similarity(gaussian_weights=True, sigma=1.5,
        // use_sample_covariance=False, data_range=1) on the same luma in double precision.
        let found = ssim(&weave(0), &weave(48)).unwrap();
        assert!((found - SKIMAGE_WEAVE).abs() < 1e-5, "{found}");
        let flat = |v: u8| LdrImage::from_fn(20, 20, |_, _| [v, v, v, 255]);
        let found = ssim(&flat(100), &flat(120)).unwrap();
        assert!((found - SKIMAGE_FLAT).abs() < 1e-5, "{found}");
    }
    const SKIMAGE_WEAVE: f64 = 0.944_872_700_9;
    const SKIMAGE_FLAT: f64 = 0.983_610_925_0;

    #[test]
    fn limits_and_small_pictures() {
        let flat = |v: u8| LdrImage::from_fn(16, 16, |_, _| [v, v, v, 255]);
        // (0 + C1) / (1 + C1) with C1 = 1e-4.
        let found = ssim(&flat(0), &flat(255)).unwrap();
        assert!((found - 1e-4 / 1.0001).abs() < 1e-6, "{found}");
        assert!((ssim(&weave(0), &weave(0)).unwrap() - 1.0).abs() < 1e-6);
        assert_eq!(
            ssim(&weave(0), &weave(48)).unwrap(),
            ssim(&weave(48), &weave(0)).unwrap()
        );
        for (w, h) in [(1, 1), (1, 30), (30, 1), (10, 11), (11, 11)] {
            let a = LdrImage::from_fn(w, h, |x, y| [(x * 9) as u8, (y * 7) as u8, 3, 255]);
            let b = LdrImage::from_fn(w, h, |x, y| [(x * 9) as u8, (y * 7) as u8 ^ 64, 3, 255]);
            assert!((ssim(&a, &a).unwrap() - 1.0).abs() < 1e-6);
            let found = ssim(&a, &b).unwrap();
            assert!((-1.0..1.0).contains(&found), "{w} {h} {found}");
        }
    }
}
