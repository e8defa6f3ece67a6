//! FLIP: the difference that a person sees when two pictures alternate in place.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A
//! Difference Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and
//! Interactive Techniques 3(2), 2020; and for high dynamic range P. Andersson, J. Nilsson,
//! P. Shirley, T. Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images",
//! Eurographics short papers 2021. Written from the papers; the tests hold it to the authors'
//! own program.
//!
//! Two paths meet at the end. The colour path blurs both pictures as the eye does at the given
//! distance and measures the distance of what remains in a perceptual space. The feature path
//! finds edges and points that only one of the pictures has, and raises the colour difference
//! there. Every value is between 0 (no visible difference) and 1.

mod hdr;
mod kernels;

pub use hdr::{HdrFlip, hdr_flip};

use self::kernels::{Features, Sensitivity};
use super::colour::{self, Triple};
use super::plane::Plane;
use crate::LabError;
use crate::picture::{LdrImage, check_ldr};

/// How the pictures are viewed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlipOptions {
    /// Pixels per degree of visual angle: above 0, at most 1000.
    pub pixels_per_degree: f64,
}

impl FlipOptions {
    /// The authors' default, 67.02: a screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
    pub const DEFAULT_PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

    fn check(self) -> Result<f64, LabError> {
        let ppd = self.pixels_per_degree;
        if !(ppd > 0.0 && ppd <= 1000.0) {
            return Err(LabError::Parameter {
                name: "the number of pixels per degree",
                value: ppd,
                range: "above 0 and at most 1000",
            });
        }
        Ok(ppd)
    }
}

impl Default for FlipOptions {
    fn default() -> Self {
        Self {
            pixels_per_degree: Self::DEFAULT_PIXELS_PER_DEGREE,
        }
    }
}

/// Exponent of the colour difference (section 4.1, equation 4).
const COLOUR_EXPONENT: f32 = 0.7;
/// Share of the largest colour difference up to which differences are spread linearly …
const KNEE: f32 = 0.4;
/// … over this share of the output range (section 4.1, equation 5).
const KNEE_OUTPUT: f32 = 0.95;

/// The FLIP map of two 8-bit sRGB pictures, a value in 0 to 1 a pixel. Alpha is ignored.
///
/// # Errors
/// If the sizes differ, or the number of pixels per degree is out of range.
pub fn ldr_flip(
    reference: &LdrImage,
    test: &LdrImage,
    options: FlipOptions,
) -> Result<Plane, LabError> {
    check_ldr(reference, test)?;
    let filters = Filters::new(options.check()?);
    let linear = |image: &LdrImage, i: usize| {
        let p = image.pixels[i];
        [p[0], p[1], p[2]].map(colour::srgb_to_linear)
    };
    let (width, height) = (reference.width as usize, reference.height as usize);
    let seen_reference = filters.see(width, height, |i| linear(reference, i));
    let seen_test = filters.see(width, height, |i| linear(test, i));
    Ok(seen_reference.difference(&seen_test))
}

/// All kernels for one viewing distance.
struct Filters {
    sensitivity: Sensitivity,
    features: Features,
}

/// What the eye makes of one picture.
struct Seen {
    /// Blurred colour in L*a*b*, with chroma scaled by lightness (Hunt effect).
    colour: [Plane; 3],
    /// Strength of edges.
    edge: Plane,
    /// Strength of points.
    point: Plane,
}

impl Filters {
    fn new(pixels_per_degree: f64) -> Self {
        Self {
            sensitivity: Sensitivity::new(pixels_per_degree),
            features: Features::new(pixels_per_degree),
        }
    }

    /// Runs both paths over one picture, given as linear RGB in 0 to 1 by pixel index.
    fn see(
        &self,
        width: usize,
        height: usize,
        rgb: impl Fn(usize) -> Triple + Sync + Send,
    ) -> Seen {
        let [yy, cx, cz] = Plane::split(width, height, |i| colour::linear_to_opponent(rgb(i)));
        let (edge, point) = self.find_features(&yy);
        let s = &self.sensitivity;
        let blur = |plane: &Plane, kernel: &[f32]| plane.filter_rows(kernel).filter_columns(kernel);
        let [narrow, wide] = [1, 0].map(|lobe| blur(&cz, &s.blue_yellow[lobe]));
        drop(cz);
        let (yy, cx) = (blur(&yy, &s.lightness), blur(&cx, &s.red_green));
        let colour = Plane::split(width, height, |i| {
            let opponent = [
                yy.values[i],
                cx.values[i],
                narrow.values[i] + wide.values[i],
            ];
            let rgb = colour::opponent_to_linear(opponent).map(|c| c.clamp(0.0, 1.0));
            hunt(colour::linear_to_lab(rgb))
        });
        Seen {
            colour,
            edge,
            point,
        }
    }

    /// Gradient magnitude of the first and second derivative of the unblurred lightness.
    fn find_features(&self, yy: &Plane) -> (Plane, Plane) {
        let (width, height) = (yy.width, yy.height);
        let lightness = Plane::from_index(width, height, |i| (yy.values[i] + 16.0) / 116.0);
        let f = &self.features;
        let smooth_rows = lightness.filter_rows(&f.gauss);
        let magnitude = |kernel: &[f32]| {
            let across = lightness.filter_rows(kernel).filter_columns(&f.gauss);
            let down = smooth_rows.filter_columns(kernel);
            Plane::from_index(width, height, |i| across.values[i].hypot(down.values[i]))
        };
        (magnitude(&f.edge), magnitude(&f.point))
    }
}

impl Seen {
    /// Joins colour and feature difference into FLIP (section 4.3, equation 9).
    fn difference(&self, other: &Self) -> Plane {
        let largest = largest_colour_difference();
        Plane::from_index(self.edge.width, self.edge.height, |i| {
            let at = |seen: &Self| std::array::from_fn(|c| seen.colour[c].values[i]);
            let colour = redistribute(hyab(at(self), at(other)).powf(COLOUR_EXPONENT), largest);
            let edge = (self.edge.values[i] - other.edge.values[i]).abs();
            let point = (self.point.values[i] - other.point.values[i]).abs();
            let feature = (edge.max(point) * std::f32::consts::FRAC_1_SQRT_2).clamp(0.0, 1.0);
            colour.powf(1.0 - feature.sqrt())
        })
    }
}

/// Chroma looks stronger on bright colours (Hunt 1952): a and b are scaled by L / 100.
#[inline]
fn hunt([l, a, b]: Triple) -> Triple {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// Distance for large colour differences (Abasi et al. 2020): city block between lightness and
/// the Euclidean distance of chroma.
#[inline]
fn hyab(p: Triple, q: Triple) -> f32 {
    (p[0] - q[0]).abs() + (p[1] - q[1]).hypot(p[2] - q[2])
}

/// The distance of pure green and pure blue, the largest that sRGB has.
fn largest_colour_difference() -> f32 {
    let [green, blue] =
        [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| hunt(colour::linear_to_lab(rgb)));
    hyab(green, blue).powf(COLOUR_EXPONENT)
}

/// Small differences, which matter most, get most of the range.
#[inline]
fn redistribute(difference: f32, largest: f32) -> f32 {
    let knee = KNEE * largest;
    if difference < knee {
        KNEE_OUTPUT / knee * difference
    } else {
        KNEE_OUTPUT + (difference - knee) / (largest - knee) * (1.0 - KNEE_OUTPUT)
    }
}

#[cfg(test)]
mod tests;
