//! The kernels of FLIP: contrast sensitivity of the eye, edges and points.

use std::f64::consts::PI;

/// A Gaussian of the contrast sensitivity function, `a √(π/b) exp(−π² d² / b)` with `d` in
/// degrees (Andersson et al. 2020, equation 2 and table 1; the sums were fitted by Johnson and
/// Fairchild 2003 to measured sensitivity).
#[derive(Clone, Copy)]
struct Lobe {
    amplitude: f64,
    width: f64,
}

const LIGHTNESS: Lobe = Lobe {
    amplitude: 1.0,
    width: 0.0047,
};
const RED_GREEN: Lobe = Lobe {
    amplitude: 1.0,
    width: 0.0053,
};
const BLUE_YELLOW: [Lobe; 2] = [
    Lobe {
        amplitude: 34.1,
        width: 0.04,
    },
    Lobe {
        amplitude: 13.5,
        width: 0.025,
    },
];

/// Width of the edge and point detectors in degrees (section 4.2, after DeValois 1990).
const FEATURE_WIDTH: f64 = 0.082;

/// One-dimensional halves of the separable filters for the opponent channels. All sum to one
/// over the plane; blue-yellow is the sum of two separable filters.
pub struct Sensitivity {
    /// For the lightness channel.
    pub lightness: Vec<f32>,
    /// For the red-green channel.
    pub red_green: Vec<f32>,
    /// For the blue-yellow channel.
    pub blue_yellow: [Vec<f32>; 2],
}

impl Sensitivity {
    /// The filters at a number of pixels per degree of visual angle.
    pub fn new(pixels_per_degree: f64) -> Self {
        // Three standard deviations of the widest lobe (section 4.1).
        let deviation = (BLUE_YELLOW[0].width / (2.0 * PI * PI)).sqrt();
        let radius = (3.0 * deviation * pixels_per_degree).ceil() as i32;
        let profile = |lobe: Lobe| -> Vec<f64> {
            (-radius..=radius)
                .map(|i| {
                    let degrees = f64::from(i) / pixels_per_degree;
                    (-PI * PI * degrees * degrees / lobe.width).exp()
                })
                .collect()
        };
        let normalised = |lobe: Lobe| {
            let values = profile(lobe);
            let sum: f64 = values.iter().sum();
            values.iter().map(|v| (v / sum) as f32).collect()
        };
        // The two lobes share one normalisation: the plane sum of a lobe is the square of its
        // profile's sum, and each half carries the square root of its lobe's weight.
        let profiles = BLUE_YELLOW.map(profile);
        let weights = BLUE_YELLOW.map(|lobe| lobe.amplitude * (PI / lobe.width).sqrt());
        let total: f64 = profiles
            .iter()
            .zip(weights)
            .map(|(values, weight)| weight * values.iter().sum::<f64>().powi(2))
            .sum();
        let mut halves = profiles.iter().zip(weights).map(|(values, weight)| {
            let scale = (weight / total).sqrt();
            values.iter().map(|v| (v * scale) as f32).collect()
        });
        let blue_yellow = std::array::from_fn(|_| halves.next().unwrap_or_default());
        Self {
            lightness: normalised(LIGHTNESS),
            red_green: normalised(RED_GREEN),
            blue_yellow,
        }
    }
}

/// One-dimensional halves of the edge and point detectors.
pub struct Features {
    /// Gaussian, applied along the other axis.
    pub gauss: Vec<f32>,
    /// First derivative of the Gaussian: finds edges.
    pub edge: Vec<f32>,
    /// Second derivative of the Gaussian: finds points and lines.
    pub point: Vec<f32>,
}

impl Features {
    /// The detectors at a number of pixels per degree of visual angle.
    pub fn new(pixels_per_degree: f64) -> Self {
        let deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
        let radius = (3.0 * deviation).ceil() as i32;
        let offsets: Vec<f64> = (-radius..=radius).map(f64::from).collect();
        let variance = deviation * deviation;
        let gauss: Vec<f64> = offsets
            .iter()
            .map(|x| (-x * x / (2.0 * variance)).exp())
            .collect();
        let edge = offsets
            .iter()
            .zip(&gauss)
            .map(|(x, g)| -x * g)
            .collect::<Vec<_>>();
        let point = offsets
            .iter()
            .zip(&gauss)
            .map(|(x, g)| (x * x / variance - 1.0) * g);
        let sum: f64 = gauss.iter().sum();
        Self {
            gauss: gauss.iter().map(|g| (g / sum) as f32).collect(),
            edge: balance(&edge),
            point: balance(&point.collect::<Vec<_>>()),
        }
    }
}

/// Positive weights are scaled to sum to one and negative weights to minus one (section 4.2).
fn balance(values: &[f64]) -> Vec<f32> {
    let positive: f64 = values.iter().filter(|v| **v > 0.0).sum();
    let negative: f64 = -values.iter().filter(|v| **v < 0.0).sum::<f64>();
    let scale = |v: f64| {
        let side = if v > 0.0 { positive } else { negative };
        if side > 0.0 { (v / side) as f32 } else { 0.0 }
    };
    values.iter().map(|&v| scale(v)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_are_normalised_at_any_viewing_distance() {
        for ppd in [1.0, 20.0, 67.0, 200.0] {
            let s = Sensitivity::new(ppd);
            let sum = |k: &[f32]| k.iter().map(|v| f64::from(*v)).sum::<f64>();
            assert!((sum(&s.lightness) - 1.0).abs() < 1e-6);
            assert!((sum(&s.red_green) - 1.0).abs() < 1e-6);
            let plane = sum(&s.blue_yellow[0]).powi(2) + sum(&s.blue_yellow[1]).powi(2);
            assert!((plane - 1.0).abs() < 1e-6, "{plane}");
            let f = Features::new(ppd);
            assert!((sum(&f.gauss) - 1.0).abs() < 1e-6);
            assert!(sum(&f.edge).abs() < 1e-6 && sum(&f.point).abs() < 1e-5);
        }
    }
}
