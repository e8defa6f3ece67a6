//! The metrics by name, each with its formula.

use super::distribution::{DEFAULT_BOUND, HISTOGRAM_BINS};
use super::flip::FlipOptions;
use super::{linear, ssim};

/// A picture metric, for naming and explaining it. `r` is a value of the reference, `t` of the
/// picture under test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// Perceptual difference of 8-bit pictures.
    LdrFlip,
    /// Perceptual difference of linear pictures over all useful exposures.
    HdrFlip,
    /// Mean squared error in 8-bit sRGB.
    SrgbMse,
    /// Root of the mean squared error in 8-bit sRGB.
    SrgbRmse,
    /// Peak signal-to-noise ratio in 8-bit sRGB.
    SrgbPsnr,
    /// Structural similarity.
    Ssim,
    /// Mean squared error in linear light.
    LinearMse,
    /// Root of the mean squared error in linear light.
    LinearRmse,
    /// Peak signal-to-noise ratio in linear light.
    LinearPsnr,
    /// Relative mean squared error in linear light.
    RelMse,
    /// Symmetric mean absolute percentage error in linear light.
    Smape,
    /// Quotient of the total luminance.
    EnergyRatio,
    /// Share of black pixels.
    ShareBlack,
    /// Share of NaN and infinite pixels.
    ShareInvalid,
    /// Percentiles of a map.
    Percentile,
    /// Percentiles of a map weighted by the error itself.
    WeightedPercentile,
    /// Histogram of a map.
    Histogram,
}

impl Metric {
    /// All metrics, in the order in which a report prints them.
    pub const ALL: [Self; 17] = [
        Self::LdrFlip,
        Self::HdrFlip,
        Self::SrgbMse,
        Self::SrgbRmse,
        Self::SrgbPsnr,
        Self::Ssim,
        Self::LinearMse,
        Self::LinearRmse,
        Self::LinearPsnr,
        Self::RelMse,
        Self::Smape,
        Self::EnergyRatio,
        Self::ShareBlack,
        Self::ShareInvalid,
        Self::Percentile,
        Self::WeightedPercentile,
        Self::Histogram,
    ];

    /// The name as tables print it.
    pub fn name(self) -> &'static str {
        match self {
            Self::LdrFlip => "FLIP",
            Self::HdrFlip => "HDR-FLIP",
            Self::SrgbMse => "MSE (sRGB)",
            Self::SrgbRmse => "RMSE (sRGB)",
            Self::SrgbPsnr => "PSNR (sRGB)",
            Self::Ssim => "SSIM",
            Self::LinearMse => "MSE (linear)",
            Self::LinearRmse => "RMSE (linear)",
            Self::LinearPsnr => "PSNR (linear)",
            Self::RelMse => "relMSE (linear)",
            Self::Smape => "SMAPE (linear)",
            Self::EnergyRatio => "Energy ratio",
            Self::ShareBlack => "Black pixels",
            Self::ShareInvalid => "Invalid pixels",
            Self::Percentile => "Percentile p",
            Self::WeightedPercentile => "Weighted percentile p",
            Self::Histogram => "Histogram",
        }
    }

    /// Formula, space and constants, in one or two plain sentences.
    pub fn definition(self) -> String {
        match self {
            Self::LdrFlip => format!(
                "Andersson et al. 2020, on 8-bit sRGB pictures after the tone curve, {:.2} pixels \
                 per degree unless stated, borders by edge replication; 0 is no visible \
                 difference, 1 the largest. The mean over all pixels is the recommended single \
                 number.",
                FlipOptions::DEFAULT_PIXELS_PER_DEGREE
            ),
            Self::HdrFlip => {
                "Andersson et al. 2021, on linear Rec. 709 RGB: per pixel the largest \
                 FLIP over exposures one stop apart, from the brightest reference pixel near white \
                 (0.85) to the median reference pixel near white, each through Narkowicz' ACES \
                 fit. Negative values count as 0; an invalid pixel has the error 1."
                    .into()
            }
            Self::SrgbMse => {
                "Mean of (t − r)² over all pixels and R, G, B, with 8-bit sRGB values \
                 divided by 255."
                    .into()
            }
            Self::SrgbRmse => "√MSE, with 8-bit sRGB values divided by 255.".into(),
            Self::SrgbPsnr => {
                "10 · log₁₀(1 / MSE) dB with 8-bit sRGB values divided by 255, which \
                 is 10 · log₁₀(255² / MSE) of the bytes. Infinite for equal pictures."
                    .into()
            }
            Self::Ssim => format!(
                "Wang et al. 2004, mean over all {0} × {0} Gaussian windows (σ = {1}) inside the \
                 picture, on luma 0.299 R′ + 0.587 G′ + 0.114 B′ of 8-bit sRGB divided by 255; \
                 C₁ = {2}², C₂ = {3}². Along a side shorter than {0} pixels all windows count, with \
                 edge replication. 1 is equal.",
                ssim::WINDOW,
                ssim::DEVIATION,
                ssim::K1,
                ssim::K2
            ),
            Self::LinearMse => "Mean of (t − r)² over all valid pixels and R, G, B, in linear \
                 Rec. 709 RGB before the tone curve."
                .into(),
            Self::LinearRmse => {
                "√MSE in linear Rec. 709 RGB before the tone curve, valid pixels only.".into()
            }
            Self::LinearPsnr => "10 · log₁₀(p² / MSE) dB in linear Rec. 709 RGB, where p is the \
                 largest valid value of the reference. Infinite for equal pictures."
                .into(),
            Self::RelMse => format!(
                "Mean of (t − r)² / (r² + ε) over all valid pixels and R, G, B, in linear Rec. 709 \
                 RGB, ε = {}.",
                linear::REL_MSE_EPSILON
            ),
            Self::Smape => format!(
                "Mean of |t − r| / (|t| + |r| + ε) over all valid pixels and R, G, B, in linear \
                 Rec. 709 RGB, ε = {}.",
                linear::SMAPE_EPSILON
            ),
            Self::EnergyRatio => "Σ Y(t) / Σ Y(r) over all valid pixels, with luminance Y = \
                 0.2126 R + 0.7152 G + 0.0722 B of linear Rec. 709 RGB. 1 is equal."
                .into(),
            Self::ShareBlack => {
                "Share of pixels with R, G and B all 0 (8-bit), or all at most 0 (linear).".into()
            }
            Self::ShareInvalid => "Share of pixels with a NaN or infinite R, G or B in either \
                 picture; other linear metrics leave these pixels out."
                .into(),
            Self::Percentile => {
                "The smallest value of the map that at least p % of its pixels don't exceed.".into()
            }
            Self::WeightedPercentile => {
                "The smallest value v of the map such that the pixels up to \
                 v hold at least p % of the sum of the map (Andersson et al. 2020, section 5)."
                    .into()
            }
            Self::Histogram => format!(
                "Counts of the map in {HISTOGRAM_BINS} bins of equal width over 0 to 1, 1 itself \
                 in the last; the bound for the share of differing pixels is {DEFAULT_BOUND} unless \
                 stated."
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_has_its_own_name_and_definition() {
        let names: std::collections::HashSet<_> = Metric::ALL.iter().map(|m| m.name()).collect();
        assert_eq!(names.len(), Metric::ALL.len());
        for metric in Metric::ALL {
            assert!(metric.definition().len() > 20, "{metric:?}");
            assert!(!metric.definition().contains("  "), "{metric:?}");
        }
        assert!(Metric::LdrFlip.definition().contains("67.02"));
        assert!(Metric::Ssim.definition().contains("11 × 11"));
    }
}
