//! Colour spaces that the metrics need, in `f32`, for linear Rec. 709 RGB.
//!
//! The matrices are derived from the chromaticities of Rec. 709 and of its white
//! D65 (ITU-R BT.709-6, table 1), so that no rounded constant is repeated here.

use std::sync::LazyLock;

/// Three components of a colour.
pub type Triple = [f32; 3];

/// `(x, y)` of red, green and blue.
const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
/// `(x, y)` of the white D65.
const WHITE: [f64; 2] = [0.3127, 0.3290];

/// Linear RGB to XYZ divided by the XYZ of white, so that white is `(1, 1, 1)`, and back.
struct Matrices {
    to_relative_xyz: [[f32; 3]; 3],
    to_rgb: [[f32; 3]; 3],
}

static MATRICES: LazyLock<Matrices> = LazyLock::new(|| {
    let xyz = |[x, y]: [f64; 2]| [x / y, 1.0, (1.0 - x - y) / y];
    let columns = PRIMARIES.map(xyz);
    let white = xyz(WHITE);
    let unscaled: [[f64; 3]; 3] =
        std::array::from_fn(|row| std::array::from_fn(|col| columns[col][row]));
    // The primaries are scaled such that R = G = B = 1 gives the white.
    let scale = apply(&invert(&unscaled), white);
    let forward: [[f64; 3]; 3] = std::array::from_fn(|row| {
        std::array::from_fn(|col| unscaled[row][col] * scale[col] / white[row])
    });
    let backward = invert(&forward);
    Matrices {
        to_relative_xyz: forward.map(|row| row.map(|v| v as f32)),
        to_rgb: backward.map(|row| row.map(|v| v as f32)),
    }
});

fn apply(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// Inverse by cofactors.
fn invert(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cofactor = |r: usize, c: usize| {
        let (r1, r2, c1, c2) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
    };
    let determinant: f64 = (0..3).map(|c| m[0][c] * cofactor(0, c)).sum();
    std::array::from_fn(|r| std::array::from_fn(|c| cofactor(c, r) / determinant))
}

#[inline]
fn apply32(m: &[[f32; 3]; 3], v: Triple) -> Triple {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// An 8-bit sRGB value as linear light in 0 to 1 (IEC 61966-2-1).
pub fn srgb_to_linear(value: u8) -> f32 {
    static TABLE: LazyLock<[f32; 256]> = LazyLock::new(|| {
        std::array::from_fn(|i| {
            let s = i as f64 / 255.0;
            let linear = if s <= 0.040_45 {
                s / 12.92
            } else {
                ((s + 0.055) / 1.055).powf(2.4)
            };
            linear as f32
        })
    });
    TABLE[value as usize]
}

/// Linear light as an 8-bit sRGB value; below 0 and above 1 are clamped, NaN gives 0.
pub fn linear_to_srgb(value: f32) -> u8 {
    let v = value.clamp(0.0, 1.0);
    let s = if v <= 0.003_130_8 {
        v * 12.92
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    };
    (s * 255.0 + 0.5) as u8
}

/// Relative luminance of linear Rec. 709 RGB (BT.709-6, item 3.2).
#[inline]
pub fn luminance(rgb: Triple) -> f32 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

/// Gamma-encoded luma of an 8-bit sRGB pixel in 0 to 1 with the BT.601 weights, the grey that
/// Wang et al. 2004 evaluate SSIM on.
#[inline]
pub fn luma(pixel: [u8; 4]) -> f32 {
    (0.299 * f32::from(pixel[0]) + 0.587 * f32::from(pixel[1]) + 0.114 * f32::from(pixel[2]))
        / 255.0
}

/// Linear RGB to YyCxCz, the linearised opponent space of FLIP (Andersson et al. 2020, section
/// 4.1): a lightness without the cube root, a red-green and a blue-yellow axis.
#[inline]
pub fn linear_to_opponent(rgb: Triple) -> Triple {
    let [x, y, z] = apply32(&MATRICES.to_relative_xyz, rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The inverse of [`linear_to_opponent`].
#[inline]
pub fn opponent_to_linear([yy, cx, cz]: Triple) -> Triple {
    let y = (yy + 16.0) / 116.0;
    apply32(&MATRICES.to_rgb, [cx / 500.0 + y, y, y - cz / 200.0])
}

/// Linear RGB to CIE 1976 L*a*b* with the white D65 (CIE 15:2004, section 8.2.1).
#[inline]
pub fn linear_to_lab(rgb: Triple) -> Triple {
    const EDGE: f32 = 6.0 / 29.0;
    let f = |t: f32| {
        if t > EDGE * EDGE * EDGE {
            t.cbrt()
        } else {
            t / (3.0 * EDGE * EDGE) + 4.0 / 29.0
        }
    };
    let [x, y, z] = apply32(&MATRICES.to_relative_xyz, rgb).map(f);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_agree_with_the_published_ones() {
        // IEC 61966-2-1 prints the forward matrix with four decimals.
        let xyz = [
            [0.4124, 0.3576, 0.1805],
            [0.2126, 0.7152, 0.0722],
            [0.0193, 0.1192, 0.9505],
        ];
        let white = [0.9505, 1.0, 1.0890];
        for ((derived, printed), white) in MATRICES.to_relative_xyz.iter().zip(xyz).zip(white) {
            for (d, p) in derived.iter().zip(printed) {
                assert!((d * white - p).abs() < 1e-4, "{derived:?} {printed:?}");
            }
        }
    }

    #[test]
    fn white_and_primaries_in_lab() {
        // CIE L*a*b* of the sRGB primaries for D65, as colour science tables print them.
        for (rgb, lab) in [
            ([1.0, 1.0, 1.0], [100.0, 0.0, 0.0]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
            ([1.0, 0.0, 0.0], [53.24, 80.09, 67.20]),
            ([0.0, 1.0, 0.0], [87.73, -86.18, 83.18]),
            ([0.0, 0.0, 1.0], [32.30, 79.19, -107.86]),
        ] {
            let found = linear_to_lab(rgb);
            for i in 0..3 {
                assert!((found[i] - lab[i]).abs() < 0.02, "{rgb:?} {found:?}");
            }
        }
    }

    #[test]
    fn conversions_invert() {
        for value in 0..=255 {
            assert_eq!(linear_to_srgb(srgb_to_linear(value)), value);
        }
        assert_eq!(linear_to_srgb(f32::NAN), 0);
        let rgb = [0.2, 0.7, 0.05];
        let back = opponent_to_linear(linear_to_opponent(rgb));
        for i in 0..3 {
            assert!((rgb[i] - back[i]).abs() < 1e-5);
        }
    }
}
