//! Pictures that show what a check found: what was expected, what was drawn, and how they differ.

use std::collections::BTreeSet;

use lightbench_assets::color::encode_srgb8;
use lightbench_render::TargetImage;
use lightbench_script::Expected;

use super::compare::Comparison;
use super::words::Words;
use crate::LdrImage;
use crate::colormap::ColorMap;

/// Errors of so many thresholds get the brightest colour.
const WORST: f64 = 4.0;
/// Pictures whose longer side is shorter are enlarged.
const SMALLEST: u32 = 256;
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
    let grid = Grid::of(expected, found.width);
    let larger = SMALLEST.div_ceil(found.width.max(found.height));
    let picture = |pixel: &dyn Fn(usize) -> [u8; 4]| {
        LdrImage::from_fn(larger * found.width, larger * found.height, |x, y| {
            grid.nearest(x / larger, y / larger).map_or(LEFT_OUT, pixel)
        })
    };
    vec![
        Drawn {
            name: "expected",
            shows: Words::new("expected", "lo esperado"),
            picture: picture(&|index| expected.texels[index].map_or(LEFT_OUT, &shown)),
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

/// The columns and rows in which texels were compared. A closed form is compared at few of them, and each
/// is shown as large as the distance to the next.
struct Grid {
    width: u32,
    columns: Vec<u32>,
    rows: Vec<u32>,
}

impl Grid {
    fn of(expected: &Expected, width: u32) -> Self {
        let texels = expected.texels.iter().zip(0..);
        let compared =
            texels.filter_map(|(texel, index): (_, u32)| texel.is_some().then_some(index));
        let (mut columns, mut rows) = (BTreeSet::new(), BTreeSet::new());
        for index in compared {
            columns.insert(index % width);
            rows.insert(index / width);
        }
        Self {
            width,
            columns: columns.into_iter().collect(),
            rows: rows.into_iter().collect(),
        }
    }

    /// The texel that is shown at a place, if one is near enough.
    fn nearest(&self, x: u32, y: u32) -> Option<usize> {
        let (column, row) = (nearest(&self.columns, x)?, nearest(&self.rows, y)?);
        Some((row * self.width + column) as usize)
    }
}

/// The nearest of some places, if it is not farther than they are from each other.
fn nearest(places: &[u32], place: u32) -> Option<u32> {
    let after = places.partition_point(|known| *known < place);
    let around = places[after.saturating_sub(1)..].iter().take(2);
    let found = *around.min_by_key(|known| known.abs_diff(place))?;
    let gaps = places.windows(2).map(|pair| pair[1] - pair[0]);
    let step = gaps.min().unwrap_or(1);
    (found.abs_diff(place) <= step / 2).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sparse_texels_are_shown_as_large_as_their_distance() {
        let places = [2, 6, 10];
        let found: Vec<_> = (0..14).map(|place| nearest(&places, place)).collect();
        let (two, six, ten) = (Some(2), Some(6), Some(10));
        assert_eq!(
            found,
            [
                two, two, two, two, two, six, six, six, six, ten, ten, ten, ten, None
            ]
        );
        assert_eq!(nearest(&[0, 1, 2], 1), Some(1));
        assert_eq!(nearest(&[3], 4), None);
        assert_eq!(nearest(&[], 4), None);
    }
}
