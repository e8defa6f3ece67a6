//! How far a picture is from what it should be, and where.

use lightbench_render::TargetImage;
use lightbench_script::{Bound, Expected};

/// A threshold is at least three times the largest difference that drivers were seen to make, so that
/// what lies within a third of it might be judged otherwise on another one.
pub const MARGIN: f64 = 1.0 / 3.0;

/// Whether something holds, and whether that is so clear that no person need look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Verdict {
    pub(super) holds: bool,
    pub(super) near: bool,
}

impl Verdict {
    /// Of an error, in units of the threshold.
    pub(super) fn of(error: f64) -> Self {
        Self {
            // What is no number is wrong.
            holds: error <= 1.0,
            near: (error - 1.0).abs() <= MARGIN,
        }
    }
}

/// How a picture compares with what it should be.
#[derive(Clone, Debug)]
pub(super) struct Comparison {
    /// The error of each texel that was compared, in units of the threshold.
    pub(super) errors: Vec<Option<f64>>,
    /// The error that counts, after the share of texels that may be worse.
    pub(super) error: f64,
    /// How many texels were compared, and how many of them are off by more than the threshold.
    pub(super) compared: usize,
    pub(super) wrong: usize,
    /// The texels that are off lie from here to there.
    pub(super) area: Option<[[u32; 2]; 2]>,
    /// The texel that is off most.
    pub(super) worst: Option<(u32, u32)>,
    /// The mean distance of all channels of all texels.
    pub(super) distance: f64,
}

/// Compares a picture with what it should be.
pub(super) fn compare(found: &TargetImage, expected: &Expected, bound: Bound) -> Comparison {
    let mut errors = vec![None; found.texels.len()];
    let (mut distance, mut compared) = (0.0, 0);
    for ((error, texel), expected_texel) in
        errors.iter_mut().zip(&found.texels).zip(&expected.texels)
    {
        let Some(expected_texel) = expected_texel else {
            continue;
        };
        compared += 1;
        let mut worst: f64 = 0.0;
        for (&found, &expected) in texel.iter().zip(expected_texel).take(expected.channels) {
            let off = (f64::from(found) - f64::from(expected)).abs();
            let allowed = bound.absolute + bound.relative * f64::from(expected).abs();
            let ratio = if off == 0.0 { 0.0 } else { off / allowed };
            worst = if ratio.is_finite() {
                worst.max(ratio)
            } else {
                f64::INFINITY
            };
            distance += if off.is_finite() { off } else { f64::INFINITY };
        }
        *error = Some(worst);
    }
    let mut sorted: Vec<f64> = errors.iter().copied().flatten().collect();
    sorted.sort_by(f64::total_cmp);
    let forgiven = (bound.share * sorted.len() as f64).floor() as usize;
    let counts = sorted
        .len()
        .checked_sub(1 + forgiven)
        .and_then(|index| sorted.get(index));
    let place = |index: usize| (index as u32 % found.width, index as u32 / found.width);
    let wrong = || {
        errors
            .iter()
            .enumerate()
            .filter(|(_, error)| error.is_some_and(|error| error > 1.0))
    };
    let area =
        wrong()
            .map(|(index, _)| place(index))
            .fold(None, |area: Option<[[u32; 2]; 2]>, (x, y)| {
                let [[left, top], [right, bottom]] = area.unwrap_or([[x, y], [x, y]]);
                Some([[left.min(x), top.min(y)], [right.max(x), bottom.max(y)]])
            });
    let worst = wrong().max_by(|(_, a), (_, b)| a.unwrap_or(0.0).total_cmp(&b.unwrap_or(0.0)));
    Comparison {
        error: counts.copied().unwrap_or(f64::INFINITY),
        compared,
        wrong: wrong().count(),
        area,
        worst: worst.map(|(index, _)| place(index)),
        distance: distance / (compared * expected.channels).max(1) as f64,
        errors,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use lightbench_render::Format;

    pub(crate) fn image(width: u32, texels: Vec<[f32; 4]>) -> TargetImage {
        TargetImage {
            width,
            height: texels.len() as u32 / width,
            format: Format::from_name("rgba32float").unwrap(),
            channels: 4,
            texels,
        }
    }

    fn expected(texels: &[[f32; 4]]) -> Expected {
        Expected {
            channels: 3,
            texels: texels.iter().copied().map(Some).collect(),
        }
    }

    const BOUND: Bound = Bound {
        absolute: 0.25,
        relative: 0.0,
        share: 0.0,
    };

    #[test]
    fn the_error_is_in_units_of_the_threshold_and_has_a_place() {
        let right = vec![[1.0, 1.0, 1.0, 1.0]; 12];
        let mut texels = right.clone();
        texels[5] = [1.0, 1.5, 1.0, 1.0];
        texels[10] = [1.0, 1.0, 0.0, 7.0];
        let found = compare(&image(4, texels.clone()), &expected(&right), BOUND);
        assert_eq!((found.error, found.compared, found.wrong), (4.0, 12, 2));
        assert_eq!(found.area, Some([[1, 1], [2, 2]]));
        assert_eq!(found.worst, Some((2, 2)));
        assert_eq!(found.distance, 1.5 / 36.0);
        // Two of twelve may be off.
        let found = compare(
            &image(4, texels),
            &expected(&right),
            Bound {
                share: 0.17,
                ..BOUND
            },
        );
        assert_eq!(found.error, 0.0);
    }

    #[test]
    fn what_is_no_number_or_not_there_is_wrong() {
        let right = vec![[1.0; 4]; 2];
        let found = image(2, vec![[f32::NAN, 1.0, 1.0, 1.0], [1.0; 4]]);
        assert_eq!(
            compare(&found, &expected(&right), BOUND).error,
            f64::INFINITY
        );
        let nothing = Expected {
            channels: 3,
            texels: vec![None; 2],
        };
        assert!(!Verdict::of(compare(&found, &nothing, BOUND).error).holds);
    }

    #[test]
    fn what_another_driver_might_judge_otherwise_is_near() {
        let of = |error| (Verdict::of(error).holds, Verdict::of(error).near);
        assert_eq!(of(0.5), (true, false));
        assert_eq!(of(0.7), (true, true));
        assert_eq!(of(1.3), (false, true));
        assert_eq!(of(1.4), (false, false));
        assert_eq!(of(f64::NAN), (false, false));
    }
}
