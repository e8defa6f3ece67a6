//! Colour maps for scalar maps.
//!
//! Magma and viridis by N. Smith and S. van der Walt (matplotlib 1.5, 2015, published under CC0):
//! lightness grows steadily from dark to bright, so the order survives print in grey and every kind
//! of colour blindness. The tables hold every eighth of their 256 colours, between which colours
//! are interpolated; that is within 2/255 of the full tables.

/// Number of colours in a table.
const KNOTS: usize = 33;

/// A perceptually ordered colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorMap {
    /// Black over purple and orange to pale yellow: the usual map of FLIP.
    Magma,
    /// Dark blue over green to yellow.
    Viridis,
}

impl ColorMap {
    /// The 8-bit sRGB colour of a value in 0 to 1. Values outside are clamped, NaN gives the
    /// brightest colour, so that it is seen.
    pub fn color(self, value: f32) -> [u8; 3] {
        let value = if value.is_nan() {
            1.0
        } else {
            value.clamp(0.0, 1.0)
        };
        let position = value * (KNOTS - 1) as f32;
        let below = (position as usize).min(KNOTS - 2);
        let fraction = position - below as f32;
        let table = self.table();
        std::array::from_fn(|c| {
            let (low, high) = (f32::from(table[below][c]), f32::from(table[below + 1][c]));
            (low + (high - low) * fraction + 0.5) as u8
        })
    }

    /// The name that reports print.
    pub fn name(self) -> &'static str {
        match self {
            Self::Magma => "magma",
            Self::Viridis => "viridis",
        }
    }

    fn table(self) -> &'static [[u8; 3]; KNOTS] {
        match self {
            Self::Magma => &MAGMA,
            Self::Viridis => &VIRIDIS,
        }
    }
}

#[rustfmt::skip]
const MAGMA: [[u8; 3]; KNOTS] = [
    [0, 0, 4], [3, 3, 17], [10, 8, 34], [19, 13, 51], [29, 17, 70], [40, 17, 90], [54, 16, 106],
    [67, 15, 118], [80, 18, 124], [93, 23, 127], [105, 28, 129], [118, 33, 129], [130, 38, 129],
    [143, 42, 129], [156, 46, 127], [169, 50, 125], [182, 55, 121], [195, 59, 117], [207, 65, 112],
    [219, 72, 106], [230, 81, 99], [238, 92, 94], [245, 105, 92], [249, 120, 93], [251, 135, 97],
    [253, 150, 104], [254, 165, 113], [254, 180, 123], [254, 195, 135], [254, 209, 148],
    [253, 224, 162], [252, 238, 176], [252, 253, 191],
];

#[rustfmt::skip]
const VIRIDIS: [[u8; 3]; KNOTS] = [
    [68, 1, 84], [71, 13, 96], [72, 24, 106], [72, 35, 116], [71, 45, 123], [69, 54, 129],
    [66, 64, 134], [63, 73, 137], [59, 82, 139], [55, 90, 141], [51, 99, 141], [47, 106, 142],
    [44, 114, 142], [41, 122, 142], [38, 129, 142], [35, 137, 142], [33, 144, 140], [31, 152, 139],
    [31, 159, 136], [33, 166, 133], [40, 174, 128], [49, 181, 123], [62, 188, 116], [76, 194, 108],
    [93, 201, 99], [110, 206, 88], [130, 211, 76], [150, 216, 63], [171, 220, 50], [192, 223, 36],
    [213, 226, 26], [234, 229, 26], [253, 231, 37],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::colour::{linear_to_lab, srgb_to_linear};

    #[test]
    fn colours_agree_with_the_full_tables() {
        // Entries i of 0..256 of matplotlib's tables, in 8 bits.
        for (map, entries) in [
            (
                ColorMap::Magma,
                [
                    (0, [0, 0, 4]),
                    (64, [81, 18, 124]),
                    (100, [137, 40, 129]),
                    (128, [183, 55, 121]),
                    (200, [253, 152, 105]),
                    (255, [252, 253, 191]),
                ],
            ),
            (
                ColorMap::Viridis,
                [
                    (0, [68, 1, 84]),
                    (64, [59, 82, 139]),
                    (100, [42, 118, 142]),
                    (128, [33, 145, 140]),
                    (200, [112, 207, 87]),
                    (255, [253, 231, 37]),
                ],
            ),
        ] {
            for (i, expected) in entries {
                let found = map.color(i as f32 / 255.0);
                for c in 0..3 {
                    assert!(found[c].abs_diff(expected[c]) <= 2, "{map:?} {i} {found:?}");
                }
            }
        }
    }

    #[test]
    fn lightness_grows_steadily() {
        for map in [ColorMap::Magma, ColorMap::Viridis] {
            let lightness =
                |i: usize| linear_to_lab(map.color(i as f32 / 64.0).map(srgb_to_linear))[0];
            for i in 1..=64 {
                assert!(lightness(i) > lightness(i - 1), "{map:?} {i}");
            }
        }
    }

    #[test]
    fn values_out_of_range_are_clamped() {
        assert_eq!(ColorMap::Magma.color(-1.0), [0, 0, 4]);
        assert_eq!(ColorMap::Magma.color(7.0), [252, 253, 191]);
        assert_eq!(ColorMap::Magma.color(f32::NAN), [252, 253, 191]);
    }
}
