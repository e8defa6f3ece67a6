//! The numbers of a comparison for people.

use super::{HdrDifference, LdrDifference};
use crate::metrics::{LinearErrors, MapStatistics, Metric};

/// One printed number: what it is, its value, and the metric that defines it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Name of the number.
    pub name: String,
    /// The number as text, with its unit.
    pub value: String,
    /// The definition behind it.
    pub metric: Metric,
}

/// The lines of a comparison of 8-bit pictures.
pub(crate) fn ldr_lines(d: &LdrDifference) -> Vec<Line> {
    let mut lines = flip_lines(&d.flip, Metric::LdrFlip);
    lines.extend([
        line("RMSE (sRGB)", number(d.srgb.rmse), Metric::SrgbRmse),
        line("MSE (sRGB)", number(d.srgb.mse), Metric::SrgbMse),
        line("PSNR (sRGB)", decibel(d.srgb.psnr_db), Metric::SrgbPsnr),
        line(
            "Largest step of a channel",
            format!("{} of 255", d.srgb.max_steps),
            Metric::SrgbMse,
        ),
        line(
            "Pixels that differ at all",
            percent(d.srgb.share_different),
            Metric::SrgbMse,
        ),
        line("SSIM", number(d.ssim), Metric::Ssim),
        black_line(
            "Black pixels (sRGB)",
            d.srgb.reference_black,
            d.srgb.test_black,
        ),
    ]);
    lines
}

/// The lines of a comparison of linear pictures.
pub(crate) fn hdr_lines(d: &HdrDifference) -> Vec<Line> {
    let mut lines = flip_lines(&d.flip, Metric::HdrFlip);
    let [start, stop] = d.exposure_range;
    let exposures = format!("{} from {start:+.2} to {stop:+.2} stops", d.exposures);
    lines.push(line("Exposures", exposures, Metric::HdrFlip));
    lines.extend(linear_lines(&d.linear));
    lines
}

/// The lines of pointwise linear errors.
pub(crate) fn linear_lines(e: &LinearErrors) -> Vec<Line> {
    vec![
        line("RMSE (linear)", number(e.rmse), Metric::LinearRmse),
        line("PSNR (linear)", decibel(e.psnr_db), Metric::LinearPsnr),
        line("relMSE (linear)", number(e.rel_mse), Metric::RelMse),
        line("SMAPE (linear)", number(e.smape), Metric::Smape),
        line("Energy ratio", number(e.energy_ratio), Metric::EnergyRatio),
        black_line("Black pixels (linear)", e.reference_black, e.test_black),
        line(
            "Invalid pixels",
            percent(e.share_invalid),
            Metric::ShareInvalid,
        ),
    ]
}

fn flip_lines(flip: &MapStatistics, metric: Metric) -> Vec<Line> {
    let name = metric.name();
    let share = format!("Pixels with {name} above {}", number(flip.bound));
    vec![
        line(&format!("{name} mean"), number(flip.mean), metric),
        line(
            &format!("{name} 99th percentile"),
            number(flip.p99),
            Metric::Percentile,
        ),
        line(&format!("{name} maximum"), number(flip.max), metric),
        line(&share, percent(flip.share_over_bound), Metric::Histogram),
        line(
            &format!("{name} weighted median"),
            number(flip.weighted_quartiles[1]),
            Metric::WeightedPercentile,
        ),
    ]
}

fn black_line(name: &str, reference: f64, test: f64) -> Line {
    let value = format!(
        "{} in the reference, {} here",
        percent(reference),
        percent(test)
    );
    line(name, value, Metric::ShareBlack)
}

fn line(name: &str, value: String, metric: Metric) -> Line {
    Line {
        name: name.into(),
        value,
        metric,
    }
}

/// Four significant digits; "n/a" where there is no number.
pub(crate) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "n/a".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let magnitude = value.abs().log10().floor() as i32;
    if (-5..6).contains(&magnitude) {
        let decimals = (3 - magnitude).max(0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') {
            return text.trim_end_matches('0').trim_end_matches('.').into();
        }
        return text;
    }
    format!("{value:.3e}")
}

fn decibel(value: f64) -> String {
    if value == f64::INFINITY {
        "∞ dB (equal)".into()
    } else {
        format!("{} dB", number(value))
    }
}

/// A share as a percentage. A share that is not zero is never printed as 0.
pub(crate) fn percent(share: f64) -> String {
    let value = 100.0 * share;
    match value {
        v if !v.is_finite() => "n/a".into(),
        0.0 => "0 %".into(),
        v if v < 0.01 => "below 0.01 %".into(),
        v if v < 1.0 => format!("{v:.2} %"),
        v if (99.95..100.0).contains(&v) => "over 99.9 %".into(),
        100.0 => "100 %".into(),
        v => format!("{v:.1} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (0.012_345, "0.01235"),
            (1234.56, "1235"),
            (0.5, "0.5"),
            (12_345.6, "12346"),
            (1.5e-9, "1.500e-9"),
            (f64::NAN, "n/a"),
            (-2.25, "-2.25"),
            (1e10, "1.000e10"),
            (9.99996, "10"),
            (1200.0, "1200"),
        ] {
            assert_eq!(number(value), text);
        }
        assert_eq!(percent(1e-9), "below 0.01 %");
        assert_eq!(
            (percent(1.0), percent(0.999_999)),
            ("100 %".into(), "over 99.9 %".into())
        );
    }
}
