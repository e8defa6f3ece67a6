//! How far apart two pictures are.

use lightbench::lab::{LdrImage, diff};
use lightbench::render::TargetImage;

/// The largest difference of two linear pictures, relative to the brighter of the two values and
/// to a thousandth of the brightest value of all: darker ones nobody sees.
pub fn relative_difference(a: &TargetImage, b: &TargetImage) -> f32 {
    let brightest = a.texels.iter().flat_map(|texel| &texel[..3]).copied();
    let floor = brightest.fold(0.0_f32, f32::max) * 1e-3;
    let pairs = a.texels.iter().zip(&b.texels);
    pairs
        .flat_map(|(a, b)| (0..3).map(|channel| (a[channel], b[channel])))
        .map(|(a, b)| (a - b).abs() / a.abs().max(b.abs()).max(floor).max(1e-9))
        .fold(0.0, f32::max)
}

/// The largest difference of two pictures.
pub fn largest_difference(a: &TargetImage, b: &TargetImage) -> f32 {
    let pairs = a.texels.iter().zip(&b.texels);
    let channels = pairs.flat_map(|(a, b)| (0..3).map(|channel| (a[channel] - b[channel]).abs()));
    channels.fold(0.0, f32::max)
}

/// The share of the pixels that differ by more than a bound, relative to the brighter value.
pub fn share_beyond(a: &TargetImage, b: &TargetImage, bound: f32) -> f64 {
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| {
        (0..3).any(|channel| {
            let (a, b) = (a[channel], b[channel]);
            (a - b).abs() > bound * a.abs().max(b.abs())
        })
    };
    let beyond = a.texels.iter().zip(&b.texels).filter(differs).count();
    beyond as f64 / a.texels.len() as f64
}

/// The mean of the differences, relative to the mean of the light.
pub fn mean_difference(a: &TargetImage, b: &TargetImage) -> f64 {
    let values = |image: &TargetImage| -> Vec<f64> {
        let texels = image.texels.iter().flat_map(|texel| &texel[..3]);
        texels.map(|value| f64::from(*value)).collect()
    };
    let (a, b) = (values(a), values(b));
    let sum: f64 = a.iter().sum::<f64>().max(1e-9);
    let differences = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    differences.sum::<f64>() / sum
}

/// FLIP of two pictures as a display shows them, in the mean.
pub fn flip_mean(a: &[u8], b: &[u8], (width, height): (u32, u32)) -> f64 {
    let picture = |bytes: &[u8]| {
        let pixels = bytes
            .chunks_exact(4)
            .map(|p| [p[0], p[1], p[2], p[3]])
            .collect();
        LdrImage::new(width, height, pixels).unwrap()
    };
    let options = diff::DiffOptions::default();
    diff::diff_ldr(&picture(a), &picture(b), options)
        .unwrap()
        .difference
        .flip
        .mean
}

/// Additions in another order, in 32 bits: each sum rounds by 2⁻²⁴ of itself, on either side. The
/// evaluation of a light itself takes some more operations.
pub fn order_bound(lights: usize) -> f32 {
    (lights as f32 + 8.0) * (-23.0_f32).exp2()
}

/// Stops at the first value that differs by more than a hundred-thousandth.
pub fn close(a: &TargetImage, b: &TargetImage, what: &str) {
    for (index, (a, b)) in a.texels.iter().zip(&b.texels).enumerate() {
        for channel in 0..3 {
            let (a, b) = (a[channel], b[channel]);
            assert!(
                (a - b).abs() <= 1e-5 * a.abs().max(b.abs()) + 1e-7,
                "{what}, pixel {index}: {a} and {b}"
            );
        }
    }
}
