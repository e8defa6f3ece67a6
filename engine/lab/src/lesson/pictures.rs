//! Pictures that show what a check found: what was expected, what was drawn, and how they differ.

use lightbench_assets::color::encode_srgb8;
use lightbench_render::TargetImage;
use lightbench_script::Expected;

use super::compare::Comparison;
use super::words::Words;
use crate::LdrImage;
use crate::colormap::ColorMap;

/// Errors of so many thresholds get the brightest colour.
const WORST: f64 = 4.0;
/// Texels that were not compared.
const LEFT_OUT: [u8; 4] = [40, 40, 48, 255];

/// A picture of a finding.
pub(super) struct Drawn {
    /// What the file's name ends with.
    pub(super) name: &'static str,
    pub(super) shows: Words,
    pub(super) picture: LdrImage,
}

/// The three pictures of a comparison. Both pictures are shown with one exposure, so that the brightest
/// expected value is white or darker.
pub(super) fn draw(
    found: &TargetImage,
    expected: &Expected,
    comparison: &Comparison,
) -> Vec<Drawn> {
    let values = expected
        .texels
        .iter()
        .flatten()
        .flat_map(|texel| texel.iter().take(expected.channels));
    let brightest = values
        .copied()
        .filter(|value| value.is_finite())
        .fold(0.0, f32::max);
    let exposure = if brightest > 1.0 {
        1.0 / brightest
    } else {
        1.0
    };
    let shown = |texel: [f32; 4]| {
        let byte =
            |channel: usize| encode_srgb8(texel[channel.min(expected.channels - 1)] * exposure);
        [byte(0), byte(1), byte(2), 255]
    };
    let error = |error: Option<f64>| {
        let Some(error) = error else {
            return LEFT_OUT;
        };
        let [r, g, b] = ColorMap::Magma.color((error / WORST) as f32);
        [r, g, b, 255]
    };
    let at = |x: u32, y: u32| (y * found.width + x) as usize;
    let picture = |pixel: &dyn Fn(usize) -> [u8; 4]| {
        LdrImage::from_fn(found.width, found.height, |x, y| pixel(at(x, y)))
    };
    vec![
        Drawn {
            name: "expected",
            shows: Words::new("expected", "lo esperado"),
            picture: picture(&|index| expected.texels[index].map_or(LEFT_OUT, shown)),
        },
        Drawn {
            name: "yours",
            shows: Words::new("yours", "lo tuyo"),
            picture: picture(&|index| shown(found.texels[index])),
        },
        Drawn {
            name: "difference",
            shows: Words::new(
                "the difference: black none, yellow four thresholds or more",
                "la diferencia: negro, ninguna; amarillo, cuatro umbrales o más",
            ),
            picture: picture(&|index| error(comparison.errors[index])),
        },
    ]
}
